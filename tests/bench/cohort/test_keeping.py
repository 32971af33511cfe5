"""Driven laps are kept, and what is kept is not driven again."""

from cohort import keeping
from cohort.lap_pairs import Pair
from cohort.people import of_every_kind


def test_kept_laps_are_read_not_driven(tmp_path, monkeypatch):
    """The second call gets the same laps without driving; other people drive."""
    driven = []

    def drive_all(people, seed, **rules):
        driven.extend(number for number, _ in people)
        return [Pair(number + 0.25, 2.0 * number, True, False) for number, _ in people]

    monkeypatch.setattr(keeping, "drive_all", drive_all)
    monkeypatch.setattr(keeping, "PORTION", 2)
    people = of_every_kind(5)
    first = keeping.drive(people, tmp_path, say=lambda _: None)
    again = keeping.drive(people, tmp_path, say=lambda _: None)
    assert first == again
    assert driven == [1, 2, 3, 4, 5]
    keeping.drive(people, tmp_path, time_limit=9.0, say=lambda _: None)
    assert len(driven) == 10
    assert len(keeping.drive(people, None, say=lambda _: None)) == 5
