"""Smoothness of a command: spectral arc length, and log dimensionless jerk.

Both are made for movements; a whole lap is one here, so compare laps of one course only.
"""

import numpy as np

from analysis.measures.streams import Numbers, Steps, command, period

CUTOFF = 10.0
"""Highest frequency used, Hz (below the Nyquist frequency of the record anyway)."""

AMPLITUDE = 0.05
"""Share of the spectrum's maximum below which the tail is cut off."""

PADDING = 4
"""Powers of two by which the spectrum is refined."""


def sparc(steps: Steps, who: str) -> float:
    """Return the spectral arc length of a command's size; closer to 0 is smoother.

    Parameters
    ----------
    steps
        A lap's steps.
    who
        ``intent`` for the user's command, ``executed`` for what the chair was sent.

    References
    ----------
    Balasubramanian, Melendez-Calderon, Roby-Brami & Burdet (2015), J. NeuroEngineering and
    Rehabilitation 12, 112.
    """
    speed = np.linalg.norm(command(steps, who), axis=1)
    dt = period(steps)
    if len(speed) < 3 or np.isnan(speed).any() or np.isnan(dt) or not speed.any():
        return float("nan")
    return spectral_arc_length(speed, 1 / dt)


def spectral_arc_length(speed: Numbers, rate: float) -> float:
    """Return SPARC of a speed profile sampled at ``rate`` Hz.

    Examples
    --------
    One minimum-jerk movement of one second:

    >>> import numpy as np
    >>> t = np.linspace(0, 1, 101)
    >>> bell = 30 * t**2 - 60 * t**3 + 30 * t**4
    >>> round(spectral_arc_length(bell, 100.0), 1)
    -1.4
    """
    n = 2 ** (int(np.ceil(np.log2(len(speed)))) + PADDING)
    spectrum = np.abs(np.fft.rfft(speed, n))
    frequency = np.fft.rfftfreq(n, 1 / rate)
    kept = frequency <= CUTOFF
    spectrum, frequency = spectrum[kept] / spectrum.max(), frequency[kept]
    last = int(np.flatnonzero(spectrum >= AMPLITUDE)[-1])
    if last == 0:
        return float("nan")
    spectrum, frequency = spectrum[: last + 1], frequency[: last + 1]
    steps = np.hypot(np.diff(frequency) / frequency[-1], np.diff(spectrum))
    return float(-steps.sum())


def log_dimensionless_jerk(steps: Steps, who: str) -> float:
    """Return the log dimensionless jerk of a command; higher (less negative) is smoother.

    The command is a velocity, so its second derivative is the jerk; squared, integrated, made
    dimensionless by the lap's duration and the peak, and -ln taken.

    Parameters
    ----------
    steps
        A lap's steps.
    who
        ``intent`` for the user's command, ``executed`` for what the chair was sent.

    Returns
    -------
    float
        NaN for a command that never changes: its jerk is zero.

    References
    ----------
    Balasubramanian, Melendez-Calderon & Burdet (2012), IEEE Trans. Biomedical Engineering 59(8).
    """
    velocity = command(steps, who)
    dt = period(steps)
    if len(velocity) < 3 or np.isnan(velocity).any() or np.isnan(dt):
        return float("nan")
    jerk = np.diff(velocity, n=2, axis=0) / dt**2
    peak = float(np.linalg.norm(velocity, axis=1).max())
    total = float((jerk**2).sum() * dt)
    if peak == 0 or total == 0:
        return float("nan")
    duration = len(velocity) * dt
    return float(-np.log(duration**3 / peak**2 * total))
