"""An instrument as data: a questionnaire's items and the scale they are answered on."""

from collections.abc import Iterator
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from protocols.files.fault import Fault, InconsistentError
from protocols.files.file_model import FileModel, FormatVersion, Name

ItemId = Annotated[str, Field(pattern=r"^[A-Za-z0-9_-]+$", max_length=40)]

AnswerKind = Literal["point", "number", "text"]


class Item(FileModel):
    """One statement or question.

    Attributes
    ----------
    id
        Short id, unique in the instrument; the record names the item by it.
    text
        The wording, as the person reads it.
    subscale
        Name of the composite the item belongs to; items of one subscale are averaged.
    reverse
        Whether agreement means less of what the subscale measures.
    asked
        Whether the item makes sense after any lap, or only where help was possible.
    answer
        How it is answered: by a point of the instrument's scale, a number, or free text.
    lowest, highest
        Of a number, both included; null for no bound.
    step
        Of a number: answers are whole steps from ``lowest``; null for any number between.
    ends
        What stands at the two ends of a number's scale, such as [very low, very high].
    expected
        Makes the item an attention check: the point or number that whoever reads it gives, such as
        2 for "Choose disagree here."; it is no part of any score. Null for a question.
    """

    id: ItemId
    text: Annotated[str, Field(min_length=1, max_length=5000)]
    subscale: Name = "total"
    reverse: bool = False
    asked: Literal["every lap", "assisted laps"] = "every lap"
    answer: AnswerKind = "point"
    lowest: float | None = None
    highest: float | None = None
    step: Annotated[float, Field(gt=0)] | None = None
    ends: tuple[str, str] | None = None
    expected: float | None = None

    @model_validator(mode="after")
    def _bounds_are_of_a_number(self) -> Self:
        bounds = [bound for bound in (self.lowest, self.highest) if bound is not None]
        if bounds and self.answer != "number":
            raise ValueError("lowest and highest are for an answer that is a number")
        if len(bounds) == 2 and not bounds[0] < bounds[1]:
            raise ValueError(f"lowest {bounds[0]:g} is not below highest {bounds[1]:g}")
        if (self.step or self.ends) and len(bounds) < 2:
            raise ValueError("step and ends are for a number with lowest and highest")
        if self.step and len(bounds) == 2 and not self.on_a_step(bounds[1]):
            raise ValueError(f"highest {bounds[1]:g} is no whole number of steps from lowest")
        if self.reverse and self.answer == "number" and len(bounds) < 2:
            raise ValueError("a number is turned within lowest and highest; give both")
        if self.expected is not None and self.answer == "text":
            raise ValueError("expected is for an answer that is a point or a number")
        return self

    @property
    def scored(self) -> bool:
        """Whether the answer is part of a score: neither text nor an attention check."""
        return self.answer != "text" and self.expected is None

    def on_a_step(self, number: float) -> bool:
        """Tell whether a number is a whole number of steps from the lowest one.

        Examples
        --------
        >>> item = Item(id="x", text="Hard?", answer="number", lowest=0, highest=100, step=5)
        >>> item.on_a_step(35), item.on_a_step(33)
        (True, False)
        """
        if self.step is None or self.lowest is None:
            return True
        steps = (number - self.lowest) / self.step
        return abs(steps - round(steps)) < 1e-9


