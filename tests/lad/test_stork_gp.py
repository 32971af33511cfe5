"""The fused process: the definition's numbers, purity, bad input, invariances."""

import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lad.errors import HyperparameterError, InvalidInputError, InvalidTargetError
from lad.hyperparameters import GPHyperparameters
from lad.plain import PlainStorkGP
from lad.stork_gp import StorkGP
from lad.stream import learn_stream, predict_stream
from lad.update import UpdateKind

seeds = st.integers(0, 2**32 - 1)


@settings(max_examples=30, deadline=None)
@given(
    seed=seeds,
    d=st.integers(1, 6),
    p=st.integers(1, 3),
    tau=st.integers(1, 5),
    capacity=st.integers(1, 20),
    novelty=st.sampled_from([1e-3, 1e-2, 0.05, 0.5]),
    probit=st.booleans(),
    constant=st.sampled_from([0.0, 0.1, 1.0]),
    m0=st.sampled_from([0.0, -0.2]),
)
def test_equals_the_definition(*, seed, d, p, tau, capacity, novelty, probit, constant, m0):
    """Predictions, events, deletions, alpha, C and Q are those of the plain form.

    Over every mix of first, sparse, full and deleting updates, for both likelihoods.
    """
    rng = np.random.default_rng(seed)
    hyper = GPHyperparameters(
        lengthscales=rng.uniform(0.5, 2.0, d),
        noise_variance=0.05,
        capacity=capacity,
        recursion_depth=tau,
        novelty=novelty,
        constant_variance=constant,
        prior_mean=m0,
    )
    x, y = rng.normal(size=(40, d)), rng.normal(size=(40, p))
    if probit:
        p, y = 1, np.where(y[:, :1] > 0.0, 1.0, -1.0)
    arguments = (hyper, "probit" if probit else "gaussian", p)
    plain, fused = PlainStorkGP(*arguments), StorkGP(*arguments)
    one, other = learn_stream(plain, x, y), learn_stream(fused, x, y)
    assert one.kind.tolist() == other.kind.tolist()
    assert one.deleted_time.tolist() == other.deleted_time.tolist()
    assert one.n_basis.tolist() == other.n_basis.tolist()
    assert np.abs(one.novelty - other.novelty).max() < 1e-7
    assert np.abs(one.predictions.mean - other.predictions.mean).max() < 1e-7
    assert np.abs(one.predictions.variance - other.predictions.variance).max() < 1e-7
    assert plain.times.tolist() == fused.times.tolist()
    scale = 1.0 + np.abs(plain.state.Q).max()
    found = fused.posterior()
    assert np.abs(plain.state.alpha - found.alpha).max() < 1e-7 * scale
    assert np.abs(plain.state.C - found.C).max() < 1e-7 * scale
    assert np.abs(plain.state.Q - found.Q).max() < 1e-7 * scale


def test_equals_the_definition_at_full_size(stream, make_hyperparameters):
    """Also with 19 inputs, 4 lags and room that has grown several times."""
    hyper = make_hyperparameters(capacity=120)
    x, y = stream(0, 400, 0.05)
    one = learn_stream(PlainStorkGP(hyper, n_outputs=2), x, y)
    other = learn_stream(StorkGP(hyper, n_outputs=2), x, y)
    assert set(one.kind.tolist()) >= {UpdateKind.FULL, UpdateKind.FULL_THEN_DELETION}
    assert one.kind.tolist() == other.kind.tolist()
    assert one.deleted_time.tolist() == other.deleted_time.tolist()
    assert np.abs(one.predictions.mean - other.predictions.mean).max() < 1e-9
    assert np.abs(one.predictions.variance - other.predictions.variance).max() < 1e-10


@settings(max_examples=15, deadline=None)
@given(seeds, st.integers(1, 30))
def test_predict_is_pure(seed, steps):
    """Predicting any number of times between observing and learning changes no bit of anything."""
    rng = np.random.default_rng(seed)
    hyper = GPHyperparameters(lengthscales=[1.0, 0.7], noise_variance=0.01, capacity=8)
    often, never = StorkGP(hyper), StorkGP(hyper)
    for x, y in zip(rng.normal(size=(steps, 2)), rng.normal(size=steps), strict=True):
        often.observe(x)
        first, second = often.predict(), often.predict()
        assert first.mean.tolist() == second.mean.tolist()
        assert first.latent_variance == second.latent_variance
        often.learn(y)
        often.predict()
        never.observe(x)
        never.learn(y)
    assert often.to_bytes() == never.to_bytes()


