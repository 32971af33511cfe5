"""The step table: every stream of every control step, one file per lap."""

import pyarrow as pa

from lad.inputs import INPUT_NAMES, N_SEGMENTS
from protocols.record.column import Column, arrow_schema

_F = pa.float64()
_POSITIVE_RIGHT = "from right (-90 degrees) to left (+90 degrees)"

_INPUTS = (
    Column("user_v", _F, "Driver's command after the limitation (input 0 of the model)", "m/s"),
    Column("user_w", _F, "Driver's command after the limitation (input 1 of the model)", "rad/s"),
    Column("velocity_v", _F, "Measured velocity at the start of the step (input 2)", "m/s"),
    Column("velocity_w", _F, "Measured velocity at the start of the step (input 3)", "rad/s"),
    *(
        Column(
            f"segment_{i:02d}",
            _F,
            f"Nearest laser return in segment {i} of {N_SEGMENTS}, {_POSITIVE_RIGHT}",
            "m",
            "0 to 4",
        )
        for i in range(N_SEGMENTS)
    ),
)

_LINK = (
    Column("driver_device", pa.string(), "What a living driver steers with", "",
           "keyboard, gamepad, touch", nullable=True, since=2),
    Column("driver_sent_age_s", _F, "From the moment a living driver's newest input was sent to "
           "the step, by the sender's clock", "s", nullable=True, since=2),
    Column("driver_round_trip_s", _F, "Newest round trip to a living driver's machine", "s",
           "0 or more", nullable=True, since=2),
    Column("driver_frames", pa.int16(), "Pictures drawn on that machine since its last message",
           "", "0 or more", nullable=True, since=2),
    Column("driver_attentive", pa.bool_(), "Whether the living driver's page was visible and had "
           "the focus", nullable=True, since=2),
    Column("demonstrator_device", pa.string(), "What a living demonstrator steers with", "",
           "keyboard, gamepad, touch", nullable=True, since=2),
    Column("demonstrator_sent_age_s", _F, "As for the driver", "s", nullable=True, since=2),
    Column("demonstrator_round_trip_s", _F, "As for the driver", "s", "0 or more", nullable=True,
           since=2),
    Column("demonstrator_v", _F, "A living demonstrator's stick forward, clutch or not, as a share "
           "of full deflection", "", "-1 to 1", nullable=True, since=2),
    Column("demonstrator_w", _F, "The same to the left", "", "-1 to 1", nullable=True, since=2),
)  # fmt: skip

STEP_COLUMNS: tuple[Column, ...] = (
    Column("step", pa.int32(), "Control step, counted from 0", "", "0 or more"),
    Column("t_s", _F, "Time from lap start to the start of the step", "s", "0 or more"),
    *_INPUTS,
    Column("intent_v", _F, "Driver's command before the limitation", "m/s"),
    Column("intent_w", _F, "Driver's command before the limitation", "rad/s"),
    Column("h", pa.int8(), "Demonstrator's takeover signal; missing in laps it does not drive, and "
           "where it lets the model that it corrects drive", "", "-1, +1", nullable=True),
    Column("a_v", _F, "Demonstrator's command; missing where h is not +1", "m/s", nullable=True),
    Column("a_w", _F, "Demonstrator's command; missing where h is not +1", "rad/s", nullable=True),
    Column("h_would", pa.int8(), "What the demonstrator does or, as a shadow, would do", "",
           "-1, +1", nullable=True),
    Column("would_v", _F, "Command the demonstrator gives or would give; missing where h_would "
           "is not +1", "m/s", nullable=True),
    Column("would_w", _F, "Command the demonstrator gives or would give; missing where h_would "
           "is not +1", "rad/s", nullable=True),
    Column("p_help", _F, "Model's p(h = 1 | x) before it learns from the step; missing without a "
           "model", "", "0 to 1", nullable=True),
    Column("mean_v", _F, "Model's predicted assistive command", "m/s", nullable=True),
    Column("mean_w", _F, "Model's predicted assistive command", "rad/s", nullable=True),
    Column("variance", _F, "Model's predictive variance of either component, noise included",
           "(m/s)^2, (rad/s)^2", "above 0", nullable=True),
    Column("control", pa.string(), "Whose command counted: the driver's alone, or with or instead "
           "of it the assistant's", "", "driver, demonstrator, model"),
    Column("arbitrated_v", _F, "Command after arbitration", "m/s"),
    Column("arbitrated_w", _F, "Command after arbitration", "rad/s"),
    Column("executed_v", _F, "Command after the safeguard, as sent to the chair", "m/s"),
    Column("executed_w", _F, "Command after the safeguard, as sent to the chair", "rad/s"),
    Column("safeguarded", pa.bool_(), "Whether the safeguard changed the command"),
    Column("result_v", _F, "Velocity at the end of the step", "m/s"),
    Column("result_w", _F, "Velocity at the end of the step", "rad/s"),
    Column("x_m", _F, "Ground-truth position at the start of the step", "m"),
    Column("y_m", _F, "Ground-truth position at the start of the step", "m"),
    Column("heading_rad", _F, "Ground-truth heading at the start of the step", "rad"),
    Column("arc_m", _F, "Arc length of the nearest point of the centreline", "m", "0 or more"),
    Column("offset_m", _F, "Signed distance from the centreline, left positive", "m"),
    Column("section", pa.string(), "Name of the course section"),
    Column("section_kind", pa.string(), "Kind of the course section", "",
           "straight, sharp_right, soft_right, left"),
    Column("clearance_m", _F, "Distance from the chair's footprint to the nearest obstacle", "m",
           "0 or more"),
    Column("contact", pa.bool_(), "Whether the chair touched an obstacle during the step"),
    Column("input_age_s", _F, "How old the driver's command is that was used; 0 for one given in "
           "this step", "s", "0 or more", nullable=True, since=2),
    Column("late_s", _F, "From the moment the step was due to the moment it started; missing in "
           "simulated time", "s", "0 or more", nullable=True, since=2),
    Column("shift_s", _F, "By how much the lap's zero moved before the step because it was late; "
           "missing in simulated time", "s", "0 or more", nullable=True, since=2),
    *_LINK,
    Column("result_x_m", _F, "Ground-truth position at the end of the step", "m", nullable=True,
           since=2),
    Column("result_y_m", _F, "Ground-truth position at the end of the step", "m", nullable=True,
           since=2),
    Column("result_heading_rad", _F, "Ground-truth heading at the end of the step", "rad",
           nullable=True, since=2),
    Column("h_inferred", _F, "p(h = +1) as inferred after the lap by a model that is not shown h; "
           "missing where it is shown", "", "0 to 1", nullable=True, since=2),
)  # fmt: skip

STEP_SCHEMA = arrow_schema(STEP_COLUMNS)

if tuple(c.name for c in _INPUTS) != INPUT_NAMES:  # pragma: no cover - a slip while editing
    raise AssertionError("the record must name the model's inputs as the model does")
