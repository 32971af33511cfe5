"""An assistant that learns how the demonstrator's command differs from the user's."""

from typing import ClassVar

from lad.command import Command
from lad.lad_assistant import LADAssistant
from lad.likelihood import check_target


class CorrectionAssistant(LADAssistant):
    """Learns the correction to the user's command instead of the command.

    When to help is learnt as by ``LADAssistant``. How is learnt from y = a - u, the demonstrator's
    command minus the user's limited command, both components at once:

        y = c + g(x) + noise,    c ~ N(0, sigma_c^2),    g ~ GP(0, sigma_f^2 kappa).

    The constant c is integrated out, which adds sigma_c^2 to the kernel, k = sigma_f^2 kappa +
    sigma_c^2, also where x is the same twice: in the prior variance, in the test for novelty and
    in the watch over Q. The command said is u + mu(x). As u is known, its variance is that of mu:
    k(x, x) + k' C k, and the noise.

    Where nothing like x was demonstrated, mu is the mean correction demonstrated so far, pulled
    towards 0, and before any demonstration it is 0. So the null action of equation (1) means "do
    as the user does"; with the paper's target, y = a, it means "stop".

    Parameters
    ----------
    parameters
        Table I and sigma_c^2 = 0.1 by default; the first value that was tried.

    Examples
    --------
    >>> import numpy as np
    >>> model = CorrectionAssistant()
    >>> model.start_lap()
    >>> x = np.zeros(19)
    >>> x[:2] = 0.4, -0.15
    >>> model.assist(x).mean
    Command(v=0.4, w=-0.15)
    >>> model.learn(helping=True, command=Command(0.3, -0.5))
    >>> x[:2] = 0.7, -0.15
    >>> answer = model.assist(x)
    >>> round(answer.mean.v, 2), round(answer.mean.w, 2)
    (0.65, -0.32)
    """

    kind: ClassVar[str] = "lad-correction"
    default_constant_variance: ClassVar[float] = 0.1

    def _user(self) -> Command:
        """Return the user's limited command of the step last seen."""
        window = self.how.window
        # From the window, not kept beside it: a model saved between looking and learning then
        # goes on with the same bits.
        v, w = window.scaled[0, :2] * window.lengthscales[:2]
        return Command(float(v), float(w))

    def _learnt(self, command: Command) -> Command:
        v, w = check_target(command, 2, "gaussian").tolist()
        user = self._user()
        return Command(v - user.v, w - user.w)

    def _said(self, mean: Command) -> Command:
        user = self._user()
        return Command(user.v + mean.v, user.w + mean.w)
