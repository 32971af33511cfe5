"""Generators are found by name and never share draws."""

from harness.session.seeds import fingerprint, generator


def test_the_same_name_gives_the_same_draws():
    """A generator is a function of seed, participant and name."""
    assert (
        generator(3, 2, "lap 1/world").random(5) == generator(3, 2, "lap 1/world").random(5)
    ).all()


def test_seed_participant_and_name_each_give_other_draws():
    """Changing any of the three changes the draws."""
    draws = {
        generator(seed, participant, name).random()
        for seed in (0, 1)
        for participant in (1, 2)
        for name in ("a", "b")
    }
    assert len(draws) == 8


def test_the_fingerprint_identifies_the_generator():
    """Fingerprints differ where generators do and fit a 64 bit column."""
    prints = {fingerprint(0, p, n) for p in range(1, 50) for n in ("lap 0/world", "lap 1/world")}
    assert len(prints) == 98
    assert all(0 <= p < 2**64 for p in prints)
