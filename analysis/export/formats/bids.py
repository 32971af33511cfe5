"""A BIDS dataset of motion recordings (Motion-BIDS): a lap is a recording of its own.

Specification: https://bids-specification.readthedocs.io/ (1.10, modality motion). Check a copy with
``bids-validator-deno FOLDER``.
"""

import json
from collections.abc import Iterator, Mapping
from itertools import groupby, islice
from pathlib import Path
from typing import Any, NamedTuple

import pyarrow as pa
import pyarrow.compute as pc

from analysis.export.content import Content, LapSteps
from analysis.export.delimited import Dialect, header_line, lines, write_table
from analysis.export.field import Field
from analysis.export.file_labels import file_label, file_labels, renamed_text
from analysis.export.readme import LICENCE_FILE, README_FILE, STUDY_FILE, readme, study_text
from analysis.export.registry import Tell
from lad.inputs import INPUT_NAMES, N_SEGMENTS
from protocols.instrument import Instrument

BIDS_VERSION = "1.10.0"
SYSTEM = "wheelchair"
POINT = "axle"

TSV = Dialect(separator="\t", missing="n/a")
"""As BIDS has tables: tabulators, and ``n/a`` for what is missing."""

_SAMPLES = Dialect(separator="\t", missing="n/a", header=False)
"""As Motion-BIDS has samples: without a first line."""

_HOW = """\
A BIDS dataset (motion). A lap is a recording: `sub-P0001/motion/*_motion.tsv` has a line per
control step and no first line; `*_channels.tsv` names its columns in their order. One more line
has the state after the last step. The heading is `ORNT` about `z`. Lap times and conditions are in
`sub-*/sub-*_scans.tsv`, answers in `phenotype/`.

```
pip install bids-validator-deno
bids-validator-deno . --ignoreWarnings
```
"""

PEOPLE_AT_ONCE = 50
"""How many people's answers are in memory as text."""


class Channel(NamedTuple):
    """A column of a recording: step columns at the start and at the end of a step, and its kind."""

    column: str
    after: str | None
    kind: str
    component: str
    unit: str


_STATE = (
    Channel("x_m", "result_x_m", "POS", "x", "m"),
    Channel("y_m", "result_y_m", "POS", "y", "m"),
    Channel("heading_rad", "result_heading_rad", "ORNT", "z", "rad"),
    Channel("velocity_v", "result_v", "VEL", "x", "m/s"),
    Channel("velocity_w", "result_w", "GYRO", "z", "rad/s"),
)
_COMMANDS = (
    *(f"{of}_{part}" for of in ("intent", "user", "arbitrated", "executed") for part in "vw"),
    *("would_v", "would_w", "mean_v", "mean_w"),
)
_NUMBERS = ("h", "h_would", "p_help", "variance", "arc_m", "offset_m", "clearance_m", "t_s")

CHANNELS: tuple[Channel, ...] = (
    *_STATE,
    *(Channel(n, None, "MISC", "n/a", "rad/s" if n.endswith("w") else "m/s") for n in _COMMANDS),
    *(
        Channel(name, f"last_segment_{i:02d}", "MISC", "n/a", "m")
        for i, name in enumerate(INPUT_NAMES[-N_SEGMENTS:])
    ),
    *(
        Channel(n, None, "MISC", "n/a", "m" if n.endswith("_m") else "s" if n == "t_s" else "n/a")
        for n in _NUMBERS
    ),
)
"""What a recording holds, in the order of its columns."""