def test_a_prediction_is_not_a_view():
    """Changing a returned mean changes nothing in the process."""
    process = StorkGP(GPHyperparameters(lengthscales=[1.0], noise_variance=0.01))
    process.observe([0.1])
    process.learn(1.0)
    process.predict().mean[:] = 99.0
    assert process.predict().mean[0] < 1.0


def test_prediction_follows_learning():
    """What was just learnt is in the next prediction at the same window."""
    process = StorkGP(GPHyperparameters(lengthscales=[1.0], noise_variance=0.01))
    process.observe([0.1])
    before = process.predict()
    process.learn(1.0)
    after = process.predict()
    assert after.mean[0] == pytest.approx(0.1 / 0.11)
    assert after.latent_variance == pytest.approx(0.1 - 0.01 / 0.11)
    assert before.mean[0] == 0.0


def test_reset_window_keeps_what_was_learnt():
    """A new lap sees zeros in the past, and every basis vector is still there."""
    process = StorkGP(GPHyperparameters(lengthscales=[1.0], noise_variance=0.01))
    for x in (0.1, 2.0, -1.0):
        process.observe([x])
        process.learn(x)
    process.reset_window()
    assert process.n_basis == 3
    assert process.state.laps[:3].tolist() == [0, 0, 0]
    process.observe([0.1])
    assert process.predict().mean[0] == pytest.approx(0.1 * 0.1 / 0.11, abs=0.05)
    process.learn(0.1)
    assert process.state.laps[: process.n_basis].max() <= 1


@pytest.mark.parametrize("bad", [[np.nan, 1.0], [np.inf, 0.0], [1.0], "ab", None, [[1.0, 2.0]]])
def test_bad_input_changes_no_bit(bad):
    """After a refused input or target the model's bytes are what they were."""
    process = StorkGP(GPHyperparameters(lengthscales=[1.0, 1.0], noise_variance=0.1), n_outputs=2)
    for x in np.random.default_rng(0).normal(size=(20, 2)):
        process.observe(x)
        process.learn(x)
    before = process.to_bytes()
    with pytest.raises(InvalidInputError):
        process.observe(bad)
    with pytest.raises(InvalidTargetError):
        process.learn(bad)
    assert process.to_bytes() == before
    process.predict()
    assert process.to_bytes() == before


@pytest.mark.parametrize(("likelihood", "outputs"), [("logit", 1), ("probit", 2), ("gaussian", 0)])
def test_impossible_processes_are_refused(likelihood, outputs):
    """An unknown likelihood, or one that has not so many outputs, is a named error."""
    with pytest.raises(HyperparameterError):
        StorkGP(GPHyperparameters(lengthscales=[1.0], noise_variance=0.1), likelihood, outputs)


def test_capacity_one():
    """The smallest model keeps one vector, whichever explains more."""
    hyper = GPHyperparameters(lengthscales=[1.0], noise_variance=0.01, capacity=1)
    learning = learn_stream(
        StorkGP(hyper), np.array([[0.0], [5.0], [9.0]]), np.array([[1.0], [0.1], [2.0]])
    )
    assert learning.kind.tolist() == [0, 3, 3]
    assert learning.deleted_time.tolist() == [-1, 1, 0]
    assert learning.n_basis.tolist() == [1, 1, 1]


@settings(max_examples=20, deadline=None)
@given(seeds, st.permutations(range(4)))
def test_order_of_inputs_does_not_matter(seed, order):
    """Permuting inputs together with their lengthscales permutes nothing that comes out."""
    rng = np.random.default_rng(seed)
    scales, x = rng.uniform(0.5, 2.0, 4), rng.normal(size=(40, 4))
    y = rng.normal(size=(40, 1))
    one, other = (
        learn_stream(
            StorkGP(GPHyperparameters(lengthscales=s, noise_variance=0.05, capacity=15)), z, y
        )
        for s, z in ((scales, x), (scales[list(order)], x[:, list(order)]))
    )
    assert one.kind.tolist() == other.kind.tolist()
    assert np.abs(one.predictions.mean - other.predictions.mean).max() < 1e-8


