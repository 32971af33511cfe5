"""The model's view of the world: 19 numbers, and nothing else.

Section IV.C of Soh & Demiris: x_t = (x_U, x_A, x_E), the user's command as limited, the
wheelchair's velocities, and the forward laser scan in M = 15 segments.
"""

import numpy as np
from numpy.typing import NDArray

from lad.command import Command

N_SEGMENTS = 15

INPUT_NAMES: tuple[str, ...] = (
    "user_v",
    "user_w",
    "velocity_v",
    "velocity_w",
    *(f"segment_{i:02d}" for i in range(N_SEGMENTS)),
)
"""Order of the inputs: user command (2), velocities (2), laser segments from right to left (15)."""

N_INPUTS = len(INPUT_NAMES)


def as_inputs(
    user: Command, velocity: Command, segments: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Put the model's inputs into their one order.

    Parameters
    ----------
    user
        The user's command after the limitation (the model never sees more of the intent).
    velocity
        The wheelchair's measured velocities.
    segments
        Shape (15,): nearest laser return in each 12 degree segment of the front half circle, in
        metres, from right (-90 degrees) to left (+90 degrees).

    Returns
    -------
    NDArray
        Shape (19,), float64, in the order of ``INPUT_NAMES``.

    Examples
    --------
    >>> import numpy as np
    >>> from lad.command import Command
    >>> as_inputs(Command(0.7, -0.15), Command(0.5, -0.1), np.full(15, 4.0)).shape
    (19,)
    """
    x = np.empty(N_INPUTS)
    x[0], x[1] = user
    x[2], x[3] = velocity
    x[4:] = segments
    return x
