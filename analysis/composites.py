"""Composite scores: the mean of a subscale's items, on the instrument's own scale of scores."""

import pandas as pd

from analysis.frames import StudyFrames
from protocols.instrument import Instrument, Item


def subscales(instrument: Instrument) -> tuple[str, ...]:
    """Return the subscales that have a score, in order: text and attention checks have none."""
    return tuple(dict.fromkeys(i.subscale for i in instrument.items if i.scored))


def items_of(instrument: Instrument, subscale: str) -> list[Item]:
    """Return the items of a subscale that count in its score."""
    return [i for i in instrument.items if i.subscale == subscale and i.scored]


def sheets(
    frames: StudyFrames, instrument: Instrument, subscale: str, condition: str
) -> pd.DataFrame:
    """Return answers to a subscale after a condition, reverse-coded items turned.

    Returns
    -------
    DataFrame
        Participants by items; items that were not asked after the condition are no columns.
    """
    items = items_of(instrument, subscale)
    answers = frames.surveys
    chosen = (
        (answers["instrument"] == instrument.name)
        & (answers["condition"] == condition)
        & answers["item"].isin([item.id for item in items])
    )
    given = answers[chosen]
    given = given.assign(value=answered(given))
    table = given.pivot_table(index="participant", columns="item", values="value", dropna=False)
    for item in items:
        if item.reverse and item.id in table:
            lowest, highest = instrument.range_of(item)
            table[item.id] = lowest + highest - table[item.id]
    return table


def answered(answers: pd.DataFrame) -> pd.Series:
    """Return answers as numbers, points of a scale and numbers alike; missing ones as NaN."""
    points = pd.to_numeric(answers["response"]).astype("float64")
    if "response_number" not in answers:
        return points
    return points.fillna(pd.to_numeric(answers["response_number"]).astype("float64"))


def scores(frames: StudyFrames, instrument: Instrument, subscale: str, condition: str) -> pd.Series:
    """Return composite scores after a condition, by participant.

    Who left an item out, or was not asked, has no score.
    """
    table = sheets(frames, instrument, subscale, condition)
    means = table.dropna().mean(axis=1)
    if instrument.score is None or not len(means):
        return means
    low, high = instrument.score
    lowest, highest = instrument.range_of(items_of(instrument, subscale)[0])
    return low + (means - lowest) * ((high - low) / (highest - lowest))


def scores_by_participant(
    frames: StudyFrames, instrument: Instrument, subscale: str
) -> pd.DataFrame:
    """Return composite scores: rows participants, columns conditions."""
    found = {c: scores(frames, instrument, subscale, c) for c in frames.conditions}
    return pd.DataFrame(found, index=sorted(frames.participants["participant"]), dtype="float64")