def write(content: Content, folder: Path, tell: Tell) -> None:
    """Write a dataset into an empty folder."""
    _write_json(folder / "dataset_description.json", _description(content))
    _write_people(content, folder)
    _write_answers(content, folder)
    for participant, laps in groupby(content.laps_with_steps(), lambda lap: lap.lap["participant"]):
        tell(f"Recordings of {participant}")
        rows = [{"filename": _write_recording(content, folder, lap), **lap.lap} for lap in laps]
        _write_scans(content, folder, str(participant), rows)
    fields = {f.name: f for f in content.laps.fields}
    described = {n: _described(f) for n, f in fields.items() if n in _SCAN_COLUMNS}
    _write_json(folder / "scans.json", described)
    about = readme(content, _HOW + renamed_text(content.labels))
    (folder / README_FILE).write_text(about, encoding="utf-8")
    (folder / LICENCE_FILE).write_text(content.licence.text, encoding="utf-8")
    (folder / "sourcedata").mkdir()
    (folder / "sourcedata" / STUDY_FILE).write_text(study_text(content), encoding="utf-8")


_SCAN_COLUMNS = ("lap", "condition", "practice", "completed", "end_reason", "lap_time_s",
                 "collisions", "assisted_fraction")  # fmt: skip


def _description(content: Content) -> dict[str, Any]:
    return {
        "Name": content.study.protocol.title,
        "BIDSVersion": BIDS_VERSION,
        "DatasetType": "raw",
        "License": content.licence.name,
        "GeneratedBy": [{"Name": "lad-study"}],
    }


def _write_people(content: Content, folder: Path) -> None:
    table, fields = content.participants.rows, content.participants.fields
    ids = [f"sub-{content.labels[name]}" for name in table["participant"].to_pylist()]
    renamed = table.drop_columns(["participant"]).add_column(0, "participant_id", pa.array(ids))
    write_table(folder / "participants.tsv", renamed, TSV)
    _write_json(folder / "participants.json", {f.name: _described(f) for f in fields[1:]})


def _write_answers(content: Content, folder: Path) -> None:
    """Write one file per instrument: a line per participant, a column per lap and item."""
    surveys = content.surveys.rows
    tools = file_labels(instrument.name for instrument in content.study.instruments)
    for instrument in content.study.instruments:
        answers = surveys.filter(pc.equal(surveys["instrument"], instrument.name))
        if not len(answers):
            continue
        (folder / "phenotype").mkdir(exist_ok=True)
        path = folder / "phenotype" / f"{tools[instrument.name]}.tsv"
        columns = _questions(answers, instrument)
        about = {"Description": instrument.title}
        _write_json(path.with_suffix(".json"), {"MeasurementToolMetadata": about, **columns})
        schema = pa.schema([(name, pa.string()) for name in ("participant_id", *columns)])
        with path.open("wb") as stream:
            stream.write(header_line(schema.names, TSV))
            for people in _some_at_a_time(_answered(answers, content.labels)):
                stream.write(lines(pa.Table.from_pylist(people, schema), TSV))


def _some_at_a_time(people: Iterator[dict[str, Any]]) -> Iterator[list[dict[str, Any]]]:
    while some := list(islice(people, PEOPLE_AT_ONCE)):
        yield some


def _column(row: Mapping[str, Any]) -> str:
    """Return the column that an answer stands in."""
    return f"lap{row['lap']}_{row['item']}" if row["lap"] >= 0 else f"session_{row['item']}"


def _rows(table: pa.Table) -> Iterator[dict[str, Any]]:
    for batch in table.to_batches(max_chunksize=1000):
        yield from batch.to_pylist()


def _questions(answers: pa.Table, instrument: Instrument) -> dict[str, dict[str, Any]]:
    """Return what each column is, in the order in which questions were asked.

    The condition is named where everybody drove the same one in that lap.
    """
    asked: dict[str, tuple[int, str]] = {}
    conditions: dict[int, set[str]] = {}
    for row in _rows(answers.select(["lap", "item", "condition"])):
        asked.setdefault(_column(row), (row["lap"], row["item"]))
        conditions.setdefault(row["lap"], set()).add(str(row["condition"]))
    columns: dict[str, dict[str, Any]] = {}
    for name, (lap, item_id) in asked.items():
        item = instrument.item(item_id)
        driven = f", {next(iter(conditions[lap]))}" if len(conditions[lap]) == 1 else ""
        when = f"after lap {lap}{driven}" if lap >= 0 else "about the whole session"
        columns[name] = {"Description": f"{item.text} ({when})"}
        if item.answer == "point":
            labels = {str(i): text for i, text in enumerate(instrument.anchors, start=1)}
            columns[name]["Levels"] = labels
    return columns


