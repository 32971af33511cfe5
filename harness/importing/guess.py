"""Draft a mapping from the topics of a recording."""

from pathlib import Path

from harness.importing.recording import topics_of

_POSES = ("PoseWithCovarianceStamped", "PoseStamped", "Odometry")


def guess_bag_mapping(path: Path) -> str:
    """Return the text of a mapping to look at and to correct.

    Raises
    ------
    InputError
        When the recording cannot be read.
    """
    there = {name: kind.rsplit("/", 1)[-1] for name, (kind, _) in topics_of(path).items()}
    pose = next((t for kind in _POSES for t in _of(there, kind)), "/not_found")
    velocity = next(iter(_of(there, "Odometry")), pose)
    twists = [*_of(there, "TwistStamped"), *_of(there, "Twist")]
    executed = _like(twists, ("cmd_vel", "executed", "command"))
    wanted = [*_of(there, "Joy"), *twists]
    intent = _like(wanted, ("intent", "joy", "user", "stick"))
    scan = next(iter(_of(there, "LaserScan")), "/not_found")
    takeover = _like([*_of(there, "Bool"), *_of(there, "Int8")], ("takeover", "override"))
    marks = _like(_of(there, "String"), ("lap", "mark", "event"))
    lines = [
        f"# Drafted from {path.name}: look through it and correct it. It has the topics",
        *(f"#   {name}  {kind}  {count}" for name, (kind, count) in topics_of(path).items()),
        "schema: 1",
        "protocol: four-lap",
        "clock: header",
        f"pose: {{topic: {pose}, transform: {{x: 0.0, y: 0.0, yaw: 0.0}}}}",
        *([f"velocity: {{topic: {velocity}}}"] if velocity != pose else []),
        f"scan: {{topic: {scan}, forward_rad: 0.0}}",
        f"executed: {{topic: {executed}}}",
        f"intent: {{topic: {intent}}}",
        f"starts: {{topic: {marks if marks != '/not_found' else intent}}}",
    ]
    if takeover != "/not_found":
        helper = _like(twists, ("demonstrator", "assist", "helper"))
        lines += [f"takeover: {{topic: {takeover}}}", f"demonstrator: {{topic: {helper}}}"]
    return "\n".join([*lines, ""])


def _of(there: dict[str, str], kind: str) -> list[str]:
    return [name for name, found in there.items() if found == kind]


def _like(names: list[str], words: tuple[str, ...]) -> str:
    """Return the topic whose name has one of some words; the first one when none has."""
    for word in words:
        for name in names:
            if word in name.lower():
                return name
    return names[0] if names else "/not_found"
