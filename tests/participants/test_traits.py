"""Traits know their ranges and say so."""

from dataclasses import fields, replace

import pytest

from participants.cohort import typical_traits
from participants.traits import ResponseStyle, Traits, declared
from protocols.files.errors import InputError


@pytest.mark.parametrize("kind", [Traits, ResponseStyle])
def test_every_trait_has_a_range_and_a_source(kind):
    """No number about people without where it comes from, if only that it is an assumption."""
    assert list(declared(kind)) == [field.name for field in fields(kind)]
    for trait in declared(kind).values():
        assert trait.low < trait.high
        assert len(trait.source) > 10


@pytest.mark.parametrize("name", list(declared(Traits)))
def test_a_trait_out_of_range_is_refused(name):
    """The message names the trait, the value and the range; the ends themselves are allowed."""
    trait = declared(Traits)[name]
    for value in (trait.low, trait.high):
        replace(typical_traits(), **{name: value})
    for value in (trait.low - 0.01, trait.high + 0.01, float("nan")):
        with pytest.raises(InputError, match=f"trait {name}: .* allowed: {trait.low:g} to"):
            replace(typical_traits(), **{name: value})
