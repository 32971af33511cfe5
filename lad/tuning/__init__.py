"""Hyperparameters from the demonstrations themselves, by evidence: the paper's footnote 5."""
