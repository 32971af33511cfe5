"""The least a study recorded elsewhere must have, table by table."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from protocols.record.column import Column
from protocols.record.steps import STEP_COLUMNS
from protocols.record.tables import LAP_COLUMNS, PARTICIPANT_COLUMNS, SURVEY_COLUMNS


class Range(NamedTuple):
    """Which finite numbers are allowed, and their words in a message.

    Attributes
    ----------
    low, high
        Ends; None for no end.
    words
        As in a message.
    open_low
        Whether ``low`` itself is not allowed.
    """

    low: float
    high: float | None
    words: str
    open_low: bool = False


_COUNT = Range(0, None, "0 or more")
_SHARE = Range(0, 1, "0 to 1")


@dataclass(frozen=True, slots=True)
class TableRules:
    """What is asked of a table that another program wrote.

    Attributes
    ----------
    columns
        The table as this version records it. Columns that are not there are missing throughout.
    required
        Columns that must be there, without a missing value unless they are measurements (floats)
        or the schema allows one.
    key
        Columns that together name a row: no two rows may agree in all of them.
    ranges
        Columns of numbers, and which ones are allowed where they are not missing.
    clocks
        Columns of seconds in which a date and time or a duration is understood, too.
    """

    columns: tuple[Column, ...]
    required: tuple[str, ...]
    key: tuple[str, ...] = ()
    ranges: Mapping[str, Range] = field(default_factory=dict)
    clocks: tuple[str, ...] = ()


PARTICIPANTS = TableRules(PARTICIPANT_COLUMNS, ("participant",), key=("participant",))
LAPS = TableRules(
    LAP_COLUMNS,
    ("participant", "lap", "condition", "completed", "lap_time_s"),
    key=("participant", "lap"),
    ranges={
        "lap": _COUNT,
        "lap_time_s": Range(0, None, "above 0", open_low=True),
        "duration_s": _COUNT,
        "collisions": _COUNT,
        "contact_time_s": _COUNT,
        "interventions": _COUNT,
        "assisted_fraction": _SHARE,
    },
)
SURVEYS = TableRules(
    SURVEY_COLUMNS,
    ("participant", "lap", "condition", "instrument", "item", "response"),
    key=("participant", "lap", "instrument", "item"),
    ranges={"lap": Range(-1, None, "0 or more, or -1 for the whole session")},
)
STEPS = TableRules(STEP_COLUMNS, ("t_s", "x_m", "y_m"), clocks=("t_s",))
