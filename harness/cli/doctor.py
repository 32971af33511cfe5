"""`lad-study doctor`: what this machine has, and what is missing for what."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from harness.cli.console import progress_line, say
from harness.cli.options import cores

if TYPE_CHECKING:
    from harness.doctor.finding import Finding, Purpose


def doctor(
    as_json: Annotated[
        bool, typer.Option("--json", help="One JSON object, for another program.")
    ] = False,
) -> int:
    """Say what this machine has, and what is missing for `run`, `live`, a cluster, export, video.

    Looks at versions, compilers, cores, browser and its WebGL, gamepad, ports, disk, write rights
    and clock; changes nothing. Exit code 1 when `lad-study run` cannot work.

    Example: lad-study doctor
    """
    from harness.doctor.examination import examine, what_is_missing

    with progress_line() as tell:
        findings = []
        for finding in examine(cores(), Path.cwd()):
            findings.append(finding)
            tell(f"Looked at {finding.what}")
    missing = what_is_missing(findings)
    if as_json:
        can = {purpose: not stops for purpose, stops in missing.items()}
        say(json.dumps({"can": can, "findings": [asdict(one) for one in findings]}, indent=1))
    else:
        _print(findings, missing)
    return 1 if missing["run"] else 0


def _print(findings: "Sequence[Finding]", missing: "Mapping[Purpose, Sequence[Finding]]") -> None:
    width = max(len(finding.what) for finding in findings) + 2
    for finding in findings:
        say(f"{finding.what:<{width}}{finding.found}")
        if finding.mend and not finding.stops:
            say(f"{'':<{width}}{finding.mend}")
    say("")
    for purpose, stops in missing.items():
        if not stops:
            say(f"{purpose:<{width}}works")
            continue
        lines = list(dict.fromkeys(finding.mend for finding in stops))
        names = ", ".join(finding.what for finding in stops)
        say(f"{purpose:<{width}}cannot work: {names}")
        for line in lines:
            say(f"{'':<{width}}{line}")
