"""Packages: which are installed, and whether they are what the package metadata asks for."""

from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, requires, version

from packaging.requirements import Requirement

from harness.doctor.finding import Finding, Purpose

EXTRAS: dict[Purpose, str] = {
    "live": "live",
    "cluster": "cluster",
    "export": "exchange",
    "video": "video",
}
"""What a purpose needs beyond what always comes along: an extra of pyproject.toml."""


def package_findings() -> Iterator[Finding]:
    """Yield a finding for each package that this one declares, in the order of the purposes."""
    yield from _needed("run", "", "pip install --upgrade lad-study")
    for purpose, extra in EXTRAS.items():
        yield from _needed(purpose, extra, f"pip install 'lad-study[{extra}]'")


def _needed(purpose: Purpose, extra: str, mend: str) -> Iterator[Finding]:
    asked = declared(extra)
    if not asked:
        found = "not known to the installed package: it is older than this code"
        yield Finding(f"extra {extra}" if extra else "metadata", found, (purpose,), mend)
    for requirement in asked:
        found, fits = installed(requirement)
        if fits:
            yield Finding(requirement.name, found)
        else:
            yield Finding(requirement.name, found, (purpose,), mend)


def declared(extra: str) -> tuple[Requirement, ...]:
    """Return what the installed package asks for here: always (``""``), or for one extra.

    Examples
    --------
    >>> [requirement.name for requirement in declared("cluster")]
    ['distributed']
    """
    every = [Requirement(text) for text in requires("lad-study") or ()]
    return tuple(
        one
        for one in every
        if (one.marker is None and not extra)
        or (one.marker is not None and one.marker.evaluate({"extra": extra}))
    )


def installed(requirement: Requirement) -> tuple[str, bool]:
    """Return the installed version in words, and whether it is one that is asked for.

    Examples
    --------
    >>> installed(Requirement("no-such-package-here>=2"))
    ('missing; needs no-such-package-here>=2', False)
    """
    try:
        there = version(requirement.name)
    except PackageNotFoundError:
        return f"missing; needs {requirement.name}{requirement.specifier}", False
    if requirement.specifier.contains(there, prereleases=True):
        return there, True
    return f"{there}; needs {requirement.name}{requirement.specifier}", False
