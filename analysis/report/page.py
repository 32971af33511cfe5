"""The order of the page."""

from collections.abc import Callable

from analysis.flow import Flow
from analysis.report.blocks import Page, Section
from analysis.report.sections.against_paper import paper_section
from analysis.report.sections.answer import answer_section
from analysis.report.sections.comparisons import comparison_section
from analysis.report.sections.data import data_section
from analysis.report.sections.groups import group_section
from analysis.report.sections.lap_times import lap_time_section
from analysis.report.sections.live_quality import live_section
from analysis.report.sections.maps import map_section
from analysis.report.sections.measures import measure_section
from analysis.report.sections.methods import methods_section
from analysis.report.sections.model import model_section
from analysis.report.sections.people import people_section
from analysis.report.sections.policy import policy_section
from analysis.report.sections.practice import practice_section
from analysis.report.sections.registration import registration_section
from analysis.report.sections.side_by_side import side_section
from analysis.report.sections.survey import survey_section
from analysis.results import StudyResults

SECTIONS: tuple[Callable[[StudyResults], Section | None], ...] = (
    answer_section,
    registration_section,
    people_section,
    live_section,
    lap_time_section,
    side_section,
    comparison_section,
    practice_section,
    group_section,
    map_section,
    measure_section,
    survey_section,
    model_section,
    policy_section,
    paper_section,
    methods_section,
    data_section,
)


def build_page(results: StudyResults) -> Page:
    """Return the report of a study."""
    study = results.frames.study
    protocol = study.protocol
    seed = "" if study.seed is None else f", seed {study.seed}"
    return Page(
        title=protocol.title,
        subtitle=f"Protocol {protocol.name}, course {study.course_names}{seed}; "
        f"{results.flow.analysed} of {_all(results.flow)} participants analysed",
        sections=tuple(
            found
            for section in SECTIONS
            if _belongs(section, results)
            if (found := section(results)) is not None
        ),
    )


def _all(flow: Flow) -> str:
    return f"{flow.recorded} recorded" if flow.planned is None else str(flow.planned)


def _belongs(section: Callable[[StudyResults], Section | None], results: StudyResults) -> bool:
    """Tell whether a section has a place in this study's report: the paper's figures may not."""
    return section is not paper_section or results.frames.study.protocol.replicates is not None
