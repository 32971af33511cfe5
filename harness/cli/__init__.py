"""The command line, `lad-study`: one file per command."""

from harness.cli.app import main

__all__ = ["main"]
