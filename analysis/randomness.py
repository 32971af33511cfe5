"""Generators of the analysis: one per purpose, so that adding one does not change the others."""

import zlib

import numpy as np

from protocols.record.reader import Study


def generator(study: Study, purpose: str) -> np.random.Generator:
    """Return the generator of a purpose: the same study and purpose give the same draws."""
    key = (zlib.crc32(b"analysis"), zlib.crc32(purpose.encode()))
    return np.random.default_rng(np.random.SeedSequence(study.seed or 0, spawn_key=key))
