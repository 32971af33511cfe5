"""Everything a runner writes a study with."""

from protocols.record.folder import locked, open_folder, refuse_another_study
from protocols.record.logs import (
    clear_failure,
    failure_reason,
    failures,
    raised,
    write_death,
    write_failure,
    write_given_up,
    write_log,
    write_timing,
    write_warnings,
)
from protocols.record.merge import build_tables
from protocols.record.sessions import (
    finished_sessions,
    model_before,
    whole_sessions,
    write_session,
)

__all__ = [
    "build_tables",
    "clear_failure",
    "failure_reason",
    "failures",
    "finished_sessions",
    "locked",
    "model_before",
    "open_folder",
    "raised",
    "refuse_another_study",
    "whole_sessions",
    "write_death",
    "write_failure",
    "write_given_up",
    "write_log",
    "write_session",
    "write_timing",
    "write_warnings",
]
