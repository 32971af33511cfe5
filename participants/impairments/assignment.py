"""Who has which impairment: a share of the cohort, by each person's own random numbers."""

from collections.abc import Sequence

import numpy as np

from protocols.cohort import ImpairmentChoice


def assigned(
    impairments: Sequence[ImpairmentChoice], rng: np.random.Generator
) -> ImpairmentChoice | None:
    """Return the impairment a person has, if any.

    A person has at most one of those a protocol names, each with the probability of its share.
    One draw from the person's own numbers decides, so it does not depend on who else takes part.

    Parameters
    ----------
    impairments
        The protocol's; their shares add up to 1 at most.
    rng
        This person's own random numbers.

    Examples
    --------
    >>> half = ImpairmentChoice(use="tremor", share=0.5)
    >>> people = [assigned([half], np.random.default_rng(seed)) for seed in range(8)]
    >>> ["none" if person is None else person.use for person in people][:4]
    ['none', 'none', 'tremor', 'tremor']
    """
    draw = rng.random()
    for impairment in impairments:
        if draw < impairment.share:
            return impairment
        draw -= impairment.share
    return None
