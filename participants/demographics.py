"""Age, gender and handedness of a synthetic participant."""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy import optimize

from protocols.cohort import AgeRange, Demographics
from protocols.files.errors import InputError


@dataclass(frozen=True, slots=True)
class Particulars:
    """What a person enters on a form; categories as in the record."""

    age_years: int
    gender: str
    handedness: str


def draw_particulars(demographics: Demographics, rng: np.random.Generator) -> Particulars:
    """Draw age, gender and handedness independently of each other."""
    years, shares = age_distribution(demographics.age_years)
    age = int(rng.choice(years, p=shares))
    gender = "female" if rng.random() < demographics.female_share else "male"
    handedness = "left" if rng.random() < demographics.left_handed_share else "right"
    return Particulars(age, gender, handedness)


@lru_cache(maxsize=16)
def age_distribution(ages: AgeRange) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return the whole years of age and the probability of each.

    It is the distribution of greatest entropy over these years with this mean and standard
    deviation: it assumes nothing else.

    Examples
    --------
    >>> years, shares = age_distribution(AgeRange())
    >>> round(float(years @ shares), 3)
    27.0
    """
    years = np.arange(math.ceil(ages.lowest), math.floor(ages.highest) + 1)
    scaled = (years - ages.mean) / ages.sd

    def shares(tilt: NDArray[np.float64]) -> NDArray[np.float64]:
        exponent = tilt[0] * scaled + tilt[1] * scaled**2
        weights = np.exp(exponent - exponent.max())
        return np.asarray(weights / weights.sum(), dtype=np.float64)

    def miss(tilt: NDArray[np.float64]) -> NDArray[np.float64]:
        p = shares(tilt)
        return np.array([p @ scaled, p @ scaled**2 - 1.0])

    found = optimize.root(miss, np.array([0.0, -0.5]))
    if not found.success:
        raise InputError(
            f"age_years: no distribution over {years[0]} to {years[-1]} whole years has mean "
            f"{ages.mean:g} and sd {ages.sd:g}"
        )
    return years, shares(found.x)