@settings(max_examples=20, deadline=None)
@given(seeds, st.integers(-20, 20))
def test_units_of_the_inputs_do_not_matter(seed, power):
    """Inputs and lengthscales in another unit (a power of two) give the same bits."""
    rng = np.random.default_rng(seed)
    scales, x, y = rng.uniform(0.5, 2.0, 3), rng.normal(size=(30, 3)), rng.normal(size=(30, 1))
    one, other = (
        learn_stream(
            StorkGP(GPHyperparameters(lengthscales=scales * u, noise_variance=0.05, capacity=9)),
            x * u,
            y,
        )
        for u in (1.0, 2.0**power)
    )
    assert np.array_equal(one.predictions.mean, other.predictions.mean)
    assert np.array_equal(one.predictions.variance, other.predictions.variance)


@settings(max_examples=20, deadline=None)
@given(seeds, st.integers(-20, 20))
def test_units_of_the_targets_scale_the_mean(seed, power):
    """Regression is linear in y: targets times a power of two give means times it, bit by bit."""
    rng = np.random.default_rng(seed)
    hyper = GPHyperparameters(lengthscales=[1.0], noise_variance=0.05, capacity=9)
    x, y = rng.normal(size=(30, 1)), rng.normal(size=(30, 1))
    one = learn_stream(StorkGP(hyper), x, y)
    other = learn_stream(StorkGP(hyper), x, y * 2.0**power)
    assert np.array_equal(one.predictions.mean * 2.0**power, other.predictions.mean)
    assert np.array_equal(one.predictions.variance, other.predictions.variance)
    assert one.deleted_time.tolist() == other.deleted_time.tolist()


@settings(max_examples=15, deadline=None)
@given(seeds, st.integers(-10, 10))
def test_novelty_is_relative(seed, power):
    """Signal, noise and targets in another unit: the same events, since novelty is a share."""
    rng = np.random.default_rng(seed)
    unit = 2.0**power
    x, y = rng.normal(size=(30, 1)), rng.normal(size=(30, 1))
    one, other = (
        learn_stream(
            StorkGP(
                GPHyperparameters(
                    lengthscales=[1.0],
                    noise_variance=0.05 * u * u,
                    signal_variance=0.1 * u * u,
                    capacity=9,
                    novelty=0.01,
                )
            ),
            x,
            y * u,
        )
        for u in (1.0, unit)
    )
    assert one.kind.tolist() == other.kind.tolist()
    assert np.abs(one.predictions.mean * unit - other.predictions.mean).max() < 1e-9 * unit


@settings(max_examples=15, deadline=None)
@given(seeds)
def test_labels_are_symmetric(seed):
    """Exchanging -1 and +1 turns the latent mean's sign and nothing else."""
    rng = np.random.default_rng(seed)
    hyper = GPHyperparameters(lengthscales=[1.0, 1.0], noise_variance=0.1, capacity=12)
    x, y = rng.normal(size=(40, 2)), rng.choice([-1.0, 1.0], size=(40, 1))
    one = learn_stream(StorkGP(hyper, "probit"), x, y)
    other = learn_stream(StorkGP(hyper, "probit"), x, -y)
    assert np.array_equal(one.predictions.mean, -other.predictions.mean)
    assert np.array_equal(one.predictions.variance, other.predictions.variance)


def test_outputs_share_the_variance_but_not_the_mean():
    """While nothing is deleted, two outputs are two processes of one output."""
    rng = np.random.default_rng(1)
    hyper = GPHyperparameters(lengthscales=[1.0], noise_variance=0.05)
    x, y = rng.normal(size=(40, 1)), rng.normal(size=(40, 2))
    both = learn_stream(StorkGP(hyper, n_outputs=2), x, y).predictions
    for i in range(2):
        alone = learn_stream(StorkGP(hyper), x, y[:, i : i + 1]).predictions
        assert np.array_equal(both.mean[:, i], alone.mean[:, 0])
        assert np.array_equal(both.variance, alone.variance)


