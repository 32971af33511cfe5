"""`lad-study import`: maps become courses, recordings become studies, exports become answers."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from harness.cli.console import complain, progress_line, say
from protocols.files.errors import InputError

if TYPE_CHECKING:
    from protocols.importing.map.ros_map import RosMap

app = typer.Typer(
    name="import",
    no_args_is_help=True,
    rich_markup_mode=None,
    help="Bring in a building's map, a wheelchair's recording, or a questionnaire's export.",
)

_GUESS = typer.Option("--guess", help="Print a draft of the mapping, and do nothing else.")


def needed(option: str, value: Path | None) -> Path:
    """Return an option's value, or refuse that it is missing.

    Raises
    ------
    InputError
        Names the option.
    """
    if value is None:
        raise InputError(f"{option}: missing; allowed: a path (or --guess, which needs none)")
    return value


@app.command("answers")
def answers(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A questionnaire export (CSV).")],
    mapping: Annotated[
        Path | None, typer.Option("--map", metavar="MAPPING.yaml", help="What is where in it.")
    ] = None,
    study: Annotated[
        Path | None, typer.Option(metavar="DIR", help="A study that was recorded elsewhere.")
    ] = None,
    guess: Annotated[bool, _GUESS] = False,
) -> None:
    """Add a questionnaire service's answers to a study.

    Everything that belongs to nothing is listed. A commented mapping to copy:
    lad-study show answers-mapping.

    Example: lad-study import answers qualtrics.csv --map answers.yaml --study studies/ward
    """
    if guess:
        from protocols.importing.answers.guess import guess_mapping

        typer.echo(guess_mapping(file), nl=False)
        return
    from protocols.importing.answers.write import import_answers

    done = import_answers(file, needed("--map", mapping), needed("--study", study))
    for line in done.unmatched:
        complain(line)
    say(f"Answers: {done.rows} questions, {done.answered} answered")


@app.command("map")
def import_map(
    drawn_map: Annotated[
        Path, typer.Argument(metavar="MAP.yaml", help="A map of ROS's map_server.")
    ],
    route: Annotated[
        Path | None,
        typer.Option(metavar="ROUTE.yaml", help="Where through it.", show_default="none"),
    ] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="COURSE.yaml", help="The course to write.")
    ] = None,
    picture: Annotated[
        Path | None,
        typer.Option(metavar="PNG", help="A picture to look at.", show_default="beside the course"),
    ] = None,
) -> None:
    """Make a course of a building's map.

    Without a route: a picture of the map with a grid, and a draft of a route file. A commented
    route to copy: lad-study show map-route.

    Example: lad-study import map ward.yaml --route route.yaml --out ward-course.yaml
    """
    from protocols.importing.map.ros_map import read_map

    drawn = read_map(drawn_map)
    if route is None:
        _draft_route(drawn, picture or drawn_map.with_name(f"{drawn_map.stem}-grid.png"))
        return
    target = needed("--out", out)
    _write_course(drawn, route, target, picture or target.with_suffix(".png"))


def _draft_route(drawn: "RosMap", picture: Path) -> None:
    from analysis.figures.files import png
    from analysis.figures.imported_map import map_with_grid
    from protocols.importing.map.draft import draft_route
    from protocols.record.atomic import write_whole

    write_whole(picture, png(map_with_grid(drawn)))
    typer.echo(draft_route(drawn), nl=False)
    complain(f"Picture: {picture}")


def _write_course(drawn: "RosMap", route: Path, out: Path, picture: Path) -> None:
    from analysis.figures.files import png
    from analysis.figures.imported_map import map_with_course
    from harness.world.step_cost import step_cost_ratio
    from protocols.course.centreline import Centreline
    from protocols.files.dump import to_yaml
    from protocols.importing.map.course import import_course
    from protocols.load import load_course
    from protocols.record.atomic import write_whole

    done = import_course(drawn, route)
    kinds = [bend.kind for bend in done.bends]
    width, height = drawn.size
    say(f"Map: {width:.1f} m x {height:.1f} m; route: {Centreline(done.course).length:.1f} m")
    say(
        f"Right turns: {kinds.count('sharp_right')} sharp, {kinds.count('soft_right')} soft; "
        f"left turns: {kinds.count('left')}"
    )
    if "sharp_right" not in kinds:
        complain("No right turn is sharp: the control limitation will hardly be felt.")
    for x, y in done.too_tight:
        complain(f"({x:.2f}, {y:.2f}): the chair touches something on the centreline there")
    before, after = done.corners
    say(f"Walls: {before} corners became {after}; {done.specks} specks dropped")
    ratio = step_cost_ratio(done.course, load_course("lab-office"))
    say(f"A control step takes {ratio:.1f} times as long as on lab-office")
    write_whole(picture, png(map_with_course(drawn, done.course)))
    write_whole(out, to_yaml(done.course).encode())
    say(f"Picture: {picture}")
    say(f"Course: {out}")


@app.command("bag")
def import_bag(
    bags: Annotated[
        list[Path], typer.Argument(metavar="BAG...", help="Recordings: ROS 1, ROS 2, MCAP.")
    ],
    mapping: Annotated[
        Path | None, typer.Option("--map", metavar="MAPPING.yaml", help="What is what in them.")
    ] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Study directory to make.")
    ] = None,
    guess: Annotated[bool, _GUESS] = False,
) -> None:
    """Make a study of a real wheelchair's recordings, one session each.

    Gaps, clocks and frames that do not fit are named for each lap. A commented mapping to copy:
    lad-study show bag-mapping.

    Example: lad-study import bag p1.mcap p2.mcap --map bags.yaml --out studies/ward
    """
    try:
        from harness.importing.guess import guess_bag_mapping
        from harness.importing.study import import_bags
    except ImportError as error:
        raise InputError(
            f"import bag: needs the package {error.name}, which is not installed; "
            "allowed: pip install 'lad-study[exchange]'"
        ) from None
    if guess:
        typer.echo(guess_bag_mapping(bags[0]), nl=False)
        return
    map_file, target = needed("--map", mapping), needed("--out", out)
    with progress_line() as tell:
        done = import_bags(bags, map_file, target, tell)
    for trouble in done.troubles:
        complain(trouble)
    say(f"Sessions: {done.sessions}, laps: {done.laps}, of which {done.finished} finished")
    say(f"Study: {target}")
