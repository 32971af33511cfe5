"""The learning assistant a protocol names, and what the record keeps of it."""

from collections.abc import Mapping, Sequence
from typing import Any

from lad.assistant import Assistant
from lad.errors import HyperparameterError
from lad.lad_assistant import LADAssistant
from participants.part_loader import load_factory, refuse_missing_methods
from protocols.code_beside import PartBeside
from protocols.files.errors import InputError
from protocols.model_choice import ModelChoice
from protocols.shipped_parts import WITH_PARAMETERS


def make_model(
    choice: ModelChoice,
    words: Mapping[str, str] | None = None,
    code: Sequence[PartBeside] = (),
) -> Assistant:
    """Return the assistant that learns in a study.

    The factory of any but ``lad`` takes the protocol's options as keyword arguments.

    Parameters
    ----------
    choice
        As the protocol has it.
    words
        The values of words in braces in an option that is text: ``{participant}`` for the
        participant's id, ``{folder}`` for the folder where relative paths start.
    code
        The parts beside the protocol file that may be run.

    Raises
    ------
    InputError
        When it cannot be imported, does not take its parameters or options, or is no assistant.
    """
    if choice.use in WITH_PARAMETERS:
        try:
            shipped: Assistant = load_factory("model", choice.use)(choice.parameters)
        except HyperparameterError as error:
            raise InputError(str(error)) from None
        return shipped
    factory = load_factory("model", choice.use, code)
    try:
        made = factory(**_filled_in(choice.options, words or {}))
    except Exception as error:  # other people's code may fail in any way
        reason = f"{type(error).__name__}: {error}"
        raise InputError(f"model {choice.use!r}: cannot be made ({reason})") from error
    refuse_missing_methods("model", choice.use, made, ("start_lap", "assist"))
    assistant: Assistant = made
    return assistant


def _filled_in(options: Mapping[str, Any], words: Mapping[str, str]) -> dict[str, Any]:
    filled = dict(options)
    for name, value in options.items():
        for word, said in words.items() if isinstance(value, str) else ():
            filled[name] = filled[name].replace(f"{{{word}}}", said)
    return filled


def saved(model: Assistant) -> bytes | None:
    """Return a model's portable bytes; None for one that cannot be saved."""
    to_bytes = getattr(model, "to_bytes", None)
    return to_bytes() if callable(to_bytes) else None


def tuned_fields(model: Assistant) -> dict[str, Any]:
    """Return the lap row's fields about hyperparameters chosen by evidence; empty without any."""
    tuned = model.tuned if isinstance(model, LADAssistant) else None
    if tuned is None:
        return {}
    user, _, velocity, _, laser = tuned.how.lengthscales[:5]
    return {
        "tuned_steps": tuned.steps,
        "tuned_signal_variance_when": tuned.when.signal_variance,
        "tuned_signal_variance_how": tuned.how.signal_variance,
        "tuned_constant_variance_how": tuned.how.constant_variance,
        "tuned_noise_how": tuned.how.noise_variance,
        "tuned_lengthscale_user_how": user,
        "tuned_lengthscale_velocity_how": velocity,
        "tuned_lengthscale_laser_how": laser,
    }


def basis_vectors(model: Assistant) -> dict[str, Any]:
    """Return the lap row's fields about the model's size; empty for a model without any."""
    if not isinstance(model, LADAssistant):
        return {}
    return {"basis_vectors_when": model.when.n_basis, "basis_vectors_how": model.how.n_basis}
