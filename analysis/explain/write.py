"""Write what one participant's model has learnt, in words, a figure and tables."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pandas as pd

from analysis.explain.demonstrators import demonstrated, demonstrators_of
from analysis.explain.dependence import dependence
from analysis.explain.figure import dependence_figure
from analysis.explain.moments import leaned_on, unsure_sections
from analysis.explain.policies import asked_laps
from analysis.explain.recorded import learnt_model, looked_at
from analysis.figures.files import png, settle
from protocols.files.errors import InputError
from protocols.record.atomic import write_whole
from protocols.record.reader import Study, open_study


@dataclass(frozen=True)
class Explained:
    """What was found for one participant; the tables are those of the functions of their names."""

    participant: str
    dependence: pd.DataFrame
    sections: pd.DataFrame
    moments: pd.DataFrame
    shown: pd.DataFrame = field(default_factory=pd.DataFrame)


def explained(study: Study, participant: str) -> Explained:
    """Ask a participant's model, about every lap that it helped or could have helped.

    Raises
    ------
    InputError
        When there is no such participant, no learnt model, or no lap after its first teaching.
    """
    model = learnt_model(study, participant)
    asked = asked_laps(study, participant)
    if not asked:
        raise InputError(f"{study.folder}: {participant} drove no lap after its model was taught")
    looked = looked_at(study, participant, asked, model.parameters.recursion_depth)
    rng = np.random.default_rng(np.random.SeedSequence([0, len(looked.windows)]))
    who = demonstrators_of(study.protocol)
    shown = demonstrated(study, (participant,)) if len(who) > 1 else pd.DataFrame()
    return Explained(
        participant,
        dependence(model, looked, rng),
        unsure_sections(model, looked),
        leaned_on(model, looked, study, participant),
        shown,
    )


def write_explanation(folder: Path, participant: str, out: Path) -> Path:
    """Write ``explanation-ID.md`` and ``.png`` into a folder; return the page.

    Raises
    ------
    InputError
        As ``explained``.
    """
    found = explained(open_study(folder), participant)
    figure = dependence_figure(found.dependence)
    settle(figure)
    out.mkdir(parents=True, exist_ok=True)
    name = f"explanation-{participant}"
    write_whole(out / f"{name}.png", png(figure))
    write_whole(out / f"{name}.md", page(found, f"{name}.png").encode())
    return out / f"{name}.md"


def page(found: Explained, picture: str) -> str:
    """Return the explanation as Markdown, for a reader who knows helping and not models."""
    when = found.dependence.sort_values("when", ascending=False)["input"]
    how = found.dependence.sort_values("how", ascending=False)["input"]
    least_sure = found.sections.sort_values("undecided", ascending=False).iloc[0]
    return "\n\n".join(
        [
            f"# What the model of {found.participant} has learnt about helping",
            (f"Whether to help depends most on {when.iloc[0]}, then on {when.iloc[1]}. How to help "
            f"depends most on {how.iloc[0]}, then on {how.iloc[1]}. It is least sure in section "
            f"{least_sure['section']}, where it is undecided in {least_sure['undecided']:.0%} of "
            "the steps."),
            f"![Change of when and how with each input]({picture})",
            ("Each bar: how much the answer changes when that input is taken from another moment "
            "of the laps, everything else as it was; 95% interval over ten such exchanges. Inputs "
            "that go together share their importance."),
            "## Inputs",
            _table(
                ("input", "change of p(h)", "95%", "change of turn rate, rad/s", "95%",
                 "spread in lengthscales"),
                [
                    (r["input"], f"{r['when']:.3f}", f"{r['when_low']:.3f} to {r['when_high']:.3f}",
                     f"{r['how']:.3f}", f"{r['how_low']:.3f} to {r['how_high']:.3f}",
                     "–" if np.isnan(r["lengthscales"]) else f"{r['lengthscales']:.2f}")
                    for r in found.dependence.to_dict("records")
                ],
            ),
            "## Where it is sure",
            _table(
                ("section", "steps", "would help", "undecided", "spread of the command"),
                [
                    (r["section"], str(r["steps"]), f"{r['helping']:.0%}", f"{r['undecided']:.0%}",
                     f"{r['spread']:.2f}")
                    for r in found.sections.to_dict("records")
                ],
            ),
            "## Moments that its takeovers lean on",
            _table(
                ("takeover in lap", "at, s", "section", "leans on lap", "at, s", "section",
                 "likeness", "turns by, rad/s"),
                [
                    (str(r["lap"]), f"{r['t_s']:.1f}", r["section"], str(r["shown_lap"]),
                     f"{r['shown_t_s']:.1f}", r["shown_section"], f"{r['likeness']:.2f}",
                     f"{r['turn']:+.3f}")
                    for r in found.moments.to_dict("records")
                ],
            ),
            *_who_differs(found.shown),
        ]
    ) + "\n"  # fmt: skip


def _who_differs(shown: pd.DataFrame) -> list[str]:
    """Return how those who taught differ; nothing where one person did."""
    if shown.empty:
        return []
    columns = ["share", "begins_m", "speed", "turn"]
    means = shown.groupby(["section", "demonstrator"], sort=False)[columns].mean().reset_index()
    head = ("section", "demonstrator", "share of steps", "begins at, m", "speed, m/s",
            "turn rate, rad/s")  # fmt: skip
    rows = [
        (r["section"], r["demonstrator"], f"{r['share']:.0%}",
         "–" if np.isnan(r["begins_m"]) else f"{r['begins_m']:.2f}",
         f"{r['speed']:.2f}", f"{r['turn']:.2f}")
        for r in means.to_dict("records")
    ]  # fmt: skip
    return ["## How those who taught it differ", _table(head, rows)]


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)
