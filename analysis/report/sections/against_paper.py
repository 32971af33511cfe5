"""The study's numbers beside the paper's."""

from analysis.report.blocks import Block, Caution, Paragraph, Section, Shown, table
from analysis.report.numbers import NOTHING, interval, number
from analysis.report.sections.survey import ASSUMED
from analysis.results import StudyResults


def paper_section(results: StudyResults) -> Section:
    """Return the paper's number beside each of ours."""
    blocks: list[Block] = [
        Paragraph(
            "Soh & Demiris (2013), When and How to Help: An Iterative Probabilistic Model for "
            "Learning Assistance by Demonstration. Where a printed number does not add up, the "
            "remark says so."
        )
    ]
    if results.frames.synthetic:
        blocks.append(Caution(ASSUMED))
    if results.paper.empty:
        blocks.append(Paragraph("This study has no number that the paper prints."))
    else:
        blocks.append(
            table("against_the_paper", "Ours beside the paper's.", results.paper, _COLUMNS)
        )
    return Section("paper", "Against the paper", tuple(blocks))


_COLUMNS = [
    Shown("what", lambda r: r["what"], words=True),
    Shown("unit", lambda r: r["unit"] or "1", words=True),
    Shown("paper", lambda r: f"{r['paper']:g}"),
    Shown("ours", lambda r: number(r["ours"], 3 if r["unit"] == "" else 1)),
    Shown("95%", lambda r: interval(r["ours_low"], r["ours_high"])),
    Shown("section", lambda r: r["section"], words=True),
    Shown("remark", lambda r: r["remark"] or NOTHING, words=True),
]
