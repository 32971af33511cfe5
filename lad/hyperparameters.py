"""Every number a person may choose about the model, checked in one place.

``LADParameters`` is what a study protocol writes down (Table I of Soh & Demiris is the default);
``GPHyperparameters`` is what one Gaussian process is built from.
"""

import math
from numbers import Real
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError
from scipy.special import ndtri

from lad.errors import HyperparameterError
from lad.inputs import N_SEGMENTS


def _number(value: object) -> object:
    """Refuse what pydantic would silently turn into a number (text, truth values)."""
    if isinstance(value, bool) or not isinstance(value, Real):
        message = "Input should be a number"
        raise ValueError(message)  # noqa: TRY004  # pydantic turns ValueError into a located error
    return value.item() if hasattr(value, "item") else value


def _sequence(value: object) -> object:
    """Accept lists and arrays where a tuple is kept."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    return tuple(value) if isinstance(value, list) else value


TemporalScale = Annotated[
    float, Field(ge=1e-6, le=1e6, allow_inf_nan=False), BeforeValidator(_number)
]
Lengthscale = Annotated[
    float, Field(ge=1e-9, le=1e12, allow_inf_nan=False), BeforeValidator(_number)
]
Variance = Annotated[float, Field(ge=1e-9, le=1e9, allow_inf_nan=False), BeforeValidator(_number)]
NoVariance = Annotated[float, Field(ge=0, le=1e9, allow_inf_nan=False), BeforeValidator(_number)]
Mean = Annotated[float, Field(ge=-1e9, le=1e9, allow_inf_nan=False), BeforeValidator(_number)]
Probability = Annotated[
    float, Field(ge=0.001, le=0.999, allow_inf_nan=False), BeforeValidator(_number)
]
Novelty = Annotated[float, Field(gt=0, lt=1, allow_inf_nan=False), BeforeValidator(_number)]
Capacity = Annotated[int, Field(ge=1, le=20_000), BeforeValidator(_number)]
Laps = Annotated[int, Field(ge=1, le=1_000), BeforeValidator(_number)]
RecursionDepth = Annotated[int, Field(ge=1, le=1_000), BeforeValidator(_number)]
Threshold = Annotated[float, Field(ge=0, le=1, allow_inf_nan=False), BeforeValidator(_number)]


def _one_line(model: type[BaseModel], error: ValidationError) -> str:
    """Return in one line what was given and what is allowed."""
    parts = []
    for item in error.errors(include_url=False):
        where = ".".join(str(part) for part in item["loc"])
        message = item["msg"].removeprefix("Value error, ")
        if item["type"] == "extra_forbidden":
            message = f"no such field; allowed are {', '.join(model.model_fields)}"
        given = "" if item["type"] == "missing" else f" (given {item['input']!r})"
        parts.append(f"{where}: {message}{given}")
    return f"{model.__name__}: " + "; ".join(parts)


class _Checked(BaseModel):
    """A frozen model that raises ``HyperparameterError`` when it is constructed directly."""

    model_config = ConfigDict(frozen=True, extra="forbid", validate_default=True)

    came_later: ClassVar[tuple[str, ...]] = ()
    """Fields that the first version did not have. A saved model, or a study, that leaves them at
    their defaults is the one it was, to the last byte."""

    def __init__(self, **values: Any) -> None:
        try:
            super().__init__(**values)
        except ValidationError as error:
            raise HyperparameterError(_one_line(type(self), error)) from None

    # Nested validation (a protocol file) then keeps pydantic's own errors, with their location.
    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]  # pydantic's own mark

    def to_header(self) -> dict[str, Any]:
        """Give the fields to a saved model, without later ones that stand at their defaults."""
        later = type(self).later_defaults()
        return {k: v for k, v in self.model_dump().items() if k not in later or v != later[k]}

    @classmethod
    def later_defaults(cls) -> dict[str, Any]:
        """Return the fields that the first version did not have, with their defaults."""
        return {name: cls.model_fields[name].default for name in cls.came_later}

    @classmethod
    def from_header(cls, values: object) -> Self:
        """Build from the header of a saved model, with the errors of direct construction."""
        try:
            return cls.model_validate(values)
        except ValidationError as error:
            raise HyperparameterError(_one_line(cls, error)) from None


class GPHyperparameters(_Checked):
    """Hyperparameters of one STORK-GP.

    Attributes
    ----------
    lengthscales
        One per input, in the input's unit; their number is the number of inputs d.
    noise_variance
        sigma_n^2, in squared units of the target (of the latent function for a classifier).
    capacity
        Most basis vectors that are kept.
    recursion_depth
        tau: the current input and tau - 1 past ones make the state.
    temporal_scale
        sigma_rho of equation (7), which divides by its square.
    signal_variance
        sigma_f^2, in squared units of the target.
    constant_variance
        sigma_c^2, in the same units: the prior variance of a constant that is added to the
        function. k(x, x') = sigma_f^2 kappa(x, x') + sigma_c^2; 0 is the paper's kernel.
    prior_mean
        m0, in units of the target: what is predicted where nothing is known; 0 in the paper.
    novelty
        A point is novel when gamma >= novelty * k(x, x): a share of the prior variance, so it
        has no unit and lies between 0 and 1.

    Raises
    ------
    HyperparameterError
        In one line, which value is out of range and what is allowed.

    Examples
    --------
    >>> GPHyperparameters(lengthscales=[0.5], noise_variance=0.01).n_inputs
    1
    >>> GPHyperparameters(lengthscales=[0.5], noise_variance=0.01, capacity=0)
    Traceback (most recent call last):
    lad.errors.HyperparameterError: GPHyperparameters: capacity: Input should be greater than \
