"""The report with which several commands end, by as many processes as there are cores."""

import os
from pathlib import Path
from typing import TYPE_CHECKING

from harness.cli.console import progress_line
from harness.cli.options import cores

if TYPE_CHECKING:
    from analysis.results import StudyResults

MANY_LAPS = 600
"""From here on processes pay for themselves although each has to import the analysis first."""


def warm_up_report() -> bool:
    """Begin, in the background, to load what the report's processes need.

    Returns
    -------
    bool
        Whether they will be at hand at once: not on one core, nor where no temporary folder can
        have a socket.
    """
    from harness.running.processes import ONE_THREAD, temporary_folder, warm_up

    if cores() == 1 or temporary_folder() is None:
        return False
    os.environ.update(ONE_THREAD)  # before numpy is loaded here, too
    warm_up(["analysis.report.write"])
    return True


def write_report_of(
    folder: Path, beside: Path | None = None, *, warm: bool = False
) -> tuple["StudyResults", Path]:
    """Analyse a study and write its report; return what was found, and the page.

    Parameters
    ----------
    folder, beside
        The study, and another one whose people are shown beside this one's.
    warm
        Whether processes are at hand; see ``warm_up_report``.

    Raises
    ------
    InputError
        As ``analysis.report.write_report``.
    """
    from analysis.processes import processes
    from analysis.report.write import write_results
    from analysis.results import analyse
    from protocols.record.reader import open_study

    study = open_study(folder)
    other = None if beside is None else open_study(beside)
    jobs = cores() if warm or len(study.laps) >= MANY_LAPS else 1
    with progress_line() as tell, processes(jobs) as others:
        results = analyse(study, tell, others, other)
        return results, write_results(results, tell, others)
