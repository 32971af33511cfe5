"""How living people take part: what a protocol says about it."""

from typing import Annotated, Literal

from pydantic import Field

from protocols.files.file_model import FileModel
from protocols.pages import Text

View = Literal["first-person", "plan"]
DemonstratorView = Literal["above", "participant"]
OnInterruption = Literal["resume", "restart", "exclude"]
Device = Literal["keyboard", "gamepad", "touch"]


class MachineCheck(FileModel):
    """What is asked of a participant's machine before anything else.

    Attributes
    ----------
    max_round_trip_ms
        Longest median round trip between browser and server, ms.
    min_frame_rate
        Lowest rate at which the browser draws, 1/s.
    rule
        Whether a machine that fails is refused, or flagged in the record.
    """

    max_round_trip_ms: Annotated[float, Field(gt=0, le=5000)] = 150.0
    min_frame_rate: Annotated[float, Field(gt=0, le=240)] = 20.0
    rule: Literal["refuse", "flag"] = "flag"


class Completion(FileModel):
    """Where a participant from a recruitment platform goes at the end.

    Attributes
    ----------
    code
        Shown to the participant; null for none.
    url
        A link back to the platform; null for none.
    """

    code: Annotated[str, Field(min_length=1, max_length=80)] | None = None
    url: Annotated[str, Field(pattern=r"^https://[^\s\"<>]+$", max_length=500)] | None = None


class QuestionPages(FileModel):
    """How living people are asked what the instruments ask.

    Attributes
    ----------
    page
        Whether a page holds a whole instrument, or one item.
    required
        Whether a page can only be left with every question on it answered. Where it can be left
        otherwise, what was not answered is recorded as missing.
    """

    page: Literal["instrument", "item"] = "instrument"
    required: bool = False


class LiveSettings(FileModel):
    """What living people see and may do.

    Attributes
    ----------
    view
        What the participant drives by; a browser without WebGL gets the plan.
    show_lap_time
        Whether the participant sees the lap time while driving.
    demonstrator_view
        What the demonstrator watches.
    demonstrator_sees_p_help
        Whether the demonstrator sees the model's p(h = 1 | x).
    clutch
        Whether the demonstrator's takeover lasts while a key is held, or is switched by it.
    shadow
        Whether a living demonstrator watches the laps of other conditions too and presses the
        clutch where it would help.
    on_interruption
        What happens to a lap whose participant's connection was lost: it waits and is resumed; it
        ends and is driven again; it ends, and the next stage follows.
    machine_check
        What is asked of a participant's machine.
    instructions
        Shown before the first lap, beside the picture of the controls; null for the shipped text.
    questions
        How the instruments are asked.
    withdrawal
        What happens to the data of a participant who stops: kept, or purged.
    completion
        What a participant from a recruitment platform gets at the end.
    allocation
        Whether the console shows what the next participant will get, or keeps it back until they
        have begun, so that nobody can choose who comes next by it. Where every slot is alike there
        is nothing to keep back.
    id_parameters
        Names of the link's parameters that identify a person to a recruitment platform; they are
        stored apart from the study.
    """

    view: View = "first-person"
    show_lap_time: bool = False
    demonstrator_view: DemonstratorView = "above"
    demonstrator_sees_p_help: bool = False
    clutch: Literal["hold", "toggle"] = "hold"
    shadow: bool = False
    on_interruption: OnInterruption = "resume"
    machine_check: MachineCheck = MachineCheck()
    instructions: Text | None = None
    questions: QuestionPages = QuestionPages()
    withdrawal: Literal["keep", "purge"] = "keep"
    completion: Completion | None = None
    allocation: Literal["concealed", "shown"] = "concealed"
    id_parameters: Annotated[
        tuple[Annotated[str, Field(pattern=r"^[A-Za-z_][A-Za-z0-9_]{0,39}$")], ...],
        Field(max_length=8),
    ] = ("PROLIFIC_PID", "STUDY_ID", "SESSION_ID")
