"""Driven laps, kept on disk as they come, so that a calibration can be broken off."""

import hashlib
import json
import time
from collections.abc import Callable
from dataclasses import asdict, astuple
from pathlib import Path

from cohort.lap_pairs import Pair, drive_all
from cohort.people import SEED, Numbered

from protocols.load import load_course

PORTION = 50
"""How many people drive between two writes."""


def drive(
    people: Numbered, keep: Path | None, *, time_limit: float | None = None, jobs: int = 1,
    seed: int = SEED, say: Callable[[str], None] = print,
) -> list[Pair]:  # fmt: skip
    """Return the laps of all people; those driven before for the same people and course are read.

    Parameters
    ----------
    people
        Who drives.
    keep
        A folder; None keeps nothing. Empty it when the drivers' code changes.
    time_limit, jobs, seed
        As for ``drive_all``.
    say
        Called from time to time with how far it is.
    """
    pairs: list[Pair] = []
    for i in range(0, len(people), PORTION):
        some = people[i : i + PORTION]
        path = None if keep is None else keep / f"{_digest(some, time_limit, seed)}.json"
        if path is not None and path.exists():
            pairs += [Pair(*row) for row in json.loads(path.read_text())]
            continue
        begun = time.perf_counter()
        driven = drive_all(some, seed, time_limit=time_limit, jobs=jobs)
        pairs += driven
        say(f"  {len(pairs)} of {len(people)} pairs; {time.perf_counter() - begun:.0f} s for these")
        if path is not None:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(json.dumps([astuple(pair) for pair in driven]))
    return pairs


def _digest(people: Numbered, time_limit: float | None, seed: int) -> str:
    course = load_course("lab-office").model_dump_json()
    who = [(number, asdict(traits)) for number, traits in people]
    return hashlib.sha256(repr((course, who, time_limit, seed)).encode()).hexdigest()[:16]
