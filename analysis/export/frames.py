"""A lap's steps as frames to learn from: vectors and numbers, with masks instead of gaps."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
import numpy.typing as npt
import pyarrow as pa
from numpy.typing import NDArray

from analysis.export.field import Field
from lad.inputs import INPUT_NAMES

VECTORS: dict[str, tuple[str, ...]] = {
    "observation.state": INPUT_NAMES,
    "action": ("executed_v", "executed_w"),
    "command.driver": ("intent_v", "intent_w"),
    "command.limited": ("user_v", "user_w"),
    "command.arbitrated": ("arbitrated_v", "arbitrated_w"),
    "command.demonstrator": ("would_v", "would_w"),
    "command.model": ("mean_v", "mean_w"),
    "pose.start": ("x_m", "y_m", "heading_rad"),
    "pose.end": ("result_x_m", "result_y_m", "result_heading_rad"),
    "velocity.end": ("result_v", "result_w"),
}
"""Features of more than one number, and the step columns they are made of."""

SCALARS: dict[str, tuple[str, str]] = {
    "takeover": ("h", "float32"),
    "takeover.would": ("h_would", "float32"),
    "model.p_help": ("p_help", "float32"),
    "recorded_time_s": ("t_s", "float32"),
    "clearance_m": ("clearance_m", "float32"),
    "arc_m": ("arc_m", "float32"),
    "contact": ("contact", "bool"),
    "safeguarded": ("safeguarded", "bool"),
}
"""Features of one number: their step column and their type."""


@dataclass(frozen=True)
class Frames:
    """What the frames of a study hold.

    Attributes
    ----------
    masked
        Features that can be missing; each has a truth value ``NAME.given`` beside it.
    """

    masked: frozenset[str]

    @classmethod
    def of(cls, fields: Iterable[Field]) -> Self:
        """Return what frames made of step columns hold; a mask where a column can be missing."""
        gaps = {field.name for field in fields if field.nullable}
        made_of = VECTORS | {name: (column,) for name, (column, _) in SCALARS.items()}
        return cls(frozenset(name for name, parts in made_of.items() if gaps & set(parts)))

    def columns(self, steps: pa.Table) -> Iterator[tuple[str, NDArray[Any]]]:
        """Yield every feature of a lap: shape (steps,) or (steps, k); 0 or False where missing."""
        for name, parts in VECTORS.items():
            numbers = np.stack([_numbers(steps, part) for part in parts], axis=1)
            yield from self._with_mask(name, numbers, np.float32)
        for name, (column, kind) in SCALARS.items():
            yield from self._with_mask(name, _numbers(steps, column), np.dtype(kind))

    def _with_mask(
        self, name: str, numbers: NDArray[np.float64], kind: npt.DTypeLike
    ) -> Iterator[tuple[str, NDArray[Any]]]:
        there: NDArray[np.bool_] = np.isfinite(numbers)
        yield name, np.where(there, numbers, 0.0).astype(kind)
        if name in self.masked:
            yield f"{name}.given", np.asarray(there.reshape(len(there), -1).all(axis=1))

    def described(self) -> Iterator[tuple[str, str, tuple[str, ...]]]:
        """Yield name, type and parts of every feature; no parts for one number."""
        made_of = {name: ("float32", parts) for name, parts in VECTORS.items()}
        made_of |= {name: (kind, ()) for name, (_, kind) in SCALARS.items()}
        for name, (kind, parts) in made_of.items():
            yield name, kind, parts
            if name in self.masked:
                yield f"{name}.given", "bool", ()


def _numbers(steps: pa.Table, column: str) -> NDArray[np.float64]:
    """Return a column as numbers, missing ones NaN."""
    values = steps[column]
    if pa.types.is_boolean(values.type):
        values = values.cast(pa.int8())
    numbers: NDArray[np.float64] = values.cast(pa.float64()).to_numpy(zero_copy_only=False)
    return numbers
