"""A first protocol from five answers, with comments that say what may be changed."""

from dataclasses import dataclass
from importlib.resources import files
from typing import Literal

from jinja2 import Environment, StrictUndefined

from protocols.load import load_instrument

People = Literal["synthetic", "living"]
Help = Literal["own-model", "borrowed-model", "demonstrator"]

_HELPED: dict[Help, tuple[str, ...]] = {
    "own-model": ("human-assisted", "model-assisted"),
    "borrowed-model": ("human-assisted", "model-assisted"),
    "demonstrator": ("human-assisted",),
}


@dataclass(frozen=True, slots=True)
class Answers:
    """What is asked of somebody who begins a study.

    Attributes
    ----------
    name
        Of the study; as ``protocols.files.file_model.Name`` allows it.
    people
        Whether simulated people drive, or living ones in browsers.
    participants
        How many; 1 to 9999.
    help
        Whose help is studied: of a model that each participant teaches, of a model that a pilot
        has taught, or of the demonstrator alone.
    questionnaire
        A shipped questionnaire that is asked after every lap; ``none`` for none.
    """

    name: str
    people: People = "synthetic"
    participants: int = 12
    help: Help = "own-model"
    questionnaire: str = "none"


def draft(answers: Answers, file: str) -> str:
    """Return a protocol in YAML, with comments.

    Parameters
    ----------
    answers
        What the study is.
    file
        Name of the file that it will be written to, for its first comment.

    Raises
    ------
    InputError
        When there is no such questionnaire.
    """
    analysed = ("baseline", "limited", *_HELPED[answers.help])
    template = files("protocols").joinpath("drafts", "study.yaml.j2").read_text("utf-8")
    environment = Environment(
        autoescape=False,  # noqa: S701  # YAML, of a name without special characters
        undefined=StrictUndefined,
        trim_blocks=True,
        keep_trailing_newline=True,
    )
    return environment.from_string(template).render(
        name=answers.name,
        file=file,
        people=answers.people,
        participants=answers.participants,
        help=answers.help,
        questionnaire=answers.questionnaire,
        analysed=analysed,
        questions={c: _items(answers, c) for c in analysed},
    )


def _items(answers: Answers, condition: str) -> str:
    """Return the items asked after a condition's lap, as the file has them; "" for none."""
    if answers.questionnaire == "none":
        return ""
    items = load_instrument(answers.questionnaire).items
    helped = condition in _HELPED[answers.help]
    if helped or all(item.asked != "assisted laps" for item in items):
        return "all"
    return f"[{', '.join(item.id for item in items if item.asked != 'assisted laps')}]"
