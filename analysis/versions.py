"""Which software computed an analysis."""

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
    """Return the versions of Python and of the packages that the analysis stands on."""
    return package_versions(ANALYSIS_PACKAGES)
