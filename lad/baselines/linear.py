"""Logistic regression for when to help, linear regression for how; fitted per demonstration."""

from lad.baselines.estimators import LogisticRegression, Ridge, StandardScaler, make_pipeline
from lad.baselines.refitted import RefittedAssistant


def make(penalty: float = 1.0, threshold: float = 0.5) -> RefittedAssistant:
    """Return a linear assistant; inputs are standardised over the steps it was taught.

    Parameters
    ----------
    penalty
        Weight of the squared coefficients, above 0, against the sum over all steps.
    threshold
        W_h.
    """
    return RefittedAssistant(
        make_pipeline(StandardScaler(), LogisticRegression(C=1 / penalty, max_iter=1000)),
        make_pipeline(StandardScaler(), Ridge(alpha=penalty)),
        threshold,
    )
