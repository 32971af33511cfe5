"""Effects that a person states, as text."""

import math
import re
from collections.abc import Iterable, Mapping

from analysis.power.pool import Pool
from protocols.declared import Comparison
from protocols.files.errors import InputError
from protocols.files.suggestion import allowed
from protocols.study import StudyProtocol

_STATED = re.compile(r"^\s*([+-]?\d+(?:\.\d+)?)\s*(%|s)?\s*$")


def stated_effects(
    texts: Iterable[str], protocol: StudyProtocol, pool: Pool
) -> Mapping[str, float]:
    """Return the effects that are stated: log ratios for lap times, else in the outcome's unit.

    Parameters
    ----------
    texts
        Each an analysis's name, a colon, and the effect: ``the model helps: -10%`` or ``: -5 s``
        for lap times, a plain number for other outcomes.
    protocol
        Declares the analyses.
    pool
        Its mean of the reference turns seconds into shares.

    Raises
    ------
    InputError
        When there is no such analysis, or it has no such effect.
    """
    analyses = {analysis.name: analysis for analysis in protocol.analyses}
    found = {}
    for text in texts:
        name, _, effect = text.rpartition(":")
        if name.strip() not in analyses:
            raise InputError(
                f"--assume: '{name.strip()}' is not a declared analysis; "
                f"{allowed(name.strip(), analyses)}"
            )
        analysis = analyses[name.strip()]
        found[analysis.name] = _effect(effect, analysis, pool.reference_means[analysis.name])
    return found


def _effect(text: str, analysis: Comparison, reference: float) -> float:
    match = _STATED.match(text)
    timed = analysis.outcome == "lap_time_s"
    if match is None or (timed and not match[2]) or (not timed and match[2] == "%"):
        form = "-10% or -5 s" if timed else "a number in the outcome's unit"
        raise InputError(f"--assume: '{analysis.name}:{text}' states no effect; allowed: {form}")
    number = float(match[1])
    if not timed:
        return number
    share = number / 100 if match[2] == "%" else number / reference
    if share <= -1:
        raise InputError(f"--assume: '{analysis.name}:{text}' leaves no time; allowed: above -100%")
    return math.log1p(share)
