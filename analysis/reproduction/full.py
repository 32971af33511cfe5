"""What `lad-study reproduce --full` adds to the page: robustness, baselines, other courses."""

from pathlib import Path

from analysis.report.blocks import Section
from analysis.reproduction.generalisation import evidence as elsewhere
from analysis.reproduction.generalisation.course_rows import generalisation_rows
from analysis.reproduction.generalisation.section import generalisation_section
from analysis.reproduction.generalisation.tables import course_table, section_table
from analysis.reproduction.robustness import evidence as robustness
from analysis.reproduction.robustness.cost import costs
from analysis.reproduction.robustness.evidence import Say
from analysis.reproduction.robustness.section import robustness_section
from analysis.reproduction.robustness.table import variant_table
from analysis.reproduction.robustness.variant_rows import robustness_rows
from analysis.reproduction.row import Row


def full_sections(
    folder: Path, jobs: int = 1, say: Say | None = None
) -> tuple[tuple[Section, ...], tuple[Row, ...]]:
    """Return the further sections and rows of a whole reproduction.

    Parameters
    ----------
    folder
        The reproduction's, its studies run.
    jobs
        Processes that teach models, 1 or more.
    say
        Called with a few words about what is being done.

    Raises
    ------
    InputError
        When a study is missing or cannot be used.
    OSError
        When the cost of a step, measured, cannot be kept.
    """
    tell = say or (lambda _: None)
    variants = variant_table(robustness.gather(folder, jobs, tell))
    tell("Measuring the cost of a step")
    measured = costs(folder)
    tell("Reading laps on other courses")
    courses = elsewhere.gather(folder)
    laps, shares = course_table(courses), section_table(courses)
    sections = (
        robustness_section(variants, measured),
        generalisation_section(laps, shares, courses[0].course),
    )
    return sections, (*robustness_rows(variants), *generalisation_rows(laps, shares))
