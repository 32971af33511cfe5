"""A LeRobot dataset, version 3: a lap is an episode, a control step a frame.

Format: https://huggingface.co/docs/lerobot/lerobot-dataset-v3. Its readers take no missing value
and no time but ``frame_index / fps``: a missing number is 0 with a mask beside it, and the recorded
time is a feature of its own.
"""

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Self

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from analysis.export.content import Content, LapSteps
from analysis.export.frames import Frames
from analysis.export.moments import Moments
from analysis.export.readme import write_about
from analysis.export.registry import Tell
from protocols.files.errors import InputError

FRAMES_PER_FILE = 200_000
"""About 50 MB; the format's own writer begins a new file at 100 MB."""

FRAMES_PER_PART = 10_000
EPISODES_PER_PART = 100
"""How many rows are in memory before they are written: a file's writer keeps something of every
part until the file ends, so that small parts fill the memory."""

_ABOUT_LAPS = ("participant", "lap", "condition", "practice", "completed", "lap_time_s")

INDICES = ("timestamp", "frame_index", "episode_index", "index", "task_index")

_DATA = "data/chunk-000/file-{:03d}.parquet"
_EPISODES = "meta/episodes/chunk-000/file-000.parquet"

_HOW = """\
A LeRobot dataset (v3.0): an episode is a lap, a frame a control step.

```
pip install lerobot-doctor
lerobot-doctor check . --ci
```

- `action` is the command that was **executed** (v in m/s, w in rad/s, right turns negative). What
  the driver wanted, what the limitation left of it, what the demonstrator and the model would have
  done are in `command.*`. For learning from the demonstrator use `command.demonstrator` where
  `command.demonstrator.given` is true.
- `observation.state` holds the 19 inputs of the paper's model: the driver's command as limited,
  velocities, 15 laser segments (minima, not rays).
- `pose.*` is ground truth: no policy for a real wheelchair has it.
- Missing numbers are 0; `NAME.given` says where a number was there.
- `timestamp` is `frame_index / fps`, as the format demands; `recorded_time_s` is the step's time.
- `meta/episodes` has participant, lap and condition of each episode. Condition is the task.
"""


def write(content: Content, folder: Path, tell: Tell) -> None:
    """Write a dataset into an empty folder."""
    fps = frames_per_second(content.study.protocol.control_period_s)
    tasks = {str(name): i for i, name in enumerate(sorted(content.study.protocol.conditions))}
    sentences = {name: task_sentence(content, name) for name in tasks}
    with _Dataset(folder, fps, content, tasks, sentences) as dataset:
        for lap in content.laps_with_steps():
            tell(f"Steps of {lap.lap['participant']}, lap {lap.lap['lap']}")
            if len(lap.steps):
                dataset.add(lap)
    if not dataset.episodes:
        raise InputError(f"{content.study.folder}: no lap has steps; there are no frames to export")
    names = pd.Index(list(sentences.values()), name="task")
    frame = pd.DataFrame({"task_index": range(len(tasks))}, index=names)
    frame.to_parquet(folder / "meta" / "tasks.parquet")
    stats = {name: moments.as_stats() for name, moments in dataset.moments.items()}
    _write_json(folder / "meta" / "stats.json", stats)
    _write_json(folder / "meta" / "info.json", _info(fps, len(tasks), dataset))
    write_about(content, folder, _HOW)


def frames_per_second(period_s: float) -> int:
    """Return how many control steps a second has.

    Raises
    ------
    InputError
        When it is no whole number: the format knows no other.

    Examples
    --------
    >>> frames_per_second(0.1)
    10
    """
    fps = round(1 / period_s)
    if abs(fps * period_s - 1) > 1e-9:
        raise InputError(
            f"--format lerobot: control steps of {period_s:g} s are no whole number of frames a "
            "second; allowed: another format"
        )
    return fps


def task_sentence(content: Content, condition: str) -> str:
    """Return a condition as the dataset's tasks name it."""
    return f"Drive a lap of {content.study.course_names}: {condition}"


class _Parts:
    """A Parquet file that is written in parts of some rows; its columns are those of the first."""

    def __init__(self, path: Path, rows: int) -> None:
        self._path, self._rows = path, rows
        self._waiting: list[pa.Table] = []
        self._writer: pq.ParquetWriter | None = None

    def add(self, table: pa.Table) -> None:
        """Take the next rows; write them when there are enough for a part."""
        self._waiting.append(table)
        if sum(map(len, self._waiting)) >= self._rows:
            self._write()

    def _write(self) -> None:
        if not self._waiting:
            return
        part = pa.concat_tables(self._waiting).combine_chunks()
        self._waiting.clear()
        if self._writer is None:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            self._writer = pq.ParquetWriter(self._path, part.schema)
        self._writer.write_table(part)

    def close(self) -> None:
        """Write what waits, and end the file."""
        self._write()
        if self._writer is not None:
            self._writer.close()
        self._writer = None


