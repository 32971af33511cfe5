"""Variants of the model; a study of robustness compares their results with the default's."""

from dataclasses import dataclass
from typing import Any

from lad.hyperparameters import LADParameters
from protocols.model_choice import ModelChoice


@dataclass(frozen=True, slots=True)
class Variant:
    """Another model than the default one.

    Attributes
    ----------
    name
        Unique; usable as a folder's name.
    group
        What is varied.
    label
        How tables and figures call it within its group.
    model
        As in a protocol.
    same_probabilities
        Whether p(h = 1 | x) is the default model's, and only its use differs.
    """

    name: str
    group: str
    label: str
    model: ModelChoice
    same_probabilities: bool = False


def _shipped(
    name: str, group: str, label: str, *, same_probabilities: bool = False, **changes: Any
) -> Variant:
    model = ModelChoice(parameters=LADParameters(**changes))
    return Variant(name, group, label, model, same_probabilities)


def _scaled(field: str, symbol: str, what: str) -> tuple[Variant, ...]:
    table_i = getattr(LADParameters(), field)
    return tuple(
        _shipped(f"{field}-{word}", f"lengthscale of {what}", f"{symbol} = {factor * table_i:g}",
                 **{field: factor * table_i})
        for word, factor in (("halved", 0.5), ("doubled", 2.0))
    )  # fmt: skip


def _baseline(name: str, label: str, factory: str) -> Variant:
    return Variant(name, "baseline", label, ModelChoice(use=f"lad.baselines.{factory}"))


DEFAULT = _shipped("default", "default", "Table I")
"""The paper's Table I, the predictive probability of probit regression."""

BASELINES = (
    _baseline("linear", "logistic + linear regression", "linear:make"),
    _baseline("neighbours", "5 nearest neighbours", "neighbours:make"),
    _baseline("network", "neural network, online", "network:make"),
    _baseline("network-refitted", "neural network, refitted", "network:make_refitted"),
    _baseline("memoryless", "memoryless GP (τ = 1)", "memoryless:make"),
)
"""Simpler models; see ``lad.baselines``."""

VARIANTS = (
    DEFAULT,
    _shipped("probability-paper", "probability", "equation (10)", probability="paper"),
    *(
        _shipped(f"threshold-{w}", "threshold", f"W_h = {w}", threshold=w, same_probabilities=True)
        for w in (0.3, 0.4, 0.6, 0.7)
    ),
    *(_shipped(f"capacity-{c}", "capacity", f"C = {c}", capacity=c) for c in (100, 200)),
    *(_shipped(f"depth-{t}", "recursion depth", f"τ = {t}", recursion_depth=t) for t in (2, 8)),
    *_scaled("lengthscale_user", "l_U", "the user's command"),
    *_scaled("lengthscale_velocity", "l_A", "the velocities"),
    *_scaled("lengthscale_laser", "l_E", "the laser"),
    _shipped(
        "reach",
        "reading of Table I",
        "M = diag(l)^-1",
        lengthscale_user=0.1**0.5,
        lengthscale_laser=2.0**0.5,
    ),
    Variant("correction", "learns a - u", "lad-correction", ModelChoice(use="lad-correction")),
    Variant(
        "correction-evidence",
        "learns a - u",
        "lad-correction, tuned",
        ModelChoice(use="lad-correction", parameters=LADParameters(tune="evidence")),
    ),
    *BASELINES,
)
"""The default first. Its own values (W_h 0.5, capacity 400, tau 4) are in no group; tau = 1 is the
memoryless process among the baselines."""
