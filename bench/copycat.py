"""Why `tune: evidence` leaves the classifier's lengthscales alone: the model that tunes them, too.

    cd bench
    lad-study benchmark lad lad+evidence copycat:table_i --trust --setting right \
        --demonstrations 1 --seed 7411 --out ../benchmarks/copycat

The classifier's signal variance and its three lengthscales maximise Laplace's approximation of the
evidence times the prior that the regressor has: log-normal around Table I, sd 1. The regressor is
Table I's, so that nothing else differs. In the table: `Brier demonstrated` and `p at onset` say how
well p(h) forecasts a demonstration, the lap what that forecast is worth.
"""

import numpy as np
from scipy.optimize import minimize

from lad.correction import CorrectionAssistant
from lad.hyperparameters import GPHyperparameters, LADParameters
from lad.lad_assistant import LADAssistant
from lad.tuning.classifier import log_evidence
from lad.tuning.distances import Distances
from lad.tuning.regressor import REACH, rounded
from lad.tuning.taught import TaughtSteps, spread_out
from lad.tuning.tune import GROUPS, Tuned, refuse_too_few

MOST_STEPS = 200
"""Steps that the evidence is computed of: it is evaluated some hundred times."""


def tuned_classifier(parameters: LADParameters, taught: TaughtSteps) -> GPHyperparameters:
    """Return the classifier whose signal variance and lengthscales maximise the evidence."""
    chosen = spread_out(len(taught), MOST_STEPS)
    distances = Distances.of(taught.stacked()[chosen], GROUPS)
    labels = np.where(taught.helped[chosen], 1.0, -1.0)
    scale = parameters.classifier.squared_temporal_scale
    centre = np.log(
        [
            parameters.signal_variance,
            parameters.lengthscale_user,
            parameters.lengthscale_velocity,
            parameters.lengthscale_laser,
        ]
    )

    def loss(logs: np.ndarray) -> float:
        kappa, _ = distances.kappa(np.exp(logs[1:]), scale)
        found = log_evidence(
            float(np.exp(logs[0])), kappa, labels, parameters.noise_when, parameters.prior_help
        )
        return float(-found + 0.5 * np.sum((logs - centre) ** 2))

    bounds = [(c - REACH, c + REACH) for c in centre]
    found = minimize(loss, centre, method="L-BFGS-B", bounds=bounds, options={"eps": 1e-4})
    variance, user, velocity, laser = (rounded(float(value)) for value in np.exp(found.x))
    changed = {
        "signal_variance": variance,
        "lengthscale_user": user,
        "lengthscale_velocity": velocity,
        "lengthscale_laser": laser,
    }
    return parameters.model_copy(update=changed).classifier


class _TunesLengthscales(LADAssistant):
    """Tunes the whole classifier when a lap starts, and nothing of the regressor."""

    def tune(self) -> Tuned:
        taught = TaughtSteps() if self.taught is None else self.taught
        refuse_too_few(taught)
        when = tuned_classifier(self.parameters, taught)
        tuned = Tuned(when, self.parameters.regressor, len(taught))
        self._teach_again(taught, tuned)
        return tuned


class _CorrectionThatTunes(_TunesLengthscales, CorrectionAssistant):
    """The same of the model that learns corrections."""


def table_i() -> LADAssistant:
    """Return Table I with its classifier's lengthscales tuned."""
    return _TunesLengthscales(LADParameters(tune="evidence"))


def correction() -> LADAssistant:
    """Return `lad-correction` with its classifier's lengthscales tuned."""
    return _CorrectionThatTunes(LADParameters(tune="evidence"))
