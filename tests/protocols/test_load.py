"""Studies with everything they refer to."""

from importlib.resources import files
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lad.hyperparameters import LADParameters
from protocols.course.schema import Course, Furniture
from protocols.files.dump import to_yaml
from protocols.files.errors import InputError
from protocols.instrument import Instrument
from protocols.load import (
    check_file,
    load_course,
    load_protocol,
    resolve_study,
    shipped_courses,
    shipped_protocols,
)
from protocols.resolved import ResolvedStudy

_FOUR_LAP = files("protocols").joinpath("studies/four-lap.yaml").read_text()
_COURSE = files("protocols").joinpath("courses/lab-office.yaml").read_text()
_ITEMS = files("protocols").joinpath("instruments/driving-assistance.yaml").read_text()


def _changed(tmp_path: Path, old: str, new: str) -> str:
    assert old in _FOUR_LAP
    path = tmp_path / "mine.yaml"
    path.write_text(_FOUR_LAP.replace(old, new))
    return str(path)


def _refused(name: str, **options: str | int) -> tuple[str, ...]:
    with pytest.raises(InputError) as caught:
        resolve_study(name, **options)
    return caught.value.faults


def _said(path: Path) -> str | None:
    """Return what loading a protocol complains of; None when it does not."""
    try:
        load_protocol(str(path))
    except InputError as error:
        return str(error)
    return None


def test_four_lap_is_the_papers_study():
    """Section V: familiarisation, then four laps; questions 1-4 twice, then all eleven twice."""
    study = resolve_study("four-lap")
    laps = study.protocol.laps
    assert [lap.condition for lap in laps] == [
        "familiarisation", "baseline", "limited", "human-assisted", "model-assisted"]  # fmt: skip
    assert [lap.practice for lap in laps] == [True, False, False, False, False]
    assert [len(study.questions(lap)) for lap in study.protocol.laps] == [0, 4, 4, 11, 11]
    conditions = [study.protocol.conditions[study.protocol.laps[n].condition] for n in range(5)]
    assert [c.assistant for c in conditions] == ["none", "none", "none", "demonstrator", "model"]
    assert [c.limitation is not None for c in conditions] == [False, False, True, True, True]
    assert [c.training for c in conditions] == [False, False, False, True, False]
    assert all(c.safeguard for c in conditions)
    assert study.protocol.cohort.participants == 12
    assert study.protocol.model.parameters == LADParameters()


@pytest.mark.parametrize("name", shipped_protocols())
def test_every_shipped_protocol_resolves(name: str):
    """What ships is valid, and its name is its file's."""
    assert resolve_study(name).protocol.name == name


@pytest.mark.parametrize("name", shipped_courses())
def test_every_shipped_course_can_be_driven(name: str):
    """What ships is valid and drivable, and its name is its file's."""
    assert load_course(name).name == name


def test_a_resolved_study_has_nothing_left_to_look_up(tmp_path: Path):
    """Paths become names, `all` becomes ids: the record does not depend on where files were."""
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "room.yaml").write_text(
        _COURSE.replace("name: lab-office", "name: room", 1)
    )
    (tmp_path / "items.yaml").write_text(_ITEMS.replace("driving-assistance", "mine"))
    text = _FOUR_LAP.replace("course: lab-office", "course: sub/room.yaml")
    text = text.replace("instrument: driving-assistance", "instrument: items.yaml")
    (tmp_path / "p.yaml").write_text(text.replace("driving-assistance.Q7", "mine.Q7"))
    study = resolve_study(str(tmp_path / "p.yaml"))
    assert (study.protocol.course, study.course.name) == ("room", "room")
    assert [i.name for i in study.instruments] == ["mine"]
    assert study.protocol.laps[1].survey[0].instrument == "mine"
    assert study.protocol.laps[4].survey[0].items == study.instruments[0].ids(assisted=True)
    assert study.folder == tmp_path
    with pytest.raises(KeyError):
        study.instrument("items.yaml")


def test_all_items_are_those_that_apply(tmp_path: Path):
    """After a lap without assistance, `all` leaves out the items about assistance."""
    study = resolve_study(_changed(tmp_path, "items: [Q1, Q2, Q3, Q4]", "items: all"))
    assert study.protocol.laps[1].survey[0].items == ("Q1", "Q2", "Q3", "Q4")


def test_course_and_number_of_participants_can_be_given(tmp_path: Path):
    """The command line's choices replace the file's."""
    (tmp_path / "room.yaml").write_text(_COURSE.replace("name: lab-office", "name: room", 1))
    study = resolve_study("four-lap", course=str(tmp_path / "room.yaml"), participants=3)
    assert (study.protocol.course, study.protocol.cohort.participants) == ("room", 3)


@pytest.mark.parametrize("participants", [0, -1, 10_000])
def test_the_number_of_participants_has_a_range(participants: int):
    """None, negative and more than ids can number are refused."""
    (fault,) = _refused("four-lap", participants=participants)
    assert fault == f"participants: {participants} is out of range; allowed: 1 to 9999"


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        (
            "course: lab-office",
            "course: lab-ofice",
            "course: lab-office",
            "course: no course is named 'lab-ofice'; allowed: a file, ",
        ),
        (
            "{instrument: driving-assistance, items: all}",
            "{instrument: nasa, items: all}",
            "{instrument: driving-assistance, items: all}",
            "laps[3].survey[0].instrument: no instrument is named 'nasa'",
        ),
        (
            "items: [Q1, Q2, Q3, Q4]",
            "items: [Q1, Q12]",
            "items: [Q1, Q2, Q3, Q4]",
            "laps[1].survey[0].items[1]: 'Q12' is not an item of 'driving-assistance'; allowed: Q1",
        ),
        (
            "driving-assistance.Q7",
            "driving-assistance.Q70",
            "driving-assistance.Q7",
            "analyses[4].outcome: 'Q70' of 'driving-assistance' is not asked after a lap",
        ),
        (
            "driving-assistance.Q7",
            "other.Q7",
            "driving-assistance.Q7",
            "analyses[4].outcome: 'Q7' of 'other' is not asked",
        ),
        (
            "training: true",
            "training: false",
            "- condition: model-assisted\n    survey",
            "laps[4].condition: 'model-assisted' is assisted by the model, which has learnt",
        ),
    ],
)
def test_references_that_lead_nowhere_are_told_at_their_line(
    tmp_path: Path, old: str, new: str, line: str, message: str
):
    """What a protocol refers to but does not exist is a fault of the protocol's own line."""
    path = _changed(tmp_path, old, new)
    number = _FOUR_LAP[: _FOUR_LAP.index(line)].count("\n") + 1
    assert _refused(path)[0].startswith(f"{path}:{number}: {message}")


