"""The estimators of scikit-learn that baselines are made of, or one line on how to get them."""

try:
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.linear_model import LogisticRegression, Ridge
    from sklearn.neighbors import KNeighborsClassifier, KNeighborsRegressor
    from sklearn.neural_network import MLPClassifier, MLPRegressor
    from sklearn.pipeline import make_pipeline
    from sklearn.preprocessing import StandardScaler
except ImportError as error:
    raise ImportError(
        "scikit-learn is not installed; it comes with pip install 'lad-study[baselines]'"
    ) from error

__all__ = [
    "ConvergenceWarning",
    "KNeighborsClassifier",
    "KNeighborsRegressor",
    "LogisticRegression",
    "MLPClassifier",
    "MLPRegressor",
    "Ridge",
    "StandardScaler",
    "make_pipeline",
]
