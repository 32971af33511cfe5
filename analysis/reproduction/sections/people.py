"""The four-lap study."""

from analysis.figures.lap_times import lap_time_figure
from analysis.paper import PAPER
from analysis.report.blocks import Paragraph, Picture, Section
from analysis.report.numbers import number
from analysis.reproduction.evidence import Evidence
from analysis.reproduction.people_rows import PARTS


def people_section(evidence: Evidence) -> Section:
    """Return Figure 6 with the paper's means."""
    frames = evidence.people
    paper = {name: PAPER[f"people/{part}/mean"].value for name, part in PARTS.items()}
    means = frames.laps.groupby("condition", sort=False)["lap_time_s"].mean()
    listed = ", ".join(f"{name} {number(float(means[name]))} s" for name in PARTS)
    return Section(
        "people",
        "People: lap times (Figure 6)",
        (
            Paragraph(
                "Synthetic participants. Their population is fitted to the paper's baseline and "
                "limited laps; the laps with help are predicted. In the fixed order of the laps "
                "practice and condition cannot be separated. One study of twelve varies a "
                "lot, so nothing here has a tolerance."
            ),
            Picture(
                "people_lap_times",
                "Lap times by condition, every participant a line "
                f"(n = {len(frames.participants)}), with mean and sd, and the paper's mean.",
                f"Mean lap times: {listed}.",
                lap_time_figure(frames.laps, frames.parts, paper),
            ),
        ),
    )
