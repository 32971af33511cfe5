"""Calibrate the default course and the demonstrator against three lap times of the paper.

    python bench/calibrate_course.py            # calibrates, and compares with what is shipped
    python bench/calibrate_course.py --shipped  # only evaluates what is shipped

Soh & Demiris (2013) print three lap times of their autonomous driver (RD) in which no learnt
model plays a part: 34.59 s on its own, 59.11 s limited, 40.5 s limited with the demonstrator's
help. Three numbers that the paper leaves open are fitted to them, and nothing else is fitted to
anything: the length of the second leg and the angle of the two sharp corners (course), and the
demonstrator's pace in a corner. The laps are those of the protocol `rd-laps`, with all its noise.

The first two lap times do not depend on the demonstrator: the course is fitted to them, then the
pace to the third. Every candidate is driven with the same random numbers, so the result is the
same every time; on another machine it may differ in the digits that a chaotic drive leaves open.
The objective is the root mean square of the deviations, in seconds.
"""

import argparse
import os
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from multiprocessing import get_context

import lay_out_course
import numpy as np
from scipy.optimize import minimize, root_scalar

from harness.session.parts import make_parts
from harness.session.session import Session
from harness.session.study_run import StudyRun
from harness.world.bullet_world import BulletWorld
from participants.attentive import AttentiveOptions
from protocols.course.schema import Course
from protocols.load import resolve_study
from protocols.resolved import ResolvedStudy

PAPER = {"baseline": 34.59, "limited": 59.11, "demonstrator": 40.5}
"""Lap times in s: sections IV.A (the first two) and IV.E."""

CONDITIONS = tuple(PAPER)

REPLICATES = 32
SEED = 2013
"""Of the laps driven here; a study's own seeds are others."""


@dataclass(frozen=True)
class Candidate:
    """What is calibrated: metres, degrees, a share."""

    second_leg: float
    sharp: float
    pace: float


START = Candidate(second_leg=9.0, sharp=135.0, pace=1.0)
"""A round layout, and a demonstrator who drives a corner as fast as it can be driven."""

STEP = Candidate(second_leg=0.15, sharp=2.0, pace=0.1)
"""Size of the search's first steps."""

COURSE_TRIALS, PACE_TRIALS = 14, 4
"""Courses and paces tried at most: the search ends in the noise of the means, about 0.1 s."""

ENOUGH = 0.05
"""Objectives nearer to each other than this count as equal, s."""


def shipped() -> Candidate:
    """Return what is shipped."""
    layout = lay_out_course.LAB_OFFICE
    return Candidate(layout.second_leg, layout.sharp[0], AttentiveOptions().pace)


def study_of(candidate: Candidate, conditions: tuple[str, ...]) -> ResolvedStudy:
    """Return laps of ``rd-laps`` with a candidate's course and demonstrator."""
    study = resolve_study("rd-laps")
    layout = replace(
        lay_out_course.LAB_OFFICE,
        second_leg=candidate.second_leg,
        sharp=(candidate.sharp, candidate.sharp),
    )
    course = Course.model_validate(lay_out_course.lay_out(layout, "candidate", "Candidate", ""))
    protocol = study.protocol
    demonstrator = protocol.cohort.demonstrator.model_copy(
        update={"options": {"pace": candidate.pace}}
    )
    cohort = protocol.cohort.model_copy(update={"demonstrator": demonstrator})
    laps = tuple(lap for lap in protocol.laps if lap.condition in conditions)
    return replace(
        study,
        protocol=protocol.model_copy(update={"cohort": cohort, "laps": laps}),
        course=course,
    )


def drive(candidate: Candidate, conditions: tuple[str, ...], number: int) -> list[float]:
    """Return one replicate's lap times in the order of the conditions, s."""
    study = study_of(candidate, conditions)
    protocol = study.protocol
    world = BulletWorld(
        study.course, protocol.laser, protocol.control_period_s, start_noise=protocol.start_noise
    )
    try:
        run = StudyRun(study, SEED)
        laps = Session(run, number, world, make_parts(run, number)).run().laps
    finally:
        world.close()
    times = {lap.row.condition: lap.row.duration_s for lap in laps}
    return [times[condition] for condition in conditions]


def deviations(
    pool: ProcessPoolExecutor, candidate: Candidate, conditions: tuple[str, ...] = CONDITIONS
) -> np.ndarray:
    """Return mean lap times minus the paper's, s."""
    tasks = [candidate] * REPLICATES, [conditions] * REPLICATES, range(1, REPLICATES + 1)
    times = np.array(list(pool.map(drive, *tasks)))
    paper = np.array([PAPER[condition] for condition in conditions])
    found = times.mean(axis=0) - paper
    means = zip(conditions, paper + found, found, strict=True)
    listed = ", ".join(f"{name} {mean:.2f} ({off:+.2f})" for name, mean, off in means)
    print(f"{_text(candidate)}: {listed}; objective {objective(found):.3f} s", flush=True)
    return found


def objective(found: np.ndarray) -> float:
    """Return the root mean square deviation, s."""
    return float(np.sqrt((found**2).mean()))


def calibrate(pool: ProcessPoolExecutor) -> Candidate:
    """Fit the course to what happens without the demonstrator, then the demonstrator's pace."""

    def course(x: np.ndarray) -> Candidate:
        return replace(START, second_leg=round(float(x[0]), 2), sharp=round(float(x[1]), 1))

    start = np.array([START.second_leg, START.sharp])
    fitted = minimize(
        lambda x: objective(deviations(pool, course(x), CONDITIONS[:2])),
        start,
        method="Nelder-Mead",
        options={
            "initial_simplex": [start, *(start + np.diag([STEP.second_leg, STEP.sharp]))],
            "fatol": ENOUGH,
            "xatol": STEP.sharp,
            "maxfev": COURSE_TRIALS,
        },
    )
    best = course(fitted.x)

    def behind(pace: float) -> float:
        candidate = replace(best, pace=round(float(pace), 2))
        return float(deviations(pool, candidate, CONDITIONS[2:])[0])

    found = root_scalar(
        behind, x0=START.pace, x1=START.pace - STEP.pace, method="secant", maxiter=PACE_TRIALS,
        xtol=0.02,
    )  # fmt: skip
    return replace(best, pace=round(float(found.root), 2))


def _text(candidate: Candidate) -> str:
    return ", ".join(f"{name} {value:.3f}" for name, value in vars(candidate).items())


def main() -> None:
    """Calibrate, and compare with what is shipped."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--shipped", action="store_true", help="only evaluate what is shipped")
    only_shipped = parser.parse_args().shipped
    with ProcessPoolExecutor(os.cpu_count(), mp_context=get_context("spawn")) as pool:
        best = None if only_shipped else calibrate(pool)
        for name, candidate in (("calibrated", best), ("shipped", shipped())):
            if candidate is not None:
                print(f"{name}:")
                deviations(pool, candidate)


if __name__ == "__main__":
    main()
