"""The study's tables of participants, laps and survey answers."""

import pyarrow as pa

from protocols.record.column import Column, arrow_schema
from protocols.record.rows import ASSISTANT_ROLES, END_REASONS

_F = pa.float64()
_ID = Column("participant", pa.string(), "Participant number, e.g. P0001")

GENDERS = ("female", "male", "other", "undisclosed")
HANDEDNESS = ("right", "left", "both", "undisclosed")

PARTICIPANT_COLUMNS: tuple[Column, ...] = (
    _ID,
    Column("kind", pa.string(), "What the driver was", "", "synthetic, scripted, live"),
    Column("driver", pa.string(), "Driver as the protocol names it"),
    Column("impairment", pa.string(), "Participant's own impairment", "", "none, or its name"),
    Column("age_years", pa.int16(), "Age", "years", nullable=True),
    Column("gender", pa.string(), "Gender", "", ", ".join(GENDERS), nullable=True),
    Column("handedness", pa.string(), "Handedness", "", ", ".join(HANDEDNESS), nullable=True),
    Column("traits", pa.map_(pa.string(), _F), "A synthetic driver's and respondent's traits, by "
           "name; units are part of the names"),
    Column("consented", pa.bool_(), "Whether consent was given (synthetic participants: always)"),
    Column("completed", pa.bool_(), "Whether every planned lap was driven to its end"),
    Column("laps_planned", pa.int16(), "Laps in the protocol", "", "1 or more"),
    Column("laps_driven", pa.int16(), "Laps begun", "", "0 or more"),
    Column("excluded", pa.bool_(), "Whether the protocol's exclusion rules apply"),
    Column("exclusion_reason", pa.string(), "The rule that applied; missing when not excluded",
           nullable=True),
    Column("order", pa.string(), "Order of the analysed laps that the participant was given: "
           "conditions with > between them", nullable=True, since=2),
    Column("group", pa.string(), "Group of the participant; missing in a study without groups",
           nullable=True, since=2),
)  # fmt: skip

