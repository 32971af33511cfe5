"""Everything a runner writes a study with."""

from protocols.record.folder import held, open_folder
from protocols.record.logs import clear_failure, failures, write_failure, write_log, write_timing
from protocols.record.merge import build_tables
from protocols.record.sessions import finished_sessions, write_session

__all__ = [
    "build_tables",
    "clear_failure",
    "failures",
    "finished_sessions",
    "held",
    "open_folder",
    "write_failure",
    "write_log",
    "write_session",
    "write_timing",
]
