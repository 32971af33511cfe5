"""Which passages the drivers that ship get through: width, length, and how long a lap takes.

    python bench/passages.py [PEOPLE]

One row for each width, length and driver: how many of PEOPLE (3 by default) finish a lap of
300 s through a hall with one passage in it, without limitation or help, and their lap times.
"""

import sys
from unittest import mock

from harness.session.parts import make_parts
from harness.session.session import Session
from harness.session.study_run import StudyRun
from harness.world.bullet_world import BulletWorld
from protocols.course.schema import Course
from protocols.record.rows import LapRow
from protocols.resolved import ResolvedStudy
from protocols.study import StudyProtocol

WIDTHS = (0.80, 0.85, 0.90, 0.95, 1.0, 1.1)
LENGTHS = (0.1, 1.0, 4.0, 8.0)
BEFORE = 4.0
"""How far before the passage, and past it, the hall goes on, m."""


def hall(width: float, length: float) -> Course:
    """Return a hall of 4 m width that a passage divides."""
    end, side = 2 * BEFORE + length, 2 - width / 2
    finish = BEFORE + length + 2
    blocks = [("left", 2 - side / 2), ("right", side / 2 - 2)]
    return Course.model_validate(
        {
            "name": "hall",
            "title": f"A passage of {width:g} x {length:g} m",
            "walls": [
                {"name": "hall", "closed": True, "points": [[0, -2], [end, -2], [end, 2], [0, 2]]}
            ],
            "furniture": [
                {"name": name, "x": BEFORE + length / 2, "y": y, "length": length, "width": side}
                for name, y in blocks
            ],
            "start": {"x": 1.0, "y": 0.4, "heading": 0.0},
            "gates": [{"name": "F", "left": [finish, 2], "right": [finish, -2]}],
            "centreline": [[1.0, 0.4], [2.5, 0.0], [finish, 0.0]],
            "sections": [{"name": "all", "kind": "straight"}],
        }
    )


def laps(course: Course, driver: str, people: int) -> list[LapRow]:
    """Return one lap of each person."""
    protocol = StudyProtocol.model_validate(
        {
            "name": "passage",
            "title": "One lap",
            "course": course.name,
            "conditions": {"baseline": {}},
            "cohort": {"participants": people, "driver": {"use": driver}},
            "laps": [{"condition": "baseline"}],
        }
    )
    study = ResolvedStudy(protocol, course, ())
    world = BulletWorld(
        course,
        laser=protocol.laser,
        period=protocol.control_period_s,
        start_noise=protocol.start_noise,
    )
    run = StudyRun(study, 0)
    sessions = [
        Session(run, number, world, make_parts(run, number)).run()
        for number in range(1, people + 1)
    ]
    return [lap.row for session in sessions for lap in session.laps]


def main() -> None:
    """Print the table."""
    people = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    with mock.patch("participants.human.room.check_passages"):  # it refuses what is measured here
        measure(people)


def measure(people: int) -> None:
    """Print a row for each passage and driver."""
    for width in WIDTHS:
        for length in LENGTHS:
            for driver, count in (("human", people), ("autonomous", 1)):
                rows = laps(hall(width, length), driver, count)
                times = [round(row.lap_time_s, 1) for row in rows if row.lap_time_s is not None]
                print(f"{width:.2f} x {length:g} m, {driver}: {len(times)} of {count} {times}")


if __name__ == "__main__":
    main()
