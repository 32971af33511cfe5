"""`study.html`: every lap time as a point, and the lap behind it."""

from collections.abc import Iterator
from typing import Any

from analysis.lap_pages.lap_data import LapOf, lap_data, lap_label, lap_of
from analysis.lap_pages.page import render_laps
from analysis.measures.streams import Steps
from analysis.results import StudyResults
from protocols.files.errors import InputError

STUDY_PAGE = "study.html"

MOST_STEPS = 40_000
"""Steps of all laps in the page: about 4 MB. Twelve people's four laps have 26 thousand."""


def analysed_laps(results: StudyResults) -> tuple[LapOf, ...]:
    """Return every analysed lap, by participant and lap."""
    laps = results.frames.laps.sort_values(["participant", "lap"], kind="stable")
    return tuple(lap_of(row) for row in laps.to_dict("records"))


def held_laps(results: StudyResults) -> tuple[LapOf, ...]:
    """Return the laps that the page holds: whole people, evenly among all, while there is room.

    They are every analysed lap of a small study. What a large one leaves out, ``lad-study replay``
    draws from the record.
    """
    laps = analysed_laps(results)
    steps = results.records.steps
    placed = steps[steps["x_m"].notna()]  # positions that do not fit the course are missing here
    lengths = placed.groupby(["participant", "lap"], observed=True).size()
    rows = lengths.reset_index(name="steps").itertuples(index=False)
    length = {(str(who), int(lap)): int(n) for who, lap, n in rows if n > 1}
    shown = [one for one in laps if (one.participant, one.lap) in length]
    needed: dict[str, int] = {}
    for one in shown:
        needed[one.participant] = needed.get(one.participant, 0) + length[one.participant, one.lap]
    every = max(1, -(-sum(needed.values()) // MOST_STEPS))
    room, kept = MOST_STEPS, set[str]()
    for who in list(needed)[::every]:
        if needed[who] <= room:
            kept.add(who)
            room -= needed[who]
    return tuple(one for one in shown if one.participant in kept)


def study_page(results: StudyResults) -> str | None:
    """Return the page; None where no lap has steps with positions on the course."""
    study = results.frames.study
    held = [data for one in held_laps(results) for data in _data(results, one)]
    if not held:
        return None
    every = analysed_laps(results)
    left = len(every) - len(held)
    remark = f"{len(held)} of {len(every)} analysed laps are in this page" + (
        f"; {left} can be drawn with lad-study replay." if left else "."
    )
    return render_laps(
        study.protocol.title,
        study.courses,
        held,
        [held[0]["key"]],
        points=[lap_label(one) for one in every],
        remark=remark,
    )


def _data(results: StudyResults, one: LapOf) -> Iterator[dict[str, Any]]:
    """Yield a lap's data; nothing where its steps cannot be shown."""
    study = results.frames.study
    try:
        table, _, _ = study.lap_steps(one.participant, one.lap, against_lap=False)
    except InputError:  # damaged: the report says so
        return
    yield lap_data(one, Steps(table), study.course_of(one.participant))
