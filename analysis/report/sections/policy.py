"""What the model has learnt about helping, in terms of the person and the room."""

from typing import Any

from analysis.explain.demonstrators import MEASURES
from analysis.explain.figure import dependence_figure
from analysis.explain.policies import Policies
from analysis.report.blocks import Block, Paragraph, Picture, Section, Shown, table
from analysis.report.numbers import number, plural
from analysis.results import StudyResults


def policy_section(results: StudyResults) -> Section | None:
    """Return what when and how depend on; None in a study without a learnt model of ours."""
    found = results.policies
    if found is None:
        return None
    return Section("policy", "What the model has learnt about helping", tuple(_blocks(found)))


def _blocks(found: Policies) -> list[Block]:
    when = found.dependence.sort_values("when", ascending=False)["input"].tolist()
    how = found.dependence.sort_values("how", ascending=False)["input"].tolist()
    unsure = found.sections.sort_values("undecided", ascending=False).iloc[0]
    n = plural(len(found.participants), "participant's model", "participants' models")
    said = (
        f"Whether to help depends most on {when[0]}, then on {when[1]}; how to help on {how[0]}, "
        f"then on {how[1]}. It is least sure in section {unsure['section']}, where it is "
        f"undecided in {unsure['undecided']:.0%} of the steps. "
        "lad-study explain shows the demonstrated moments that one participant's model leans on."
    )
    blocks: list[Block] = [
        Paragraph(said),
        Picture(
            "policy_dependence",
            "How much p(h) and, where the model would help, its turn rate change when one input "
            "is taken from another moment of the laps, all else as it was; mean and 95% interval "
            f"over {n}. Inputs that go together share their importance. It says what the "
            "learnt policy uses, not what causes a need for help.",
            f"When depends most on {when[0]}, how on {how[0]}.",
            dependence_figure(found.dependence),
        ),
        table("policy_sections", f"How sure the model is, by section; means over {n}. Undecided: "
              "p(h) within a tenth of the threshold.", found.sections, _SECTIONS, folded=True),
    ]  # fmt: skip
    if len(found.demonstrators):
        caption = (
            "How the demonstrators who taught the model differ: differences within participants, "
            "95% interval."
        )
        blocks.append(table("demonstrators", caption, found.demonstrators, _DEMONSTRATORS))
    return blocks


def _between(low: Any, high: Any) -> str:
    return f"{number(low, 2)} to {number(high, 2)}"


_SECTIONS = [
    Shown("section", lambda r: r["section"], words=True),
    Shown("would help", lambda r: f"{r['helping']:.0%}"),
    Shown("undecided", lambda r: f"{r['undecided']:.0%}"),
    Shown("spread of the command", lambda r: number(r["spread"], 2)),
]
_DEMONSTRATORS = [
    Shown("demonstrators", lambda r: r["pair"], words=True),
    Shown("section", lambda r: r["section"], words=True),
    Shown("measure", lambda r: MEASURES[r["measure"]], words=True),
    Shown("first", lambda r: number(r["one"], 2)),
    Shown("second", lambda r: number(r["other"], 2)),
    Shown("difference", lambda r: number(r["difference"], 2)),
    Shown("95%", lambda r: _between(r["low"], r["high"])),
    Shown("n", lambda r: str(r["n"])),
]
