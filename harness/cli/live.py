"""`lad-study live`: a study with living people in browsers."""

from pathlib import Path
from typing import Annotated

import typer

from harness.cli.console import complain, say
from harness.cli.options import check_least
from harness.cli.reporting import write_report_of
from protocols.files.errors import InputError

EXTRA = "needs the web server's packages; install them with pip install 'lad-study[live]'"


def live(
    protocol: Annotated[str, typer.Argument(help="A shipped protocol's name, or a file.")],
    participants: Annotated[
        int | None, typer.Option(help="1 to 9999, in place of the protocol's own number.")
    ] = None,
    seed: Annotated[int, typer.Option(help="0 or more.")] = 0,
    out: Annotated[
        Path | None,
        typer.Option(help="Study directory.  [default: studies/PROTOCOL-live]"),
    ] = None,
    port: Annotated[int, typer.Option(help="0 takes a free one.")] = 8080,
    seats: Annotated[int, typer.Option(help="Sessions at a time, 1 or more.")] = 1,
    lan: Annotated[
        bool, typer.Option("--lan", help="Serve the local network, too; prints QR codes.")
    ] = False,
    public_origin: Annotated[
        str | None,
        typer.Option(metavar="URL", help="Address behind a reverse proxy, https://..."),
    ] = None,
    links: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Write the links as JSON.")
    ] = None,
    new_links: Annotated[
        bool, typer.Option("--new-links", help="The links printed before open nothing any more.")
    ] = False,
    registration: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Follow this registration; another plan is refused."),
    ] = None,
    trust: Annotated[
        bool, typer.Option("--trust", help="Allow the code beside the protocol file, as it is now.")
    ] = False,
    no_report: Annotated[bool, typer.Option("--no-report", help="Only the record.")] = False,
) -> int:
    """Run a study with living people: participant, demonstrator, experimenter in browsers.

    Prints three links. Ends with the report after the last session, or with Ctrl-C; the same
    command resumes the study.

    Example: lad-study live four-lap-live --participants 6 --out studies/ward-pilot
    """
    check_least("--seed", seed, 0)
    check_least("--seats", seats, 1)
    check_least("--port", port, 0)
    try:
        from harness.live.serve import Address, serve_study
    except ModuleNotFoundError as missing:
        raise InputError(f"lad-study live: {EXTRA} ({missing.name} is missing)") from None
    from harness.cli.trust import trusted_study
    from harness.session.study_run import StudyRun
    from protocols.load import resolve_study

    study = resolve_study(protocol, participants=participants)
    study = trusted_study(study, asked=trust)
    plan = None
    if registration is not None:
        from protocols.registered_study import registered
        from protocols.registration import read_registration

        plan = read_registration(registration)
        study = registered(study, plan)
    folder = out or Path("studies") / f"{study.protocol.name}-live"
    address = Address(port=port, lan=lan, public_origin=public_origin)
    finished = serve_study(
        StudyRun(study, seed), folder, address, say,
        seats=seats, links=links, plan=plan, new_links=new_links,
    )  # fmt: skip
    if finished and not no_report:
        _, page = write_report_of(folder)
        say(f"Report: {page}")
    if not finished:
        complain("No session was finished; the same command resumes the study.")
    say(f"Study:  {folder}")
    return 0