def _answered(answers: pa.Table, labels: Mapping[str, str]) -> Iterator[dict[str, Any]]:
    """Yield each participant's answers as text by column."""
    for participant, rows in groupby(_rows(answers), lambda row: row["participant"]):
        person: dict[str, Any] = {"participant_id": f"sub-{labels[participant]}"}
        for row in rows:
            given = (row["response"], row["response_number"], row.get("response_text"))
            answer = next((str(value) for value in given if value is not None), None)
            person[_column(row)] = answer
        yield person


def _write_recording(content: Content, folder: Path, lap: LapSteps) -> str:
    """Write a lap's files; return the recording's name from the participant's folder."""
    subject, task = (
        content.labels[str(lap.lap["participant"])],
        file_label(str(lap.lap["condition"])),
    )
    stem = f"sub-{subject}_task-{task}_tracksys-{SYSTEM}_run-{lap.lap['lap']}"
    place = folder / f"sub-{subject}" / "motion"
    place.mkdir(parents=True, exist_ok=True)
    samples = samples_of(lap)
    (place / f"{stem}_motion.tsv").write_bytes(lines(samples, _SAMPLES))
    rows = [
        {"name": c.column, "component": c.component, "type": c.kind, "tracked_point": POINT,
         "units": c.unit}
        for c in CHANNELS
    ]  # fmt: skip
    write_table(place / f"{stem}_channels.tsv", pa.Table.from_pylist(rows), TSV)
    _write_json(place / f"{stem}_motion.json", _recording(content, lap))
    return f"motion/{stem}_motion.tsv"


def samples_of(lap: LapSteps) -> pa.Table:
    """Return a lap's samples: a row per control step, and one for the state after the last."""
    arrays = {}
    for channel in CHANNELS:
        column = lap.steps[channel.column]
        last = None
        if channel.after in lap.steps.column_names and len(column):
            last = lap.steps[channel.after][-1].as_py()
        elif channel.after is not None:
            last = lap.lap[channel.after]
        ending = pa.array([last], column.type)
        arrays[channel.column] = pa.chunked_array([*column.chunks, ending], column.type)
    return pa.table(arrays)


def _recording(content: Content, lap: LapSteps) -> dict[str, Any]:
    kinds = [channel.kind for channel in CHANNELS]
    return {
        "TaskName": file_label(str(lap.lap["condition"])),
        "TaskDescription": f"A lap of {content.study.course_names}, {lap.lap['condition']}",
        "TrackingSystemName": SYSTEM,
        "SamplingFrequency": round(1 / content.study.protocol.control_period_s, 9),
        "RecordingType": "continuous",
        "TrackedPointsCount": 1,
        "MotionChannelCount": len(CHANNELS),
        **{f"{kind}ChannelCount": kinds.count(kind) for kind in sorted(set(kinds))},
        "MissingValues": "n/a",
        "SpatialAxes": "FLU",
    }


def _write_scans(
    content: Content, folder: Path, participant: str, rows: list[dict[str, Any]]
) -> None:
    types = {f.name: f.type for f in content.laps.fields}
    schema = pa.schema([("filename", pa.string()), *((n, types[n]) for n in _SCAN_COLUMNS)])
    subject = f"sub-{content.labels[participant]}"
    kept = [{name: row[name] for name in schema.names} for row in rows]
    write_table(folder / subject / f"{subject}_scans.tsv", pa.Table.from_pylist(kept, schema), TSV)


def _described(field: Field) -> dict[str, Any]:
    entry: dict[str, Any] = {"Description": field.description}
    if field.unit:
        entry["Units"] = field.unit
    if field.values and field.kind == "string":
        entry["Levels"] = {str(value): str(value) for value in field.values}
    return entry


def _write_json(path: Path, data: Any) -> None:
    path.write_text(json.dumps(data, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
