"""Which laps a replay shows."""

import pytest


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--participant", "P0001"], "--lap: is missing"),
        (["--lap", "1"], "--participant: is missing"),
        (["--compare", "P0001:1", "P0002"], "--compare: 'P0002' is no lap"),
        (["--compare", "P0001:1", "P0002:2", "--lap", "3"], "--compare: names both laps"),
        (["--compare", ":1", "P0002:2"], "--compare: ':1' is no lap"),
    ],
)
def test_a_lap_is_named_in_one_way(lad_study, options, said):
    """Exit code 2 and what is allowed; nothing is drawn."""
    found = lad_study("replay", "nowhere", *options)
    assert found.code == 2
    assert found.err.startswith(said)


def test_two_laps_are_looked_for_where_they_are_said_to_be(lad_study):
    """The options are read as laps: the study is what is missing."""
    found = lad_study("replay", "nowhere", "--compare", "P0001:1", "P0002:2")
    assert (found.code, found.err) == (2, "nowhere: no such folder\n")
