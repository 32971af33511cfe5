"""Everything that is looked at, and what can be done here because of it."""

from collections.abc import Iterator, Sequence
from pathlib import Path

from harness.doctor.browser import browser_findings
from harness.doctor.finding import PURPOSES, Finding, Purpose
from harness.doctor.machine import machine_findings
from harness.doctor.packages import package_findings
from harness.doctor.world import world_finding
from protocols.versions import package_versions


def examine(cores: int, folder: Path) -> Iterator[Finding]:
    """Yield everything that is looked at, the quick things first.

    Parameters
    ----------
    cores
        Cores that this process may use.
    folder
        Where a study would be written.
    """
    for name, found in package_versions(("lad-study",)).items():
        yield Finding(name, found)
    yield from machine_findings(cores, folder)
    yield from package_findings()
    yield world_finding()
    yield from browser_findings()


def what_is_missing(findings: Sequence[Finding]) -> dict[Purpose, tuple[Finding, ...]]:
    """Return for every purpose the findings that stop it.

    Examples
    --------
    >>> missing = what_is_missing([Finding("disk", "full", ("run",), "free some")])
    >>> [purpose for purpose, found in missing.items() if found]
    ['run']
    """
    return {
        purpose: tuple(finding for finding in findings if purpose in finding.stops)
        for purpose in PURPOSES
    }
