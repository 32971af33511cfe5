"""Baselines: simpler assistants with the same inputs and the same protocol.

A study protocol names one by its dotted path, e.g. ``model: {use: "lad.baselines.linear:make"}``.
All but the memoryless Gaussian process need scikit-learn (``pip install 'lad-study[baselines]'``).
Their settings are scikit-learn's defaults where it has one; nothing was tuned.
"""
