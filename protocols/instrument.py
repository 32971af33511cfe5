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
    """

    id: ItemId
    text: Annotated[str, Field(min_length=1, max_length=5000)]
    subscale: Name = "total"
    reverse: bool = False
    asked: Literal["every lap", "assisted laps"] = "every lap"
    answer: AnswerKind = "point"
    lowest: float | None = None
    highest: float | None = None

    @model_validator(mode="after")
    def _bounds_are_of_a_number(self) -> Self:
        bounds = [bound for bound in (self.lowest, self.highest) if bound is not None]
        if bounds and self.answer != "number":
            raise ValueError("lowest and highest are for an answer that is a number")
        if len(bounds) == 2 and not bounds[0] < bounds[1]:
            raise ValueError(f"lowest {bounds[0]:g} is not below highest {bounds[1]:g}")
        return self


class Instrument(FileModel):
    """A questionnaire: items answered on one ordinal scale.

    Attributes
    ----------
    anchors
        Labels of the scale's points, from 1 upwards; their number is the number of points.
    agreement_from
        Lowest point that counts as agreement.
    source
        Where the wording comes from.
    """

    schema_version: Annotated[Literal[1], FormatVersion, Field(alias="schema")] = 1
    name: Name
    title: Annotated[str, Field(min_length=1, max_length=5000)]
    source: str = ""
    anchors: Annotated[tuple[str, ...], Field(min_length=2, max_length=11)]
    agreement_from: Annotated[int, Field(ge=2)]
    items: Annotated[tuple[Item, ...], Field(min_length=1, max_length=500)]

    @model_validator(mode="after")
    def _parts_agree(self) -> Self:
        faults = tuple(self._faults())
        if faults:
            raise InconsistentError(faults)
        return self

    def _faults(self) -> Iterator[Fault]:
        if self.agreement_from > self.points:
            message = (
                f"{self.agreement_from} is not a point of the scale; allowed: 2 to {self.points}"
            )
            yield Fault(("agreement_from",), message)
        ids = [item.id for item in self.items]
        for i, given in enumerate(ids):
            if given in ids[:i]:
                yield Fault(
                    ("items", i, "id"), f"'{given}' is an earlier item's id; ids are unique"
                )

    @property
    def points(self) -> int:
        """Number of points of the scale; answers are 1 to this."""
        return len(self.anchors)

    def item(self, item_id: str) -> Item:
        """Return the item of this id; ``KeyError`` when there is none."""
        for item in self.items:
            if item.id == item_id:
                return item
        raise KeyError(item_id)

    def ids(self, *, assisted: bool) -> tuple[str, ...]:
        """Return the ids of the items that apply to a lap with or without an assistant."""
        return tuple(i.id for i in self.items if assisted or i.asked == "every lap")