LAP_COLUMNS: tuple[Column, ...] = (
    _ID,
    Column("lap", pa.int16(), "Position in the session, counted from 0", "", "0 or more"),
    Column("condition", pa.string(), "Condition as the protocol names it"),
    Column("practice", pa.bool_(), "Whether the lap is for familiarisation and not analysed"),
    Column("limited", pa.bool_(), "Whether the control limitation was on"),
    Column("assistant", pa.string(), "Who could help", "", ", ".join(ASSISTANT_ROLES)),
    Column("training", pa.bool_(), "Whether the model learnt during the lap"),
    Column("completed", pa.bool_(), "Whether the lap reached its last gate"),
    Column("end_reason", pa.string(), "Why the lap ended", "", ", ".join(END_REASONS)),
    Column("withdrawal", pa.string(), "A withdrawal in the participant's words", nullable=True),
    Column("lap_time_s", _F, "Time from start to the last gate; missing for an unfinished lap",
           "s", "above 0", nullable=True),
    Column("duration_s", _F, "Time from start to the end of the lap, finished or not", "s"),
    Column("steps", pa.int32(), "Control steps recorded", "", "1 or more"),
    Column("collisions", pa.int32(), "Number of contacts with obstacles", "", "0 or more"),
    Column("contact_time_s", _F, "Time in contact with obstacles", "s", "0 or more"),
    Column("assisted_fraction", _F, "Share of steps in which an assistant's command counted", "",
           "0 to 1"),
    Column("interventions", pa.int32(), "Number of unbroken stretches of assistance", "",
           "0 or more"),
    Column("gates_passed", pa.int16(), "Gates crossed in order", "", "0 or more"),
    Column("basis_vectors_when", pa.int32(), "Basis vectors of the classifier at the lap's end",
           nullable=True),
    Column("basis_vectors_how", pa.int32(), "Basis vectors of the regressor at the lap's end",
           nullable=True),
    Column("seed", pa.uint64(), "Fingerprint of the lap's random numbers"),
    Column("stop_reason", pa.string(), "Why the lap was stopped, as the experimenter wrote it",
           nullable=True, since=2),
    Column("pauses", pa.int32(), "How often the lap was paused; missing in simulated time", "",
           "0 or more", nullable=True, since=2),
    Column("paused_s", _F, "How long it was paused in all; not part of any other time", "s",
           "0 or more", nullable=True, since=2),
    Column("late_share", _F, "Share of steps that started more than 50 ms late; missing in "
           "simulated time", "", "0 to 1", nullable=True, since=2),
    Column("input_age_p99_s", _F, "99th percentile of the age of a living driver's command; "
           "missing for a simulated driver", "s", "0 or more", nullable=True, since=2),
    Column("last_segments", pa.list_(pa.field("element", _F)), "Laser segments after the last "
           "step, from right to left", "m", "0 to 4", nullable=True, since=2),
    Column("place", pa.int16(), "Position among the participant's analysed laps, counted from 1; "
           "missing for practice", "", "1 or more", nullable=True, since=2),
    Column("tuned_steps", pa.int32(), "Taught steps from which the model's hyperparameters were "
           "chosen at the lap's start; missing where none were chosen", "", "40 or more",
           nullable=True, since=2),
    *(
        Column(f"tuned_{name}", _F, f"{what}, as chosen by evidence; missing as tuned_steps is",
               unit, nullable=True, since=2)
        for name, what, unit in (
            ("signal_variance_when", "Classifier's sigma_f^2", ""),
            ("signal_variance_how", "Regressor's sigma_f^2", "(m/s)^2, (rad/s)^2"),
            ("constant_variance_how", "Regressor's sigma_c^2", "(m/s)^2, (rad/s)^2"),
            ("noise_how", "Regressor's sigma_n^2", "(m/s)^2, (rad/s)^2"),
            ("lengthscale_user_how", "Regressor's lengthscale of the user's command",
             "m/s, rad/s"),
            ("lengthscale_velocity_how", "Regressor's lengthscale of the velocities",
             "m/s, rad/s"),
            ("lengthscale_laser_how", "Regressor's lengthscale of the laser segments", "m"),
        )
    ),
)  # fmt: skip

SURVEY_COLUMNS: tuple[Column, ...] = (
    _ID,
    Column("lap", pa.int16(), "Lap the answer is about; -1 for the whole session"),
    Column("condition", pa.string(), "Condition of that lap; (session) for the whole session"),
    Column("instrument", pa.string(), "Instrument as the protocol names it"),
    Column("item", pa.string(), "Item of the instrument, e.g. Q7"),
    Column("response", pa.int8(), "Answer on the item's scale, as given (reverse-coded items are "
           "not turned); missing when not answered", "", "1 to the scale's points", nullable=True),
    Column("response_number", _F, "Answer to an item that asks for a number", nullable=True,
           since=2),
    Column("response_text", pa.string(), "Answer to an item that asks for text", nullable=True,
           since=2),
    Column("response_time_s", _F, "From the moment a living person was shown the item to the last "
           "change of the answer, by the browser's clock", "s", "0 or more", nullable=True,
           since=2),
)  # fmt: skip

EVENT_COLUMNS: tuple[Column, ...] = (
    _ID,
    Column("lap", pa.int16(), "Lap in which it happened; missing between laps", nullable=True),
    Column("step", pa.int32(), "Control steps driven by then", nullable=True),
    Column("utc", pa.string(), "When, ISO 8601 in UTC"),
    Column("actor", pa.string(), "Who did it", "",
           "participant, demonstrator, experimenter, program"),
    Column("event", pa.string(), "What happened, e.g. pause, resume, connected, disconnected"),
    Column("note", pa.string(), "Why, in words", nullable=True),
)  # fmt: skip

EVENT_SCHEMA = arrow_schema(EVENT_COLUMNS)
PARTICIPANT_SCHEMA = arrow_schema(PARTICIPANT_COLUMNS)
LAP_SCHEMA = arrow_schema(LAP_COLUMNS)
SURVEY_SCHEMA = arrow_schema(SURVEY_COLUMNS)
