"""The formats a study can be exported in, by name: those that ship, and other people's.

Other people's come as entry points of the group ``lad_study.exports``; the entry point's name is
the format's, and it refers to a function like those in ``analysis.export.formats``.
"""

from collections.abc import Callable
from importlib import import_module
from importlib.metadata import entry_points
from pathlib import Path

from analysis.export.content import Content
from protocols.files.errors import InputError
from protocols.files.suggestion import allowed

Tell = Callable[[str], None]
"""Called with what is being done now."""

Write = Callable[[Content, Path, Tell], None]
"""Writes a study into an empty folder."""

GROUP = "lad_study.exports"
"""Entry point group of other people's formats."""

SHIPPED = {
    "frictionless": "analysis.export.formats.frictionless",
    "r": "analysis.export.formats.r",
    "mcap": "analysis.export.formats.mcap",
    "lerobot": "analysis.export.formats.lerobot",
    "bids": "analysis.export.formats.bids",
    "psych-ds": "analysis.export.formats.psych_ds",
    "ro-crate": "analysis.export.formats.ro_crate",
}
"""Module of each format that ships."""


def format_names() -> tuple[str, ...]:
    """Return the names of all formats, those that ship first."""
    others = sorted({point.name for point in entry_points(group=GROUP)} - SHIPPED.keys())
    return (*SHIPPED, *others)


def format_named(name: str) -> Write:
    """Return the function that writes a format.

    Raises
    ------
    InputError
        When there is no such format, or a package it needs is not installed.
    """
    try:
        if name in SHIPPED:
            write: Write = import_module(SHIPPED[name]).write
            return write
        for point in entry_points(group=GROUP, name=name):
            other: Write = point.load()
            return other
    except ImportError as error:
        raise InputError(
            f"--format {name}: needs the package {error.name}, which is not installed; "
            "allowed: pip install 'lad-study[exchange]', or another format"
        ) from None
    raise InputError(f"--format: no format is called {name!r}; {allowed(name, format_names())}")
