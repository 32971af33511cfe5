"""`lad-study preregister`: a study's plan, frozen before its first session."""

from pathlib import Path
from typing import Annotated

import typer

from harness.cli.console import say


def preregister(
    protocol: Annotated[
        str, typer.Argument(metavar="PROTOCOL", help="A shipped protocol's name, or a file.")
    ],
    out: Annotated[Path, typer.Option(help="Folder of the registration.")],
    participants: Annotated[
        int | None, typer.Option(help="1 to 9999, in place of the protocol's own number.")
    ] = None,
    course: Annotated[
        str | None, typer.Option(help="Another course than the protocol's: a name or a file.")
    ] = None,
    amend: Annotated[
        str, typer.Option(metavar="REASON", help="Amend the plan in that folder, and say why.")
    ] = "",
) -> int:
    """Freeze what will be done, and write it under the headings of the common registries.

    Orders and groups of a study that is run with --registration follow from the plan's digest, so
    its own data show that the plan came first.

    Example: lad-study preregister my-study.yaml --out my-registration
    """
    from protocols.load import resolve_study
    from protocols.registration import TEXT_FILE, read_registration, write_registration

    study = resolve_study(protocol, course=course, participants=participants)
    gaps = write_registration(study, out, amend)
    registration = read_registration(out)
    say(f"Registration: {out / TEXT_FILE}")
    say(f"Digest: {registration.heads[-1].digest}")
    for gap in gaps:
        say(f"To be written: {gap}")
    return 0
