"""Which software computed an analysis, and which recorded its study."""

from dataclasses import dataclass

from protocols.record.reader import Study
from protocols.versions import package_versions

ANALYSIS_PACKAGES = (
    "lad-study",
    "matplotlib",
    "numpy",
    "pandas",
    "pyarrow",
    "scipy",
    "statsmodels",
)


def analysis_versions() -> dict[str, str]:
    """Return the versions of Python and of the packages that the analysis uses."""
    return package_versions(ANALYSIS_PACKAGES)


@dataclass(frozen=True, slots=True)
class Recording:
    """Package versions, and the number of sessions recorded with them; None: not known."""

    versions: dict[str, str]
    sessions: int | None


def recording_versions(study: Study) -> tuple[Recording, ...]:
    """Return the sets of versions that recorded a study, one for most studies.

    Tables of other programs have no sessions with versions; the study's head may have them.
    """
    recorded = tuple(Recording(*used) for used in study.sessions_by_versions)
    return recorded or (Recording(study.header.versions, None),)