class _Dataset:
    """The frames and episodes of a dataset while they are written, lap after lap.

    Attributes
    ----------
    made
        What the frames hold.
    episodes, frames
        How many have been written.
    moments
        Of every feature, over all frames so far.
    """

    def __init__(
        self,
        folder: Path,
        fps: int,
        content: Content,
        tasks: Mapping[str, int],
        sentences: Mapping[str, str],
    ) -> None:
        self._folder, self._fps = folder, fps
        self.made = Frames.of(content.step_fields)
        self._types = {f.name: f.type for f in content.laps.fields if f.name in _ABOUT_LAPS}
        self._tasks, self._sentences = tasks, sentences
        self.episodes = self.frames = 0
        self.moments: dict[str, Moments] = {}
        self._file = self._frames_in_file = 0
        self._data = _Parts(folder / _DATA.format(0), FRAMES_PER_PART)
        self._about = _Parts(folder / _EPISODES, EPISODES_PER_PART)
        self._episodes: list[dict[str, Any]] = []

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._data.close()
        self._flush()
        self._about.close()

    def add(self, lap: LapSteps) -> None:
        """Write one lap."""
        if self._frames_in_file >= FRAMES_PER_FILE:
            self._data.close()
            self._file, self._frames_in_file = self._file + 1, 0
            self._data = _Parts(self._folder / _DATA.format(self._file), FRAMES_PER_PART)
        columns = dict(self.made.columns(lap.steps)) | self._indices(lap)
        self._data.add(pa.table({name: _array(values) for name, values in columns.items()}))
        self._episodes.append(self._episode(lap, columns))
        self.episodes += 1
        self.frames += len(lap.steps)
        self._frames_in_file += len(lap.steps)
        if len(self._episodes) == EPISODES_PER_PART:
            self._flush()

    def _flush(self) -> None:
        if not self._episodes:
            return
        # What is missing in every lap of a part has no type of its own.
        columns = {
            name: pa.array([row[name] for row in self._episodes], self._types.get(name))
            for name in self._episodes[0]
        }
        self._about.add(pa.table(columns))
        self._episodes.clear()

    def _indices(self, lap: LapSteps) -> dict[str, NDArray[Any]]:
        count, task = len(lap.steps), self._tasks[str(lap.lap["condition"])]
        frames = np.arange(count, dtype=np.int64)
        return {
            "timestamp": (frames / self._fps).astype(np.float32),
            "frame_index": frames,
            "episode_index": np.full(count, self.episodes, dtype=np.int64),
            "index": frames + self.frames,
            "task_index": np.full(count, task, dtype=np.int64),
        }

    def _episode(self, lap: LapSteps, columns: Mapping[str, NDArray[Any]]) -> dict[str, Any]:
        count = len(lap.steps)
        row: dict[str, Any] = {
            "episode_index": self.episodes,
            "tasks": [self._sentences[str(lap.lap["condition"])]],
            "length": count,
            "data/chunk_index": 0,
            "data/file_index": self._file,
            "dataset_from_index": self.frames,
            "dataset_to_index": self.frames + count,
            "meta/episodes/chunk_index": 0,
            "meta/episodes/file_index": 0,
            **{name: lap.lap[name] for name in _ABOUT_LAPS},
        }
        for name, values in columns.items():
            numbers = values.reshape(count, -1).astype(np.float64)
            self.moments.setdefault(name, Moments()).add(numbers)
            own = Moments()
            own.add(numbers)
            row |= {f"stats/{name}/{key}": value for key, value in own.as_stats().items()}
        return row


def _info(fps: int, tasks: int, done: _Dataset) -> dict[str, Any]:
    return {
        "codebase_version": "v3.0",
        "robot_type": "wheelchair",
        "total_episodes": done.episodes,
        "total_frames": done.frames,
        "total_tasks": tasks,
        "chunks_size": 1000,
        "data_files_size_in_mb": 100,
        "video_files_size_in_mb": 500,
        "fps": fps,
        "splits": {"train": f"0:{done.episodes}"},
        "data_path": "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet",
        "video_path": None,
        "features": dict(_features(done.made)),
    }


def _array(values: NDArray[Any]) -> pa.Array:
    if values.ndim == 1:
        return pa.array(values)
    return pa.FixedSizeListArray.from_arrays(pa.array(values.ravel()), values.shape[1])


def _features(made: Frames) -> Iterator[tuple[str, dict[str, Any]]]:
    for name, kind, parts in made.described():
        shape, names = ([len(parts)], list(parts)) if parts else ([1], None)
        yield name, {"dtype": kind, "shape": shape, "names": names}
    for name in INDICES:
        kind = "float32" if name == "timestamp" else "int64"
        yield name, {"dtype": kind, "shape": [1], "names": None}


def _write_json(path: Path, data: Any) -> None:
    path.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
