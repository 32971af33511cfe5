"""Which software made a record."""

import platform

from protocols.versions import package_versions


def test_python_and_installed_packages_are_named():
    """Python always, packages where installed, and nothing that is not there."""
    versions = package_versions(("numpy", "no-such-package-anywhere"))
    assert set(versions) == {"python", "numpy"}
    assert versions["python"] == platform.python_version()
