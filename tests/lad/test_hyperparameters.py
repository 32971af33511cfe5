"""One place for every number, and errors that say what is allowed."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import BaseModel, ValidationError

from lad.errors import HyperparameterError
from lad.hyperparameters import GPHyperparameters, LADParameters


def test_defaults_are_table_one():
    """The defaults are the paper's Table I, with the novelty of section III.A."""
    assert LADParameters().model_dump() == {
        "capacity": 400,
        "recursion_depth": 4,
        "temporal_scale": 1.1,
        "lengthscale_user": 0.1,
        "lengthscale_velocity": 1.0,
        "lengthscale_laser": 2.0,
        "signal_variance": 0.1,
        "noise_when": 0.1,
        "noise_how": 0.01,
        "novelty": 1e-4,
        "threshold": 0.5,
        "probability": "probit",
        "prior_help": 0.5,
        "constant_variance": None,
        "tune": "none",
        "memory_laps": None,
    }


def test_what_came_later_is_not_written_where_it_stands_at_its_default():
    """A model of Table I is saved as the first version saved it; what was chosen is written."""
    assert "prior_help" not in LADParameters().to_header()
    assert LADParameters(prior_help=0.35).to_header()["prior_help"] == 0.35
    assert "constant_variance" not in LADParameters().regressor.to_header()
    chosen = LADParameters(prior_help=0.2, constant_variance=0.3)
    assert LADParameters.from_header(chosen.to_header()) == chosen


def test_a_prior_of_one_half_is_the_papers():
    """m0 is exactly 0 at .5, and the constant of the shipped model exactly 0."""
    assert LADParameters().classifier.prior_mean == 0.0
    assert LADParameters().regressor.constant_variance == 0.0


def test_both_processes_derive_from_the_parameters():
    """Classifier and regressor differ in their noise only, and the lengthscales are in order."""
    parameters = LADParameters()
    when, how = parameters.classifier, parameters.regressor
    assert when.lengthscales == (0.1, 0.1, 1.0, 1.0, *[2.0] * 15)
    assert when.noise_variance == 0.1
    assert how == when.model_copy(update={"noise_variance": 0.01})


def test_temporal_scale_is_squared():
    """The kernel divides by sigma_rho squared, 1.21."""
    assert LADParameters().classifier.squared_temporal_scale == pytest.approx(1.21)


@pytest.mark.parametrize(
    ("changed", "allowed"),
    [
        ({"capacity": 0}, "greater than or equal to 1"),
        ({"capacity": 3.5}, "integer"),
        ({"capacity": "400"}, "number"),
        ({"capacity": True}, "number"),
        ({"noise_variance": -0.1}, "greater than or equal to"),
        ({"noise_variance": 0.0}, "greater than or equal to"),
        ({"noise_variance": float("nan")}, "finite"),
        ({"noise_variance": float("inf")}, "finite"),
        ({"novelty": 0.0}, "greater than 0"),
        ({"novelty": -1e-4}, "greater than 0"),
        ({"novelty": 1.0}, "less than 1"),
        ({"lengthscales": [0.0]}, "greater than or equal to"),
        ({"lengthscales": []}, "at least 1"),
        ({"lengthscales": 2.0}, "tuple"),
        ({"lengthscales": ["a"]}, "number"),
        ({"recursion_depth": 0}, "greater than or equal to 1"),
        ({"temporal_scale": 0.0}, "greater than or equal to"),
        ({"signal_variance": -1.0}, "greater than or equal to"),
        ({"lengthscale": [1.0]}, "lengthscales, noise_variance, capacity"),
    ],
)
def test_bad_values_are_refused_in_one_line(changed, allowed):
    """What is out of range raises one line that says what was given and what is allowed."""
    (name, value), *_ = changed.items()
    with pytest.raises(HyperparameterError) as caught:
        GPHyperparameters(**({"lengthscales": [1.0], "noise_variance": 0.1} | changed))
    message = str(caught.value)
    assert "\n" not in message
    assert name in message
    assert allowed in message
    if not isinstance(value, list):
        assert repr(value) in message


def test_a_missing_value_is_named():
    """A hyperparameter without a default must be given."""
    with pytest.raises(HyperparameterError, match="noise_variance: Field required"):
        GPHyperparameters(lengthscales=[1.0])


def test_arrays_and_numpy_numbers_are_numbers():
    """Lists, arrays and numpy scalars may stand where plain numbers do."""
    made = GPHyperparameters(
        lengthscales=np.array([1.0, 2.0]), noise_variance=np.float64(0.1), capacity=np.int64(7)
    )
    assert made == GPHyperparameters(lengthscales=(1.0, 2.0), noise_variance=0.1, capacity=7)


def test_nested_in_a_protocol_errors_keep_their_location():
    """Inside another model pydantic's own error comes out, with the path to the field."""

    class Study(BaseModel):
        model: LADParameters = LADParameters()

    with pytest.raises(ValidationError) as caught:
        Study.model_validate({"model": {"capacity": 0}})
    assert caught.value.errors()[0]["loc"] == ("model", "capacity")


def test_frozen():
    """Hyperparameters do not change under a model."""
    parameters = LADParameters()
    with pytest.raises(ValidationError, match="frozen"):
        parameters.capacity = 3


@given(
    st.builds(
        LADParameters,
        capacity=st.integers(1, 1000),
        temporal_scale=st.floats(0.1, 10.0),
        novelty=st.floats(1e-9, 0.9),
        threshold=st.floats(0.0, 1.0),
        probability=st.sampled_from(["probit", "paper"]),
    )
)
def test_json_round_trip(parameters):
    """Parameters survive JSON, as saved models need, to the last bit."""
    again = LADParameters.model_validate_json(parameters.model_dump_json())
    assert again == parameters
    assert LADParameters.from_header(parameters.model_dump()) == parameters


def test_a_header_with_a_wrong_value_is_a_named_error():
    """Values that come from a file are checked like any others."""
    with pytest.raises(HyperparameterError, match="capacity"):
        LADParameters.from_header({"capacity": -3})
