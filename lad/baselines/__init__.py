"""Baselines: simpler assistants with the same inputs and the same protocol.

A study protocol names one by its shipped name, e.g. ``model: {use: linear}``.
All but the memoryless Gaussian process need scikit-learn (``pip install 'lad-study[baselines]'``).
Their settings are scikit-learn's defaults where it has one; nothing was tuned.
"""