def test_pickle_and_a_clone_learn_independently():
    """A pickled process predicts and learns on, bit for bit, and apart from its original."""
    rng = np.random.default_rng(2)
    process = StorkGP(GPHyperparameters(lengthscales=[1.0], noise_variance=0.05, capacity=6))
    learn_stream(process, rng.normal(size=(30, 1)), rng.normal(size=(30, 1)))
    clone = pickle.loads(pickle.dumps(process))  # noqa: S301  # our own bytes
    before = process.to_bytes()
    x, y = rng.normal(size=(30, 1)), rng.normal(size=(30, 1))
    learnt = learn_stream(clone, x, y)
    assert process.to_bytes() == before
    again = learn_stream(process, x, y)
    assert np.array_equal(learnt.predictions.mean, again.predictions.mean)
    assert clone.to_bytes() == process.to_bytes()


@settings(max_examples=25, deadline=None)
@given(
    seed=seeds,
    noise=st.sampled_from([1e-9, 1e-4, 0.1, 1e6]),
    novelty=st.sampled_from([1e-12, 1e-4, 0.3]),
    size=st.sampled_from([1e-8, 1.0, 1e8, 1e50]),
    spread=st.sampled_from([0.0, 1e-6, 1.0, 1e6, 1e140]),
)
def test_no_allowed_numbers_break_it(seed, noise, novelty, size, spread):
    """At the ends of every allowed range predictions stay finite and variances positive."""
    rng = np.random.default_rng(seed)
    hyper = GPHyperparameters(
        lengthscales=[1.0], noise_variance=noise, capacity=10, novelty=novelty
    )
    process = StorkGP(hyper)
    x, y = spread * rng.normal(size=(60, 1)), size * rng.uniform(-1.0, 1.0, size=(60, 1))
    predictions = learn_stream(process, x, y).predictions
    assert np.isfinite(predictions.mean).all()
    assert (predictions.latent_variance > 0.0).all()
    assert np.isfinite(predictions.variance).all()


@settings(max_examples=20, deadline=None)
@given(seeds, st.floats(1e-9, 1e3), st.floats(1e-12, 0.5))
def test_classifier_variance_stays_positive(seed, noise, novelty):
    """However contradictory the labels, the classifier's latent variance is within the prior's."""
    rng = np.random.default_rng(seed)
    hyper = GPHyperparameters(
        lengthscales=[1.0], noise_variance=noise, capacity=10, novelty=novelty
    )
    process = StorkGP(hyper, "probit")
    x, y = np.round(rng.normal(size=(80, 1))), rng.choice([-1.0, 1.0], size=(80, 1))
    latent = learn_stream(process, x, y).predictions.latent_variance
    assert (latent > 0.0).all()
    assert (latent <= 0.1 * (1.0 + 1e-6)).all()


def test_two_processes_may_share_a_window():
    """A shared window is observed once and seen by both."""
    hyper = GPHyperparameters(lengthscales=[1.0], noise_variance=0.05)
    when = StorkGP(hyper, "probit")
    how = StorkGP(hyper, window=when.window)
    when.observe([0.4])
    when.learn(1)
    how.learn(2.0)
    assert how.times.tolist() == when.times.tolist() == [0]
    when.observe([0.5])
    assert how.predict().mean[0] > 0.0
    assert predict_stream(how, np.array([[0.4]])).mean.shape == (1, 1)


@pytest.mark.parametrize("changed", [{"lengthscales": [2.0]}, {"recursion_depth": 3}])
def test_a_window_that_does_not_fit_is_refused(changed):
    """Sharing needs the same lengthscales and the same depth."""
    values = {"lengthscales": [1.0], "noise_variance": 0.05}
    when = StorkGP(GPHyperparameters(**values), "probit")
    with pytest.raises(HyperparameterError, match="window: given one of depth 4"):
        StorkGP(GPHyperparameters(**(values | changed)), window=when.window)
