"""Values in a study's tables that no analysis can use; tables of other programs may have some."""

from collections.abc import Iterator

import pandas as pd

from analysis.frames import StudyFrames, as_frame, counted_answers, counted_laps
from protocols.laps import WHOLE_SESSION
from protocols.record.elsewhere.joined import unlike_completed
from protocols.record.elsewhere.people import strangers


def left_out(frames: StudyFrames) -> tuple[str, ...]:
    """Name every row or value that is in no analysis although its participant is, in words.

    Practice laps are not named: that they are not analysed is the protocol's choice.
    """
    return (*_laps(frames), *_answers(frames), *frames.study.strays)


def _laps(frames: StudyFrames) -> Iterator[str]:
    study = frames.study
    yield from _strangers(frames, as_frame(study.laps), "lap")
    laps = counted_laps(study, frames.participants["participant"])
    yield from _conditions(frames, laps, "lap")
    laps = laps[laps["condition"].isin(frames.conditions)]
    timed = laps["lap_time_s"].notna().to_numpy()
    yield from unlike_completed(laps["completed"].to_numpy(dtype=bool), timed)


def _answers(frames: StudyFrames) -> Iterator[str]:
    study = frames.study
    yield from _strangers(frames, frames.answers, "answer")
    answers = counted_answers(study, frames.answers, frames.participants["participant"])
    yield from _conditions(frames, answers, "answer")
    items = {instrument.name: instrument.ids(assisted=True) for instrument in study.instruments}
    yield from _unknown(answers["instrument"], set(items), "answer", "instruments")
    for name, known in items.items():
        given = answers.loc[answers["instrument"] == name, "item"]
        yield from _unknown(given, set(known), "answer", f"items of {name}")
    earlier = len(answers) - len(frames.surveys)
    if earlier:
        n = _number(earlier, "earlier answer")
        yield f"{n} where a condition was driven more than once (the last one given counts)"


def _strangers(frames: StudyFrames, rows: pd.DataFrame, what: str) -> Iterator[str]:
    n, names = strangers(rows["participant"], frames.everybody["participant"])
    if n:
        yield f"{_number(n, what)} of people who are not in the table of participants ({names})"


def _conditions(frames: StudyFrames, rows: pd.DataFrame, what: str) -> Iterator[str]:
    study = {*frames.study.protocol.conditions, WHOLE_SESSION}
    yield from _unknown(rows["condition"], study, what, "conditions")
    used = [*frames.conditions, WHOLE_SESSION]
    unplanned = rows["condition"].isin(study) & ~rows["condition"].isin(used)
    if unplanned.any():
        names = _names(rows.loc[unplanned, "condition"])
        n = _number(int(unplanned.sum()), what)
        yield f"{n} of conditions that are not planned, or for practice only ({names})"


def _unknown(values: pd.Series, known: set[str], rows: str, what: str) -> Iterator[str]:
    unknown = values[~values.isin(known)]
    if len(unknown):
        n = _number(len(unknown), rows)
        yield f"{n} of {what} that the study does not have ({_names(unknown)})"


def _names(values: pd.Series) -> str:
    return ", ".join(sorted(set(map(str, values))))


def _number(n: int, one: str) -> str:
    return f"{n} {one}" if n == 1 else f"{n} {one}s"
