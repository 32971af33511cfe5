"""The errors of this package, one line each: what was given, and what is allowed."""


class HyperparameterError(ValueError):
    """A hyperparameter that no model can have; nothing was built."""


class InvalidInputError(ValueError):
    """An input the model cannot look at; the model is as it was before."""


class InvalidTargetError(ValueError):
    """A target or label the model cannot learn from; the model is as it was before."""


class ModelFileError(ValueError):
    """Bytes that are not a saved model, or not one that this version can read."""


class TooFewStepsError(ValueError):
    """Too little was taught to tune hyperparameters by; the model is as it was before."""
