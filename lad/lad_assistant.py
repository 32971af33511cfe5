"""The learned assistant: when to help and how, section III of Soh & Demiris."""

from pathlib import Path
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from lad.assistant import Assistance
from lad.command import Command
from lad.errors import InvalidTargetError
from lad.health import Health
from lad.hyperparameters import LADParameters
from lad.likelihood import probability_of_help
from lad.model_file import pack, read, rebuilding, unpack, write_whole
from lad.snapshot import Arrays, restore_state, restore_window, state_arrays, window_arrays
from lad.stork_gp import StorkGP

HELPING, NOT_HELPING = 1.0, -1.0


class LADAssistant:
    """A classifier for when and a regressor for how, looking at the same window.

    Helps when p(h = 1 | x) >= W_h and the regressor has learnt something: an untrained classifier
    says exactly 0.5, which passes the paper's threshold.

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
        self.when = StorkGP(self.parameters.classifier, "probit")
        self.how = StorkGP(self.parameters.regressor, n_outputs=2, window=self.when.window)

    def start_lap(self) -> None:
        """Forget the last lap's history; keep what was learnt."""
        self.when.reset_window()

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
        self.when.observe(x)
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
        if helping:
            if command is None:
                raise InvalidTargetError("command: given None while helping; allowed is a Command")
            self.how.learn(self._learnt(command))
        self.when.learn(HELPING if helping else NOT_HELPING)

    def _learnt(self, command: Command) -> Command:
        """Return what the regressor learns of a demonstrator's command: the command."""
        return command

    def _said(self, mean: Command) -> Command:
        """Return the command that follows from the regressor's mean: the mean."""
        return mean

    def to_bytes(self) -> bytes:
        """Save as the bytes of one portable npz; the same bytes for the same model."""
        window, arrays = window_arrays(self.when.window)
        for name, process in (("when", self.when), ("how", self.how)):
            for key, array in state_arrays(process.state).items():
                arrays[f"{name}/{key}"] = array
        header = {
            "parameters": self.parameters.to_header(),
            "window": window,
            "health": [self.when.health.to_header(), self.how.health.to_header()],
        }
        return pack(self.kind, header, arrays)

    @classmethod
    def from_bytes(cls, data: bytes, source: str = "model") -> Self:
        """Rebuild a model whose predictions are bit-identical.

        Raises
        ------
        ModelFileError
            When the bytes are not a saved assistant; ``source`` names them.
        """
        header, arrays = unpack(data, cls.kind, source)
        with rebuilding(source):
            model = cls(LADParameters.from_header(header["parameters"]))
            restore_window(model.when.window, header["window"], arrays)
            for name, process in (("when", model.when), ("how", model.how)):
                restore_state(process.state, _belonging_to(name, arrays))
            model.when.health, model.how.health = (Health(**one) for one in header["health"])
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


def _belonging_to(name: str, arrays: Arrays) -> Arrays:
    prefix = f"{name}/"
    return {
        key.removeprefix(prefix): array for key, array in arrays.items() if key.startswith(prefix)
    }
