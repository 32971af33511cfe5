"""The paper's figures, as data: Soh & Demiris (2013), When and How to Help, sections IV and V."""

from dataclasses import dataclass

from analysis.roles import Part, condition_roles
from protocols.study import StudyProtocol


@dataclass(frozen=True, slots=True)
class PaperFigure:
    """One number the paper prints.

    Attributes
    ----------
    value, unit
        As printed.
    section
        The section of the paper.
    meaning
        What it is.
    remark
        What does not add up about it; "" when nothing is wrong.
    """

    value: float
    unit: str
    section: str
    meaning: str
    remark: str = ""


def _lap(value: float, section: str, meaning: str, remark: str = "") -> PaperFigure:
    return PaperFigure(value, "s", section, meaning, remark)


PAPER: dict[str, PaperFigure] = {
    "robot/baseline/mean": _lap(34.59, "IV.A", "autonomous driver, full control"),
    "robot/baseline/sd": _lap(0.356, "IV.A", "autonomous driver, full control, sd"),
    "robot/limited/mean": _lap(59.11, "IV.A", "autonomous driver, limited"),
    "robot/limited/sd": _lap(0.95, "IV.A", "autonomous driver, limited, sd"),
    "robot/demonstrator/mean": _lap(40.5, "IV.E", "autonomous driver, demonstrator helps"),
    "robot/demonstrator/speedup": PaperFigure(146, "%", "IV, Fig. 3", "limited / demonstrator"),
    "robot/model-1/mean": _lap(
        42.6, "IV.E", "autonomous driver, model after one demonstration",
        "the text says 2.6 s behind the demonstrator; its own means say 2.1 s"),
    "robot/model-1/speedup": PaperFigure(139, "%", "IV.E", "limited / model, one demonstration"),
    "robot/model-3/mean": _lap(40.4, "IV.E", "autonomous driver, model after three demonstrations"),
    "robot/model-3/ks": PaperFigure(
        0.3125, "", "IV.E", "Kolmogorov-Smirnov, model after three demonstrations against "
        "demonstrator (p = .4370)",
        "cannot come from 10 against 10 laps; of sizes 5 to 40 only 12 against 16 gives this p"),
    "people/baseline/mean": _lap(48.5, "V.B", "participants, full control"),
    "people/baseline/sd": _lap(20.0, "V.B", "participants, full control, sd"),
    "people/limited/mean": _lap(76.7, "V.B", "participants, limited"),
    "people/limited/sd": _lap(24.8, "V.B", "participants, limited, sd"),
    "people/limited/increase": PaperFigure(
        62, "%", "V.B", "limited against full control",
        "the means 76.7 / 48.5 say 58%; a mean of ratios may explain it"),
    "people/demonstrator/mean": _lap(44.55, "V.B", "participants, demonstrator helps"),
    "people/demonstrator/sd": _lap(8.0, "V.B", "participants, demonstrator helps, sd"),
    "people/model-1/mean": _lap(56.1, "V.B", "participants, model helps"),
    "people/model-1/gain": _lap(20.6, "V.B", "limited minus model"),
    "people/model-1/speedup": PaperFigure(
        137, "%", "V.B", "limited / model", "the ratio of the means, 76.7 / 56.1"),
    "people/model-1/auc": PaperFigure(
        0.95, "", "abstract, IV.D", "when-AUC after one demonstration",
        "the paper's is the autonomous driver's: it gives none for people"),
    "people/demonstrator/Q5": PaperFigure(
        80, "%", "V.C", "agree that the assistance was helpful",
        "80% of 11 answers is impossible; 8 of 10 is not: one answer may be missing"),
    "people/model-1/Q5": PaperFigure(73, "%", "V.C", "agree that the assistance was helpful"),
    "people/demonstrator/Q7": PaperFigure(
        100, "%", "V.C", "agree that the assistance made them faster"),
    "people/model-1/Q7": PaperFigure(
        73, "%", "V.C", "agree that the assistance made them faster"),
    "people/demonstrator/Q8": PaperFigure(
        63, "%", "V.C", "agree that the assistance was timely",
        "63% of 11 only by truncation: 7 of 11 is 63.6%"),
    "people/model-1/Q8": PaperFigure(73, "%", "V.C", "agree that the assistance was timely"),
    "people/demonstrator/Q11": PaperFigure(
        63, "%", "V.C", "liked having the assistance",
        "63% of 11 only by truncation: 7 of 11 is 63.6%"),
    "people/model-1/Q11": PaperFigure(
        63, "%", "V.C", "liked having the assistance",
        "63% of 11 only by truncation: 7 of 11 is 63.6%"),
}  # fmt: skip
"""By key: driver / role of the condition (a model with its demonstrations) / quantity."""


def paper_figure(protocol: StudyProtocol, part: Part, quantity: str) -> PaperFigure | None:
    """Return what the paper prints for a condition's quantity; None when it prints nothing.

    Only a study that says it replicates the paper is set against it: those with autonomous drivers
    against section IV, others against section V. Of conditions that play the same part, the first
    one is the paper's.

    Parameters
    ----------
    protocol
        The study.
    part
        One of its conditions.
    quantity
        ``mean``, ``sd``, ``speedup``, ``gain``, ``increase``, ``auc``, ``ks`` or an item's id.

    Examples
    --------
    >>> from analysis.roles import condition_roles
    >>> from protocols.load import load_protocol
    >>> study = load_protocol("four-lap")
    >>> paper_figure(study, condition_roles(study)[3], "mean").value
    56.1
    """
    if protocol.replicates is None or not _first_of_its_part(protocol, part):
        return None
    whose = "robot" if protocol.cohort.driver.use == "autonomous" else "people"
    return PAPER.get(f"{whose}/{_key(part)}/{quantity}")


def _first_of_its_part(protocol: StudyProtocol, part: Part) -> bool:
    alike = (other for other in condition_roles(protocol) if _key(other) == _key(part))
    return next(alike, part).condition == part.condition


def _key(part: Part) -> str:
    return f"model-{part.demonstrations}" if part.role == "model" else part.role
