"""What pydantic finds, in the words and at the lines of the file."""

from typing import Annotated, Literal, Self

import pytest
from pydantic import Field, model_validator

from protocols.files.document import parse
from protocols.files.errors import InputError
from protocols.files.fault import Fault, InconsistentError
from protocols.files.file_model import FileModel, Name, part_name
from protocols.files.validation import validate


class _Wheel(FileModel):
    radius: Annotated[float, Field(gt=0, le=2)]
    kind: Literal["driven", "caster"] = "driven"
    motor: part_name("dc", "hub") = "dc"


class _Chair(FileModel):
    name: Name
    seats: Annotated[int, Field(ge=1)] = 1
    safe: bool = True
    wheels: Annotated[tuple[_Wheel, ...], Field(min_length=1, max_length=3)]
    spare: _Wheel | None = None
    colours: Annotated[tuple[Name, ...], Field(min_length=1)] | Literal["all"] = "all"
    named: dict[Name, _Wheel] = Field(default_factory=dict)
    note: Annotated[str, Field(min_length=1)] = "-"

    @model_validator(mode="after")
    def _agrees(self) -> Self:
        faults = [
            Fault(("wheels", i, "kind"), "a spare caster is not driven")
            for i, wheel in enumerate(self.wheels)
            if self.spare and wheel.kind == "caster"
        ]
        if faults:
            raise InconsistentError(tuple(faults))
        return self


_GOOD = "name: chair\nwheels:\n  - radius: 0.2\n  - radius: 1\n    kind: caster\n"


def _faults(text: str) -> tuple[str, ...]:
    with pytest.raises(InputError) as caught:
        validate(parse(text.encode(), "chair.yaml"), _Chair)
    return caught.value.faults


def test_a_right_file_becomes_a_model():
    """Lists become tuples, whole numbers become floats where a float is wanted."""
    chair = validate(parse(_GOOD.encode(), "chair.yaml"), _Chair)
    assert chair == _Chair(
        name="chair", wheels=(_Wheel(radius=0.2), _Wheel(radius=1, kind="caster"))
    )


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ("name: chair\n", "", "1: name: missing; it must be given"),
        (
            "  - radius: 0.2\n",
            "  - kind: caster\n",
            "3: wheels[0].radius: missing; it must be given",
        ),
        (
            "name:",
            "nmae:",
            "1: nmae: unknown field; allowed: name, seats, safe, wheels, spare, colours, named",
        ),
        ("kind:", "xyz:", "5: wheels[1].xyz: unknown field; allowed: radius, kind, motor"),
        (
            "radius: 1",
            "radius: 3",
            "4: wheels[1].radius: 3 is out of range; allowed: above 0, at most 2",
        ),
        (
            "radius: 1",
            "radius: 0",
            "4: wheels[1].radius: 0 is out of range; allowed: above 0, at most 2",
        ),
        ("radius: 1", "radius: .nan", "4: wheels[1].radius: must be a finite number; given nan"),
        ("radius: 1", "radius: -.inf", "4: wheels[1].radius: must be a finite number; given -inf"),
        ("radius: 1", "radius: '1'", "4: wheels[1].radius: must be a number; given '1'"),
        ("radius: 1", "radius: true", "4: wheels[1].radius: must be a number; given true"),
        ("radius: 1", "radius:", "4: wheels[1].radius: must be a number; given nothing"),
        (
            "kind: caster",
            "kind: castor",
            "5: wheels[1].kind: 'castor' is not allowed here; allowed: driven, caster (did you",
        ),
        (
            "kind: caster",
            "motor: steam engine",
            "5: wheels[1].motor: 'steam engine' names no part; allowed: dc, hub, another name of",
        ),
        ("name: chair", "name: chair\nseats: 1.5", "2: seats: must be a whole number; given 1.5"),
        (
            "name: chair",
            "name: chair\nseats: 0",
            "2: seats: 0 is out of range; allowed: at least 1",
        ),
        ("name: chair", "name: chair\nsafe: yes", "2: safe: must be true or false; given 'yes'"),
        ("name: chair", "name: 7", "1: name: must be text (put it in quotes); given 7"),
        (
            "name: chair",
            "name: a/b",
            "1: name: 'a/b' is not a name; allowed: letters, digits, space, _, ., -",
        ),
        ("name: chair", "name: chair\nnote: ''", "2: note: must not be empty"),
        ("name: chair", "name: chair\nspare: 3", "2: spare: must be a mapping of fields; given 3"),
        (
            "name: chair",
            "name: chair\nnamed: [1]",
            "2: named: must be a mapping of names to values; given a list",
        ),
        (
            "name: chair",
            "name: chair\nnamed:\n  a: {radius: 9}",
            "3: named.a.radius: 9 is out of range; allowed: above 0, at most 2",
        ),
        (
            "name: chair",
            "name: chair\nnamed:\n  a/b: {radius: 1}",
            "3: named.a/b: 'a/b' is not a name; allowed: letters, digits, space, _, ., -",
        ),
        (
            "name: chair",
            "name: chair\ncolours: red",
            "2: colours: must be a list; given 'red'; or 'red' is not allowed here; allowed: all",
        ),
        (
            "name: chair",
            "name: chair\ncolours: [red, 3]",
            "2: colours[1]: must be text (put it in quotes); given 3",
        ),
        (
            "name: chair",
            "name: chair\nspare: {radius: 1}",
            "6: wheels[1].kind: a spare caster is not driven",
        ),
        ("wheels:", "wheels: []\nspare:", "2: wheels: has 0 entries; allowed: at least 1"),
        (
            _GOOD[12:],
            "wheels: [{radius: 1}, {radius: 1}, {radius: 1}, {radius: 1}]",
            "2: wheels: has more entries than allowed; allowed: at most 3",
        ),
        (_GOOD, "- 1\n", "1: must be a mapping of fields; given a list"),
        (_GOOD, "text\n", "1: must be a mapping of fields; given 'text'"),
    ],
)
def test_a_fault_is_told_once_where_it_is(old: str, new: str, fault: str):
    """One slip gives one line: file, line, field, what was given and what is allowed."""
    assert _GOOD.replace(old, new) != _GOOD
    assert _faults(_GOOD.replace(old, new))[0].startswith(f"chair.yaml:{fault}")


def test_every_fault_is_kept():
    """Two slips give two faults, in the order of the file."""
    text = _GOOD.replace("radius: 0.2", "radius: 20").replace("caster", "castor")
    assert [fault.partition(": ")[0] for fault in _faults(text)] == ["chair.yaml:3", "chair.yaml:5"]


@pytest.mark.parametrize("name", ['"os:path\\n"', "'os:'", ":path", "a:b:c", "../a:b", "a" * 201])
def test_what_cannot_be_a_parts_name_is_refused(name: str):
    """A name's form is checked to its last character."""
    (fault,) = _faults(_GOOD.replace("kind: caster", f"motor: {name}"))
    assert "names no part; allowed: dc, hub" in fault
    assert len(fault) < 300


def test_a_factory_may_stand_for_a_shipped_component():
    """A module and a function are accepted; whether they exist is found out where it is known."""
    text = _GOOD.replace("kind: caster", "motor: my_lab.motors:steam_engine")
    chair = validate(parse(text.encode(), "chair.yaml"), _Chair)
    assert chair.wheels[1].motor == "my_lab.motors:steam_engine"
