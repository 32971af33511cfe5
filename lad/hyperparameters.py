"""Every number a person may choose about the model, checked in one place.

``LADParameters`` is what a study protocol writes down (Table I of Soh & Demiris is the default);
``GPHyperparameters`` is what one Gaussian process is built from.
"""

from numbers import Real
from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError

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
Novelty = Annotated[float, Field(gt=0, lt=1, allow_inf_nan=False), BeforeValidator(_number)]
Capacity = Annotated[int, Field(ge=1, le=20_000), BeforeValidator(_number)]
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

    def __init__(self, **values: Any) -> None:
        try:
            super().__init__(**values)
        except ValidationError as error:
            raise HyperparameterError(_one_line(type(self), error)) from None

    # Nested validation (a protocol file) then keeps pydantic's own errors, with their location.
    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]  # pydantic's own mark

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
        sigma_f^2 = k(x, x), in squared units of the target.
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
    novelty: Novelty = 1e-4

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

    def _process(self, noise_variance: float) -> GPHyperparameters:
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
        )

    @property
    def classifier(self) -> GPHyperparameters:
        """Hyperparameters of the when-to-help process."""
        return self._process(self.noise_when)

    @property
    def regressor(self) -> GPHyperparameters:
        """Hyperparameters of the how-to-help process."""
        return self._process(self.noise_how)
