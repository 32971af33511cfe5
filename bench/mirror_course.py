"""Write the mirror image of the default course: what was a right turn is a left one.

    python bench/mirror_course.py protocols/courses/lab-office-mirror.yaml

A negative control: the limitation scales right turns, so that here it should hardly matter. Gates
R1 and R2 become L1 and L2; walls and furniture keep their names but for the corner they stand at.
"""

from course_draft import write_course
from lay_out_course import LAB_OFFICE, lay_out


def mirrored(course: dict) -> dict:
    """Return a course mirrored about the line that its start heads along (y = 0)."""
    return {
        **course,
        "gates": [
            {"name": _named(g["name"]), "left": _point(g["right"]), "right": _point(g["left"])}
            for g in course["gates"]
        ],
        "centreline": [_point(p) for p in course["centreline"]],
        "sections": [
            {**s, "name": _named(s["name"]), "kind": _kind(s["kind"])} for s in course["sections"]
        ],
        "walls": [
            {**w, "name": _named(w["name"]), "points": [_point(p) for p in w["points"]]}
            for w in course["walls"]
        ],
        "furniture": [
            {**f, "name": _named(f["name"]), "y": _negative(f["y"]),
             "heading": _negative(f["heading"])}
            for f in course["furniture"]
        ],
    }  # fmt: skip


def _point(point: list[float]) -> list[float]:
    return [point[0], _negative(point[1])]


def _negative(value: float) -> float:
    return -value + 0.0


def _named(name: str) -> str:
    return name.replace("R1", "L1").replace("R2", "L2")


def _kind(kind: str) -> str:
    return "left" if "right" in kind else kind


def lab_office_mirror() -> dict:
    """Return the course lab-office-mirror as the plain data of its file."""
    return mirrored(
        lay_out(
            LAB_OFFICE, "lab-office-mirror", "Lab office loop, mirrored",
            "The mirror image of lab-office: from S through sharp left turns at L1 and L2, and "
            "back to F through two soft left bends.",
        )
    )  # fmt: skip


if __name__ == "__main__":
    write_course(lab_office_mirror, __doc__.splitlines()[0])
