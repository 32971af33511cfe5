"""What every baseline does: learns what can be learnt, refuses what cannot, repeats itself."""

import subprocess
import sys

import numpy as np
import pytest
from sklearn.neighbors import KNeighborsClassifier, KNeighborsRegressor
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler

from lad.assistant import Assistant, Learner
from lad.baselines import linear, memoryless, neighbours, network
from lad.baselines.refitted import RefittedAssistant
from lad.command import Command
from lad.errors import HyperparameterError, InvalidInputError, InvalidTargetError

MAKERS = {
    "linear": linear.make,
    "neighbours": neighbours.make,
    "online network": network.make,
    "network": network.make_refitted,
    "memoryless": memoryless.make,
}
every = pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
of_scikit = pytest.mark.parametrize(
    "make", [m for n, m in MAKERS.items() if n != "memoryless"], ids=list(MAKERS)[:-1]
)


def _steps(rng, n):
    """Return inputs, and whether help is given: where the stick is to the right; then w = -0.4."""
    x = rng.normal(0.0, 0.3, (n, 19))
    x[:, 1] = rng.choice([-0.5, 0.5], n) + rng.normal(0.0, 0.05, n)
    return x, x[:, 1] < 0


def _teach(model, laps, rng, n=150):
    for _ in range(laps):
        model.start_lap()
        for x, helped in zip(*_steps(rng, n), strict=True):
            model.assist(x)
            model.learn(bool(helped), Command(0.3, -0.4) if helped else None)
    return model


def _ask(model, rng, n=100):
    model.start_lap()
    x, helped = _steps(rng, n)
    return [model.assist(row) for row in x], helped


@every
def test_a_separable_stream_is_learnt(make):
    """After four laps it helps where help was given, nearly always, with nearly that command."""
    rng = np.random.default_rng(1)
    answers, helped = _ask(_teach(make(), 4, rng), rng)
    right = [a.helping == h for a, h in zip(answers, helped, strict=True)]
    assert np.mean(right) > 0.9
    assert all(0.0 <= a.p_help <= 1.0 for a in answers)
    given = np.array([a.command for a in answers if a.helping])
    assert np.abs(np.median(given, axis=0) - (0.3, -0.4)).max() < 0.2


@every
def test_it_fits_the_seams(make):
    """It is an assistant that learns, as the harness asks."""
    model: Assistant = make()
    assert isinstance(model, Learner)


@every
def test_nobody_is_helped_before_anything_was_taught(make):
    """An untaught baseline does not help, and still says a probability."""
    answers, _ = _ask(make(), np.random.default_rng(0), n=5)
    assert not any(a.helping or a.command for a in answers)
    assert all(a.p_help is not None for a in answers)


@every
def test_the_same_teaching_gives_the_same_answers(make):
    """Same seed, same numbers, bit for bit."""
    one, two = (_ask(_teach(make(), 2, r, 60), r)[0] for r in map(np.random.default_rng, (3, 3)))
    assert one == two


@every
def test_looking_does_not_teach(make):
    """Two laps of looking only leave the answers as they were."""
    rng = np.random.default_rng(4)
    model = _teach(make(), 2, rng, 60)
    before, _ = _ask(model, np.random.default_rng(9))
    _ask(model, rng)
    assert _ask(model, np.random.default_rng(9))[0] == before


@every
@pytest.mark.parametrize("wrong", [np.zeros(18), np.full(19, np.nan), np.full(19, np.inf)])
def test_an_input_that_means_nothing_is_refused(make, wrong):
    """A wrong shape, NaN or infinity raises, and changes no later answer."""
    model, same = (_teach(make(), 2, np.random.default_rng(5), 40) for _ in range(2))
    model.start_lap()
    with pytest.raises(InvalidInputError):
        model.assist(wrong)
    answers, _ = _ask(model, np.random.default_rng(6))
    assert answers == _ask(same, np.random.default_rng(6))[0]


@every
def test_a_lesson_that_means_nothing_is_refused(make):
    """Learning before looking, or help without a finite command, raises."""
    model = make()
    model.start_lap()
    with pytest.raises(InvalidTargetError):
        model.learn(False, None)
    model.assist(np.zeros(19))
    for command in (None, Command(np.nan, 0.0)):
        with pytest.raises(InvalidTargetError):
            model.learn(True, command)


