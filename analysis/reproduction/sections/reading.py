"""How the page is to be read, and what in the paper does not add up."""

from analysis.paper import PAPER, PaperFigure
from analysis.report.blocks import Paragraph, Remarks, Section

KINDS = (
    "Calibrated: course, driver, demonstrator or population were fitted to the paper's figure. "
    "Predicted: nothing was fitted to it. Descriptive: reported only."
)
VERDICTS = (
    "Tolerances were declared before anything was run; a quantity without one has no verdict. "
    "Paper ± t: ours is within t of the paper's figure. At least v: ours is v or more. 0 ± t: "
    "ours is within t of zero. Interval within ± t: the whole interval is within t of zero "
    "(equivalence). The verdict is computed from the numbers of its row in reproduction.json, at "
    "full precision."
)
INTERVALS = (
    "Intervals: 95% for means, differences and speedups (t; Fieller), 90% for the equivalence "
    "test, quartiles for medians over random orders."
)
COUNTS = "n: laps, participants or random orders that the number is computed from."


def reading_section() -> Section:
    """Return what kinds, tolerances, intervals and verdicts mean."""
    doubtful = [figure for key, figure in PAPER.items() if figure.remark and "/Q" not in key]
    return Section(
        "reading",
        "How to read this",
        (
            Remarks((KINDS, VERDICTS, INTERVALS, COUNTS)),
            Paragraph("Numbers of the paper that do not add up:"),
            Remarks(tuple(map(_remark, doubtful))),
        ),
    )


def _remark(figure: PaperFigure) -> str:
    value = f"{figure.value:g} {figure.unit}".rstrip()
    return f"{figure.section}, {figure.meaning}, {value}: {figure.remark}."
