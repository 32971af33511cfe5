"""The learned assistant: when to help and how, section III of Soh & Demiris."""

from collections.abc import Mapping
from pathlib import Path
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from lad.assistant import Assistance
from lad.assistant_file import restore, take_apart
from lad.command import Command
from lad.errors import InvalidTargetError
from lad.hyperparameters import GPHyperparameters, LADParameters
from lad.likelihood import probability_of_help
from lad.model_file import pack, read, rebuilding, unpack, write_whole
from lad.stork_gp import StorkGP
from lad.tuning.reteach import HELPING, NOT_HELPING, reteach
from lad.tuning.taught import TaughtSteps
from lad.tuning.tune import LEAST_STEPS, Tuned, refuse_too_few, tune
from lad.window import Window


class LADAssistant:
    """A classifier for when and a regressor for how, looking at the same window.

    Helps when p(h = 1 | x) >= W_h and the regressor has learnt something: an untrained classifier
    gives exactly 0.5, which passes the paper's threshold.

    Parameters
    ----------
    parameters
        Table I by default.

    Attributes
    ----------
    kind
        What a saved model of this class says that it is.
    default_constant_variance
        sigma_c^2 of the regressor, unless the parameters say another.
    when, how
        The two processes. They look at one window, until tuning gives them other lengthscales.
    tuned
        What ``tune: evidence`` has chosen last; None before, and without it.
    taught
        Every step that was learnt; None unless the parameters ask for tuning or forgetting.
    since
        How many steps were learnt since ``start_lap`` last considered them.

    Examples
    --------
    >>> import numpy as np
    >>> model = LADAssistant()
    >>> model.start_lap()
    >>> answer = model.assist(np.zeros(19))
    >>> answer.helping, answer.p_help
    (False, 0.5)
    >>> model.learn(helping=True, command=Command(0.3, -0.5))
    >>> model.assist(np.zeros(19)).helping
    True
    """

    kind: ClassVar[str] = "lad-assistant"
    default_constant_variance: ClassVar[float] = 0.0

    def __init__(self, parameters: LADParameters | None = None) -> None:
        self.parameters = parameters or LADParameters()
        if self.parameters.constant_variance is None and self.default_constant_variance:
            update = {"constant_variance": self.default_constant_variance}
            self.parameters = self.parameters.model_copy(update=update)
        self.tuned: Tuned | None = None
        keeps = self.parameters.tune != "none" or self.parameters.memory_laps is not None
        self.taught = TaughtSteps() if keeps else None
        self.since = 0
        self.make_processes(self.parameters.classifier, self.parameters.regressor)

    def make_processes(self, when: GPHyperparameters, how: GPHyperparameters) -> None:
        """Begin anew with two untaught processes."""
        self.when = StorkGP(when, "probit")
        shared = self.when.window if how.lengthscales == when.lengthscales else None
        self.how = StorkGP(how, n_outputs=2, window=shared)

    @property
    def processes(self) -> Mapping[str, StorkGP]:
        """Every process by name, ``when`` first; they may share a window."""
        return {"when": self.when, "how": self.how}

    @property
    def windows(self) -> tuple[Window, ...]:
        """The windows that the processes look at, each once."""
        return tuple({id(p.window): p.window for p in self.processes.values()}.values())

    def start_lap(self) -> None:
        """Forget the last lap's history; keep what was learnt, as far as the parameters say so.

        With ``tune: evidence`` hyperparameters are chosen anew when something was taught since the
        last time, and 20 steps with help and 20 without are known.
        """
        for window in self.windows:
            window.reset()
        if self.taught is not None and self.since:
            self._reconsider(self.taught)

    def tune(self) -> Tuned:
        """Choose hyperparameters by evidence now, and learn everything again with them.

        Raises
        ------
        TooFewStepsError
            When fewer than 20 steps with help, or without, are known; nothing has changed.
        """
        taught = TaughtSteps() if self.taught is None else self.taught
        refuse_too_few(taught)
        tuned = tune(self.parameters, taught)
        self._teach_again(taught, tuned)
        return tuned

    def _reconsider(self, taught: TaughtSteps) -> None:
        """Forget, tune, and learn again what is known, where one of these changed something."""
        self.since, forgotten = 0, 0
        if self.parameters.memory_laps is not None:
            laps = sorted(set(taught.laps))
            forgotten = taught.forget_before(laps[-self.parameters.memory_laps :][0])
        helped = int(taught.helped.sum())
        enough = min(helped, len(taught) - helped) >= LEAST_STEPS
        if self.parameters.tune == "evidence" and enough:
            self.tune()
        elif forgotten:
            self._teach_again(taught, self.tuned)

    def _teach_again(self, taught: TaughtSteps, tuned: Tuned | None) -> None:
        now, self.tuned = self.when.window, tuned
        if tuned is None:
            self.make_processes(self.parameters.classifier, self.parameters.regressor)
        else:
            self.make_processes(tuned.when, tuned.how)
        reteach(taught, self.when, self.how, now)

    def assist(self, x: NDArray[np.float64]) -> Assistance:
        """Look at the inputs once, and predict when and how.

        Parameters
        ----------
        x
            Shape (19,), finite, in the order of ``lad.inputs.INPUT_NAMES``.

        Returns
        -------
        Assistance
            ``p_help``, ``mean`` and ``variance`` are always filled; ``command`` is the mean when
            it helps.

        Raises
        ------
        InvalidInputError
            When x has another shape or type or is not finite; nothing has changed.
        """
        for window in self.windows:
            window.observe(x)
        return self._answer()

    def answer_at(self, window: NDArray[np.float64]) -> Assistance:
        """Answer as it would at a whole window of another time; the lap's own window is lost.

        Parameters
        ----------
        window
            Shape (tau, 19), newest input first, in the inputs' units.
        """
        for shown in self.windows:
            shown.show(window, shown.time, shown.lap)
        return self._answer()

    def _answer(self) -> Assistance:
        when, how = self.when.predict(), self.how.predict()
        p_help = probability_of_help(
            float(when.mean[0]),
            when.latent_variance,
            self.parameters.noise_when,
            self.parameters.probability,
        )
        mean = self._said(Command(float(how.mean[0]), float(how.mean[1])))
        helping = p_help >= self.parameters.threshold and self.how.n_basis > 0
        return Assistance(
            helping=helping,
            command=mean if helping else None,
            p_help=p_help,
            mean=mean,
            variance=how.variance,
        )

    def learn(self, helping: bool, command: Command | None) -> None:
        """Learn the step last seen by ``assist``: when always, how only where help was given.

        Parameters
        ----------
        helping
            Whether the demonstrator had taken over.
        command
            The demonstrator's command, finite; None when it had not.

        Raises
        ------
        InvalidTargetError
            When nothing was seen in this lap, or help was given without a usable command;
            nothing has changed.
        """
        if not self.when.window.seen:
            raise InvalidTargetError("learn: nothing was seen in this lap; assist comes first")
        if helping and command is None:
            raise InvalidTargetError("command: given None while helping; allowed is a Command")
        target = None if command is None or not helping else self._learnt(command)
        self._learn(target)
        if self.taught is not None:
            self.taught.add(self.when.window, target)
            self.since += 1

    def _learn(self, target: Command | None) -> None:
        """Teach the processes; None where no help was given."""
        if target is not None:
            self.how.learn(target)
        self.when.learn(NOT_HELPING if target is None else HELPING)

    def _learnt(self, command: Command) -> Command:
        """Return what the regressor learns of a demonstrator's command: the command."""
        return command

    def _said(self, mean: Command) -> Command:
        """Return the command that follows from the regressor's mean: the mean."""
        return mean

    def to_bytes(self) -> bytes:
        """Save as the bytes of one portable npz; the same bytes for the same model."""
        return pack(self.kind, *take_apart(self))

    @classmethod
    def from_bytes(cls, data: bytes, source: str = "model") -> Self:
        """Rebuild a model whose predictions are bit-identical.

        Raises
        ------
        ModelFileError
            When the bytes are not a saved assistant of this class; ``source`` names them.
        """
        header, arrays = unpack(data, cls.kind, source)
        with rebuilding(source):
            model = cls(LADParameters.from_header(header["parameters"]))
            restore(model, header, arrays)
        return model

    def save(self, path: str | Path) -> None:
        """Write ``to_bytes`` to a file, whole or not at all."""
        write_whole(path, self.to_bytes())

    @classmethod
    def load(cls, path: str | Path) -> Self:
        """Read what ``save`` wrote; a ModelFileError names the path."""
        return cls.from_bytes(read(path), str(path))

    def __reduce__(self) -> tuple[object, tuple[bytes]]:
        return type(self).from_bytes, (self.to_bytes(),)