class Instrument(FileModel):
    """A questionnaire: items answered on one ordinal scale, by numbers, or in words.

    Attributes
    ----------
    schema_version
        Version of the file format; ``schema`` in a file.
    name, title
        What the instrument is called: the name stands in the record, the title in the report.
    anchors
        Labels of the scale's points, from 1 upwards; their number is the number of points. None
        where no item is answered by a point.
    agreement_from
        Lowest point that counts as agreement.
    score
        The lowest and the highest composite score: a mean over the items' whole range is
        stretched to it, such as [0, 100]; null for the mean as it is.
    source
        Where the wording comes from.
    items
        The statements and questions, in the order in which they are asked.
    """

    schema_version: Annotated[Literal[1], FormatVersion, Field(alias="schema")] = 1
    name: Name
    title: Annotated[str, Field(min_length=1, max_length=5000)]
    source: str = ""
    anchors: Annotated[tuple[str, ...], Field(max_length=11)] = ()
    agreement_from: Annotated[int, Field(ge=2)] = 2
    score: tuple[float, float] | None = None
    items: Annotated[tuple[Item, ...], Field(min_length=1, max_length=500)]

    @model_validator(mode="after")
    def _parts_agree(self) -> Self:
        faults = tuple(self._faults())
        if faults:
            raise InconsistentError(faults)
        return self

    def _faults(self) -> Iterator[Fault]:
        yield from self._scale_faults()
        if self.score is not None:
            yield from self._score_faults(self.score)
        for i, item in enumerate(self.items):
            low, high = self.range_of(item)
            if item.expected is not None and not low <= item.expected <= high:
                message = f"{item.expected:g} is no answer to it; allowed: {low:g} to {high:g}"
                yield Fault(("items", i, "expected"), message)
        ids = [item.id for item in self.items]
        for i, given in enumerate(ids):
            if given in ids[:i]:
                yield Fault(
                    ("items", i, "id"), f"'{given}' is an earlier item's id; ids are unique"
                )

    def _scale_faults(self) -> Iterator[Fault]:
        pointed = any(item.answer == "point" for item in self.items)
        if not pointed and not self.anchors:
            return
        if self.points < 2:
            message = f"{self.points} given; allowed: 2 to 11, one for each point of the scale"
            yield Fault(("anchors",), message)
        elif "agreement_from" not in self.model_fields_set:
            yield Fault(("agreement_from",), f"missing; allowed: 2 to {self.points}")
        elif self.agreement_from > self.points:
            message = (
                f"{self.agreement_from} is not a point of the scale; allowed: 2 to {self.points}"
            )
            yield Fault(("agreement_from",), message)

    def _score_faults(self, score: tuple[float, float]) -> Iterator[Fault]:
        if not score[0] < score[1]:
            yield Fault(("score",), f"{score[0]:g} is not below {score[1]:g}")
        scored = [item for item in self.items if item.scored]
        unbounded = [item.id for item in scored if item.answer == "number"
                     and None in (item.lowest, item.highest)]  # fmt: skip
        if unbounded:
            yield Fault(("score",), f"item '{unbounded[0]}' has no lowest or highest answer")
        elif len({self.range_of(item) for item in scored}) > 1:
            yield Fault(("score",), "the items' scales differ; allowed: one range for all items")

    @property
    def points(self) -> int:
        """Number of points of the scale; answers are 1 to this."""
        return len(self.anchors)

    def range_of(self, item: Item) -> tuple[float, float]:
        """Return the lowest and the highest answer to an item; infinite where there is none."""
        if item.answer == "point":
            return 1.0, float(self.points)
        low = -float("inf") if item.lowest is None else item.lowest
        return low, float("inf") if item.highest is None else item.highest

    def item(self, item_id: str) -> Item:
        """Return the item of this id; ``KeyError`` when there is none."""
        for item in self.items:
            if item.id == item_id:
                return item
        raise KeyError(item_id)

    def ids(self, *, assisted: bool) -> tuple[str, ...]:
        """Return the ids of the items that apply to a lap with or without an assistant."""
        return tuple(i.id for i in self.items if assisted or i.asked == "every lap")

    def answering(self, item_or_subscale: str) -> tuple[str, ...]:
        """Return the ids that a comparison's outcome means: an item's own, or a subscale's."""
        if any(item.id == item_or_subscale for item in self.items):
            return (item_or_subscale,)
        return tuple(i.id for i in self.items if i.subscale == item_or_subscale and i.scored)
