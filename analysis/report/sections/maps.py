"""Where assistance was given: the plan, and shares by section."""

from collections.abc import Sequence

from analysis.figures.assistance_map import assistance_map
from analysis.figures.section_shares import section_figure
from analysis.frames import on_own_course
from analysis.maps import BANDWIDTH
from analysis.report.blocks import Block, Paragraph, Picture, Section, Shown, table
from analysis.report.numbers import count, is_p, number, percent, plural
from analysis.results import StudyResults
from analysis.stats.result import TestResult


def map_section(results: StudyResults) -> Section:
    """Return a map of where assistance was given, and the shares behind it."""
    frames, sections = results.frames, results.sections
    helped = [p.condition for p in frames.parts if p.role in ("demonstrator", "model")]
    if not helped:
        nothing = Paragraph("No condition of this study has an assistant.")
        return Section("assistance", "Where assistance was given", (nothing,))
    blocks: list[Block] = [
        *_map(results, helped),
        Picture(
            "section_shares",
            "Share of assisted steps in each section of the course, in driving order. Black "
            "lines: steps in which the (shadow) demonstrator would have helped.",
            f"Assisted share by section. {_most(results)}",
            section_figure(sections, frames.parts),
        ),
        table("section_shares", "Assisted steps by course section, pooled over the steps of all "
              "laps, unfinished ones too.", sections, _COLUMNS),
    ]  # fmt: skip
    if elsewhere := frames.study.header.group_courses:
        others = ", ".join(f"{name} ({course.name})" for name, course in elsewhere.items())
        blocks.append(Paragraph(f"Without the groups that drove another course: {others}."))
    return Section("assistance", "Where assistance was given", tuple(blocks))


def _map(results: StudyResults, helped: Sequence[str]) -> tuple[Block, ...]:
    """Return the map and how far its sources overlap; the reason where no position is known."""
    steps = on_own_course(results.frames, results.records.steps)
    placed = steps[["x_m", "y_m"]].notna().all(axis=1)
    if not placed.any():
        why = "no position was recorded in any step"
        if results.records.misplaced:
            why = "the recorded positions do not fit the course (see Participants)"
        return (Paragraph(f"No map: {why}."),)
    gates = ", ".join(gate.name for gate in results.frames.study.course.gates)
    figure_7 = "; the paper's Figure 7" if results.frames.study.protocol.replicates else ""
    known = steps.loc[placed & steps["helped"].notna(), ["condition", "participant"]]
    people = known.groupby("condition", observed=True)["participant"].nunique()
    n = ", ".join(f"{c}: {plural(int(people.get(c, 0)), 'participant')}" for c in helped)
    return (
        Picture(
            "assistance_map",
            "Driven paths (grey) and smoothed density of the steps in which assistance counted, "
            f"on one colour scale; each density integrates to 1 ({n}{figure_7}). "
            "Steps of unfinished laps count too. Gaussian kernel, standard deviation "
            f"{BANDWIDTH:g} m. S start; gates {gates}.",
            f"Floor plans with driven paths and where assistance was given. {_most(results)}",
            assistance_map(steps, results.frames.study.course, helped),
        ),
        Paragraph(_overlap(results.overlap)),
    )


def _overlap(found: TestResult | None) -> str:
    if found is None:
        return "There is no second source of assistance to compare the map with."
    if not found.computed:
        why = "; ".join([str(found.why_not), *found.notes])
        return f"How far the two maps overlap cannot be computed: {why}."
    return (
        f"Overlap of the demonstrator's and the model's map: {number(found.estimate, 2)} "
        f"(0 disjoint, 1 the same; n = {found.n} participants"
        f"{''.join(f'; {note}' for note in found.notes)}). Exchanging the two sources within "
        f"participants gives as little overlap or less with {is_p(found.p)}: a small p means that "
        "the two helped in different places or with different spread."
    )


def _most(results: StudyResults) -> str:
    """Return for every helped condition where its assistance was, in words."""
    said = []
    for condition, rows in results.sections.groupby("condition", sort=False):
        by_kind = rows.groupby("kind")["share_of_assistance_percent"].sum(min_count=1).dropna()
        if len(by_kind):
            shares = ", ".join(
                f"{percent(share)} in {str(kind).replace('_', ' ')} sections"
                for kind, share in by_kind.sort_values(ascending=False).items()
            )
            said.append(f"{condition}: {shares}.")
    return " ".join(said) or "No assistance was recorded."


_COLUMNS = [
    Shown("section", lambda r: r["section"], words=True),
    Shown("kind", lambda r: r["kind"].replace("_", " "), words=True),
    Shown("condition", lambda r: r["condition"], words=True),
    Shown("steps", lambda r: count(r["steps"])),
    Shown("assisted", lambda r: percent(r["assisted_percent"], 1)),
    Shown("of all assistance", lambda r: percent(r["share_of_assistance_percent"], 1)),
    Shown("demonstrator would help", lambda r: percent(r["would_percent"], 1)),
]