@of_scikit
@pytest.mark.parametrize("threshold", [-0.1, 1.1, "half", True])
def test_a_threshold_that_is_none_is_refused(make, threshold):
    """W_h is a number from 0 to 1."""
    with pytest.raises(HyperparameterError, match="threshold"):
        make(threshold=threshold)


@pytest.mark.parametrize("k", [0, 2.5, True])
def test_neighbours_are_counted(k):
    """K is a whole number, 1 or more."""
    with pytest.raises(HyperparameterError, match="k: given"):
        neighbours.make(k=k)


@of_scikit
def test_help_that_was_never_given_is_never_offered(make):
    """A demonstration without help teaches no help; one with nothing else, nothing but help."""
    for given, helps in ((False, False), (True, True)):
        model = make()
        model.start_lap()
        for x in np.random.default_rng(7).normal(size=(60, 19)):
            model.assist(x)
            model.learn(given, Command(0.2, -0.3) if given else None)
        answers, _ = _ask(model, np.random.default_rng(8), n=10)
        assert [a.helping for a in answers] == [helps] * 10


def test_neighbours_answer_as_scikit_learns_estimators_do():
    """Learnt step by step, p(h) and the command are those of its estimators, bit for bit."""
    rng = np.random.default_rng(11)
    (x, helped), commands = _steps(rng, 200), rng.normal(size=(200, 2))
    model = neighbours.make()
    model.start_lap()
    for row, h, command in zip(x, helped, commands.tolist(), strict=True):
        model.assist(row)
        model.learn(bool(h), Command(*command) if h else None)
    when = make_pipeline(StandardScaler(), KNeighborsClassifier(5, algorithm="kd_tree"))
    how = make_pipeline(StandardScaler(), KNeighborsRegressor(5, algorithm="kd_tree"))
    when.fit(x, helped)
    how.fit(x[helped], commands[helped])
    asked, _ = _steps(rng, 100)
    model.start_lap()
    answers = [model.assist(row) for row in asked]
    assert [a.p_help for a in answers] == when.predict_proba(asked)[:, 1].tolist()
    assert [list(a.mean) for a in answers] == how.predict(asked).tolist()


def test_few_steps_of_help_are_enough_for_neighbours():
    """With two helped steps the command is their mean, though five neighbours are asked for."""
    model = neighbours.make()
    model.start_lap()
    for i, x in enumerate(np.random.default_rng(2).normal(size=(30, 19))):
        model.assist(x)
        model.learn(i < 2, Command(0.1 * (i + 1), -0.4) if i < 2 else None)
    answers, _ = _ask(model, np.random.default_rng(3), n=3)
    assert [a.mean for a in answers] == [pytest.approx((0.15, -0.4))] * 3


def test_a_demonstration_counts_from_the_next_lap_on():
    """A refitted assistant says the same within a lap whatever it is taught there."""
    rng = np.random.default_rng(0)
    model = _teach(linear.make(), 1, rng)
    assert isinstance(model, RefittedAssistant)
    model.start_lap()
    x = rng.normal(size=19)
    first = model.assist(x)
    model.learn(True, Command(0.0, 0.5))
    assert model.assist(x) == first
    model.start_lap()
    assert model.assist(x) != first


def test_without_scikit_learn_one_line_says_how_to_get_it():
    """The import fails with the name of the extra, before anything has run."""
    code = (
        "import sys; sys.modules['sklearn'] = None\n"
        "sys.modules['sklearn.linear_model'] = None\n"
        "from harness.session.model import make_model\n"
        "from protocols.files.errors import InputError\n"
        "from protocols.model_choice import ModelChoice\n"
        "try: make_model(ModelChoice(use='lad.baselines.linear:make'))\n"
        "except InputError as error: print(error)\n"
    )
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, capture_output=True, text=True, check=True)  # noqa: S603  # ours
    assert "lad-study[baselines]" in done.stdout
    assert done.stdout.count("\n") == 1
