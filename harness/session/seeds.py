"""Every random draw comes from a named child of the study's one seed."""

from zlib import crc32

import numpy as np


def _child(seed: int, participant: int, name: str) -> np.random.SeedSequence:
    return np.random.SeedSequence(seed, spawn_key=(participant, crc32(name.encode())))


def generator(seed: int, participant: int, name: str) -> np.random.Generator:
    """Return the random numbers of one component of one participant's session.

    Children are found by name, not by order: adding a component changes no other draws, and a
    participant's draws do not depend on how many others take part.

    Parameters
    ----------
    seed
        The study's seed, 0 or more.
    participant
        The participant's number, counted from 1.
    name
        The component, e.g. ``"lap 2/laser"``.

    Examples
    --------
    >>> generator(0, 1, "traits").random() == generator(0, 1, "traits").random()
    True
    >>> generator(0, 1, "traits").random() == generator(0, 2, "traits").random()
    False
    """
    return np.random.default_rng(_child(seed, participant, name))


def fingerprint(seed: int, participant: int, name: str) -> int:
    """Return a 64 bit number that identifies a generator, for the record."""
    return int(_child(seed, participant, name).generate_state(1, np.uint64)[0])
