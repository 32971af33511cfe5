"""Which software made a record."""

import platform
from importlib.metadata import PackageNotFoundError, version

RECORDING_PACKAGES = (
    "lad-study",
    "numba",
    "numpy",
    "pyarrow",
    "pybullet",
    "pydantic",
    "scipy",
    "shapely",
)
"""Packages that can change a record with their version."""


def package_versions(names: tuple[str, ...] = RECORDING_PACKAGES) -> dict[str, str]:
    """Return the versions of Python and of the installed ones among some packages.

    Parameters
    ----------
    names
        Distribution names.
    """
    found = {"python": platform.python_version()}
    for name in names:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue
    return found