or equal to 1 (given 0)
    """

    lengthscales: Annotated[
        tuple[Lengthscale, ...], Field(min_length=1), BeforeValidator(_sequence)
    ]
    noise_variance: Variance
    capacity: Capacity = 400
    recursion_depth: RecursionDepth = 4
    temporal_scale: TemporalScale = 1.1
    signal_variance: Variance = 0.1
    constant_variance: NoVariance = 0.0
    prior_mean: Mean = 0.0
    novelty: Novelty = 1e-4

    came_later: ClassVar[tuple[str, ...]] = ("constant_variance", "prior_mean")

    @property
    def prior_variance(self) -> float:
        """k(x, x) = sigma_f^2 + sigma_c^2."""
        return self.signal_variance + self.constant_variance

    @property
    def n_inputs(self) -> int:
        """Number of inputs d."""
        return len(self.lengthscales)

    @property
    def squared_temporal_scale(self) -> float:
        """sigma_rho^2, the number equation (7) divides by."""
        return self.temporal_scale**2


class LADParameters(_Checked):
    """The assistive model's parameters; the defaults are the paper's Table I.

    Attributes
    ----------
    capacity, recursion_depth, temporal_scale, signal_variance, novelty
        As in ``GPHyperparameters``, shared by the two processes.
    lengthscale_user
        l_U, of the user's command: the same number for m/s and rad/s.
    lengthscale_velocity
        l_A, of the wheelchair's velocities (m/s and rad/s).
    lengthscale_laser
        l_E, of the laser segments (m).
    noise_when, noise_how
        sigma_n^2 of the classifier (latent units) and of the regressor ((m/s)^2, (rad/s)^2).
    threshold
        W_h: assistance is offered when p(h = 1 | x) reaches it; in [0, 1].
    probability
        ``probit``: Phi(mu / sqrt(sigma^2 + noise)), the predictive probability of the model;
        ``paper``: Phi(mu / sigma^2), equation (10) as printed.
    prior_help
        pi, the probability of help where nothing is known, between .001 and .999. The classifier's
        latent mean is then m0 = Phi^-1(pi) sqrt(sigma_f^2 + sigma_n^2), so that the predictive
        probability (``probit``) of an unknown state is pi. The paper has .5, that is m0 = 0.
    constant_variance
        sigma_c^2 of the regressor; None for the model's own: 0 for ``lad``, 0.1 for
        ``lad-correction`` and ``lad-level``.
    tune
        ``evidence``: at the start of a lap, what was taught since the last one chooses the
        regressor's hyperparameters by exact marginal likelihood, and the classifier's signal
        variance (``lad.tuning``); the values here are where the search begins and where its prior
        is centred. ``none`` keeps them, as the paper does.
    memory_laps
        How many of the last taught laps the model knows; None for all. What is older is forgotten
        at the start of a lap.

    Raises
    ------
    HyperparameterError
        In one line, which value is out of range and what is allowed.

    Examples
    --------
    >>> LADParameters().regressor.noise_variance
    0.01
    >>> LADParameters(novelty=0)
    Traceback (most recent call last):
    lad.errors.HyperparameterError: LADParameters: novelty: Input should be greater than 0 (given 0)
    """

    capacity: Capacity = 400
    recursion_depth: RecursionDepth = 4
    temporal_scale: TemporalScale = 1.1
    lengthscale_user: Lengthscale = 0.1
    lengthscale_velocity: Lengthscale = 1.0
    lengthscale_laser: Lengthscale = 2.0
    signal_variance: Variance = 0.1
    noise_when: Variance = 0.1
    noise_how: Variance = 0.01
    novelty: Novelty = 1e-4
    threshold: Threshold = 0.5
    probability: Literal["probit", "paper"] = "probit"
    prior_help: Probability = 0.5
    constant_variance: NoVariance | None = None
    tune: Literal["none", "evidence"] = "none"
    memory_laps: Laps | None = None

    came_later: ClassVar[tuple[str, ...]] = (
        "prior_help",
        "constant_variance",
        "tune",
        "memory_laps",
    )

    def _process(self, noise_variance: float, **further: float) -> GPHyperparameters:
        return GPHyperparameters(
            lengthscales=(self.lengthscale_user,) * 2
            + (self.lengthscale_velocity,) * 2
            + (self.lengthscale_laser,) * N_SEGMENTS,
            noise_variance=noise_variance,
            capacity=self.capacity,
            recursion_depth=self.recursion_depth,
            temporal_scale=self.temporal_scale,
            signal_variance=self.signal_variance,
            novelty=self.novelty,
            **further,
        )

    @property
    def classifier(self) -> GPHyperparameters:
        """Hyperparameters of the when-to-help process."""
        spread = math.sqrt(self.signal_variance + self.noise_when)
        return self._process(self.noise_when, prior_mean=float(ndtri(self.prior_help)) * spread)

    @property
    def regressor(self) -> GPHyperparameters:
        """Hyperparameters of the how-to-help process."""
        return self._process(self.noise_how, constant_variance=self.constant_variance or 0.0)