def test_a_fault_in_a_referred_file_names_that_file(tmp_path: Path):
    """A protocol with a broken course says what is wrong in the course, and where."""
    (tmp_path / "room.yaml").write_text(_COURSE.replace("title:", "titel:"))
    path = _changed(tmp_path, "course: lab-office", "course: room.yaml")
    assert _refused(path)[0].startswith(f"{tmp_path / 'room.yaml'}:")
    assert "titel: unknown field" in _refused(path)[0]


def test_a_course_nobody_can_drive_names_its_file(tmp_path: Path):
    """A valid file of an impossible course is refused with file and reason."""
    path = tmp_path / "room.yaml"
    course = load_course("lab-office")
    block = Furniture(name="block", x=course.start.x, y=course.start.y, length=1, width=1)
    path.write_text(to_yaml(course.model_copy(update={"furniture": (block,)})))
    with pytest.raises(InputError) as caught:
        load_course(str(path))
    assert str(caught.value).startswith(f"{path}:")


def test_two_instruments_cannot_share_a_name(tmp_path: Path):
    """Answers are recorded by instrument name, so a study's instruments have distinct names."""
    (tmp_path / "copy.yaml").write_text(_ITEMS)
    path = _changed(tmp_path, "driving-assistance, items: all", "copy.yaml, items: all")
    assert "is named 'driving-assistance' too" in _refused(path)[0]


def test_a_survey_of_nothing_is_refused(tmp_path: Path):
    """`all` items of an instrument about assistance are none after a lap without any."""
    items = _ITEMS.replace("name: driving-assistance", "name: help").replace(
        "subscale: task", "subscale: task, asked: assisted laps")  # fmt: skip
    (tmp_path / "help.yaml").write_text(items)
    old = "{instrument: driving-assistance, items: [Q1, Q2, Q3, Q4]}"
    path = _changed(tmp_path, old, "{instrument: help.yaml, items: all}")
    assert "no item of 'help' applies to a lap without assistance" in _refused(path)[0]


def test_any_kind_of_file_can_be_checked(tmp_path: Path):
    """What a file is follows from its fields; a file of no kind is checked as a protocol."""
    for name, text, kind in (
        ("p", _FOUR_LAP, ResolvedStudy), ("c", _COURSE, Course), ("i", _ITEMS, Instrument)
    ):  # fmt: skip
        path = tmp_path / f"{name}.yaml"
        path.write_text(text)
        assert isinstance(check_file(str(path)), kind)
    assert isinstance(check_file("lab-office"), Course)
    assert isinstance(check_file("driving-assistance"), Instrument)
    (tmp_path / "x.yaml").write_text("- 1\n")
    with pytest.raises(InputError, match="must be a mapping of fields"):
        check_file(str(tmp_path / "x.yaml"))


@given(data=st.data())
def test_a_damaged_protocol_is_valid_or_one_line(
    data: st.DataObject, tmp_path_factory: pytest.TempPathFactory
):
    """Whichever lines of a right file are lost, doubled or cut, the answer is one clear line."""
    lines = _FOUR_LAP.splitlines(keepends=True)
    at = data.draw(st.integers(0, len(lines) - 1))
    column = data.draw(st.integers(0, len(lines[at])))
    damage = data.draw(st.sampled_from(["lose", "double", "cut", "insert"]))
    mark = data.draw(st.sampled_from([":", "-", "x", "[", "'", "\t", "9", "é"]))
    line = lines[at]
    lines[at] = {
        "lose": "", "double": line * 2, "cut": line[:column] + "\n",
        "insert": line[:column] + mark + line[column:],
    }[damage]  # fmt: skip
    path = tmp_path_factory.getbasetemp() / "damaged.yaml"
    path.write_text("".join(lines), encoding="utf-8")
    said = _said(path)
    assert said is None or (said.startswith(f"{path}:") and "\n" not in said)


@pytest.mark.parametrize(
    ("field", "where"),
    [
        ("groups: {one: {model: {use: 'os:system'}}, two: {}}", "groups.one.model.use"),
        (
            "groups: {one: {demonstrator: {use: 'os:system'}}, two: {}}",
            "groups.one.demonstrator.use",
        ),
        ("demonstrators: {other: {use: 'os:system'}}", "demonstrators.other.use"),
    ],
)
def test_no_field_names_a_part_that_nobody_provides(tmp_path: Path, field: str, where: str):
    """Groups and further demonstrators are looked up as the cohort's parts are."""
    path = _changed(tmp_path, "schema: 1\n", f"schema: 1\n{field}\n")
    (fault,) = _refused(path)
    line = Path(path).read_text().splitlines().index(field) + 1
    assert fault.startswith(f"{path}:{line}: {where}: no ")
    assert "is called 'os:system'" in fault
