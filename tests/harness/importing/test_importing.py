"""Recordings become a study."""

import re

import numpy as np
import pytest

from harness.importing.guess import guess_bag_mapping
from harness.importing.mapping import BagMapping
from harness.importing.study import import_bags
from harness.running.runner import run_study
from harness.session.study_run import StudyRun
from lad.inputs import INPUT_NAMES
from lad.lad_assistant import LADAssistant
from protocols.course.centreline import Centreline
from protocols.files.errors import InputError
from protocols.importing.mapping_file import read_mapping
from protocols.load import resolve_study
from protocols.record.check import check_study
from protocols.record.reader import open_study
from protocols.shipped import shipped_text

SPEED = 0.5


@pytest.fixture
def bring_in(make_bag, mapping, tmp_path):
    """Return the function that records, imports and opens a study of one session."""

    def run(storage="sqlite", change=lambda _: None, more="", offset_s=0.0, **lines):
        bag = make_bag(storage, change, offset_s=offset_s)
        done = import_bags([bag], mapping(more, **lines), tmp_path / "study", lambda _: None)
        return done, open_study(tmp_path / "study")

    return run


@pytest.mark.parametrize("storage", ["ros1", "sqlite", "mcap"])
def test_a_known_drive_comes_back(storage, bring_in):
    """Lap time to 1 cs, positions to 2 mm, in a turned frame and with jitter in the arrivals."""
    done, study = bring_in(storage)
    assert done.troubles == ()
    assert (done.laps, done.finished) == (2, 2)
    line = Centreline(study.course)
    for lap in study.laps.to_pylist():
        assert lap["lap_time_s"] == pytest.approx(line.length / SPEED, abs=0.01)
        steps = study.steps("P0001", lap["lap"]).to_pandas()
        wanted = np.array([line.point(SPEED * t)[:2] for t in steps["t_s"]])
        off = np.hypot(*(steps[["x_m", "y_m"]].to_numpy() - wanted).T)
        assert off.max() < 0.002
        assert np.allclose(steps["arc_m"], SPEED * steps["t_s"], atol=0.01)


def test_inputs_are_those_of_the_live_world(bring_in):
    """Limited command, velocity and segments: infinity is 4 m, NaN and too near are no reading."""
    _, study = bring_in()
    baseline, helped = (study.steps("P0001", lap).to_pandas() for lap in (0, 1))
    assert np.allclose(baseline[["user_v", "user_w"]], [0.35, -0.2])
    assert np.allclose(helped[["user_v", "user_w"]], [0.35, -0.2 * 0.3])
    assert np.allclose(helped[["intent_v", "intent_w"]], [0.35, -0.2])
    assert np.allclose(baseline[["velocity_v", "velocity_w"]], [SPEED, -0.1])
    segments = baseline[list(INPUT_NAMES[4:])].to_numpy()
    wanted = np.full(15, 2.0)
    wanted[0], wanted[8] = 4.0, 1.25
    assert np.allclose(segments, wanted, atol=1e-6)


def test_takeovers_become_h_and_a(bring_in):
    """In the lap that the demonstrator helps; in the other one it is a shadow."""
    _, study = bring_in()
    shadow, helped = (study.steps("P0001", lap).to_pandas() for lap in (0, 1))
    inside = (helped["arc_m"] > 2.06) & (helped["arc_m"] < 3.94)
    assert (helped.loc[inside, "h"] == 1).all()
    assert (helped.loc[helped["arc_m"] > 4.1, "h"] == -1).all()
    assert np.allclose(helped.loc[inside, ["a_v", "a_w"]], [0.3, -0.2])
    assert set(helped.loc[inside, "control"]) == {"demonstrator"}
    assert shadow["h"].isna().all()
    assert (shadow.loc[(shadow["arc_m"] > 2.06) & (shadow["arc_m"] < 3.94), "h_would"] == 1).all()


def test_the_recorded_lap_teaches(bring_in):
    """The model learnt from the bag is saved like any other, and predicts as one taught by hand."""
    _, study = bring_in()
    model = LADAssistant.from_bytes(study.model_bytes("P0001"))
    by_hand = LADAssistant()
    for lap in (0, 1):
        by_hand.start_lap()
        for step in study.steps("P0001", lap).to_pylist():
            answer = by_hand.assist(np.array([step[name] for name in INPUT_NAMES]))
            assert answer.p_help == step["p_help"]
            if step["h"] is not None:
                command = None if step["a_v"] is None else (step["a_v"], step["a_w"])
                by_hand.learn(step["h"] == 1, command)
    assert by_hand.to_bytes() == model.to_bytes()


BORROWS = """\
schema: 1
name: borrows
title: Helped by a model that a recording taught
cohort: {participants: 1, driver: {use: autonomous}, respondent: null}
models: {theirs: {from: file, path: "study/sessions/{participant}/model.npz"}}
conditions:
  lent: {limitation: {right_turn_rad_s: 0.15}, assistant: model, model: theirs}
laps: [{condition: lent, time_limit_s: 8}]
"""


def test_a_study_borrows_the_model_that_a_recording_taught(bring_in, tmp_path):
    """In every step of its lap the answer is that of the saved model, which learns no more."""
    _, taught = bring_in()
    (tmp_path / "borrows.yaml").write_text(BORROWS)
    run = StudyRun(resolve_study(str(tmp_path / "borrows.yaml")), 1)
    assert run_study(run, tmp_path / "helped", 1).finished == 1
    model = LADAssistant.from_bytes(taught.model_bytes("P0001"))
    model.start_lap()
    steps = open_study(tmp_path / "helped").steps("P0001", 0).to_pylist()
    for step in steps:
        answer = model.assist(np.array([step[name] for name in INPUT_NAMES]))
        assert (answer.p_help, answer.helping) == (step["p_help"], step["control"] == "model")
    assert len({step["p_help"] for step in steps}) > 10


def test_an_imported_study_is_whole(bring_in):
    """Every table can be read."""
    _, study = bring_in()
    assert check_study(study.folder) == ()


def test_a_gap_is_named_and_imported(bring_in):
    """Which stream, in which lap, for how long and from when on."""

    def lose(bag):
        bag.messages = [m for m in bag.messages if not (m[0] == "/scan" and 1005 < m[2] < 1007)]

    done, _ = bring_in(change=lose)
    assert len(done.troubles) == 1
    found = re.search(r"P0001 lap 0: no message of /scan for (\S+) s from 5\.0 s", done.troubles[0])
    assert float(found[1]) == pytest.approx(2.0, abs=0.15)


def test_what_is_no_number_is_named_and_left_out(bring_in):
    """A pose of NaN, one whose orientation was never filled in, a command of NaN on two topics."""

    def spoil(bag):
        odometry = [message for topic, _, _, message in bag.messages if topic == "/odom"]
        odometry[40].pose.pose.position.x = np.nan
        odometry[80].pose.pose.orientation.z = odometry[80].pose.pose.orientation.w = 0.0
        next(
            m for topic, _, t, m in bag.messages if topic == "/cmd_vel" and t > 1003
        ).twist = bag.twist(np.nan, 0.0)

    done, study = bring_in(change=spoil)
    named = [re.search(r"(/\w+: \d+) of \d+ (\w+) are no numbers", t) for t in done.troubles]
    assert [match.groups() for match in named] == [
        ("/odom: 2", "poses"),
        ("/cmd_vel: 1", "commands"),
        ("/demonstrator: 1", "commands"),
    ]
    line = Centreline(study.course)
    steps = study.steps("P0001", 0).to_pandas()
    wanted = np.array([line.point(SPEED * t)[:2] for t in steps["t_s"]])
    assert np.hypot(*(steps[["x_m", "y_m"]].to_numpy() - wanted).T).max() < 0.005
    assert np.allclose(steps["executed_v"], 0.3)


def test_a_transform_that_does_not_fit_is_named(bring_in):
    """The laps begin somewhere else."""
    done, _ = bring_in(pose="pose: {topic: /odom}")
    assert "m from the course's start; do frame and transform fit?" in done.troubles[0]
    assert done.finished == 0


def test_a_recording_that_ends_in_the_middle_of_a_lap(bring_in):
    """What was driven is there; the lap is not finished."""

    def cut(bag):
        bag.messages = [m for m in bag.messages if m[2] < 1050]

    done, study = bring_in(change=cut)
    laps = study.laps.to_pylist()
    assert [lap["end_reason"] for lap in laps] == ["finished", "stopped"]
    assert laps[1]["lap_time_s"] is None
    assert done.finished == 1


def _drop(topic):
    def change(bag):
        bag.messages = [m for m in bag.messages if m[0] != topic]

    return change


@pytest.mark.parametrize(
    ("change", "lines", "message"),
    [
        (_drop("/scan"), {}, "no topic /scan; allowed: /cmd_vel, /demonstrator"),
        (None, {"scan": "scan: {topic: /scam}"}, "no topic /scam; allowed: "),
        (None, {"scan": "scan: {topic: /joy}"}, "/joy is sensor_msgs/msg/Joy; allowed: LaserScan"),
        (
            None,
            {"pose": "pose: {topic: /scan}"},
            "/scan is sensor_msgs/msg/LaserScan; allowed: Odo",
        ),
        (
            None,
            {"pose": "pose: {topic: /odom, frame: map}"},
            "poses are in frame 'odom', not 'map'",
        ),
        (None, {"starts": "starts: {topic: /lap, text: begin}"}, "'begin' in it; no lap begins"),
        (
            None,
            {"starts": "starts: {topic: /lap, text: '('}"},
            "map.yaml:9: starts: text: not a reg",
        ),
        (None, {"takeover": "takeover: {topic: /joy, button: 7}"}, "a joystick of 2 buttons; all"),
        (None, {"demonstrator": ""}, "takeover and demonstrator belong together"),
        (None, {"scan": "scan: {topic: /scan, forward: 1}"}, "map.yaml:4: scan.forward: "),
        (None, {"intent": "intent: {topic: /joy, stick: {axis_v: 7}}"}, "a joystick of 2 axes"),
    ],
)
def test_what_cannot_be_is_one_line(change, lines, message, bring_in, tmp_path):
    """The place and what is allowed; nothing is written."""
    with pytest.raises(InputError, match=re.escape(message)):
        bring_in(change=change or (lambda _: None), **lines)
    assert not (tmp_path / "study").exists()


def test_laps_in_a_persons_own_order(bring_in):
    """The mapping says which condition came first; the protocol has the rules of each."""
    _, study = bring_in(more="people: {session: {participant: P0007, laps: [helped, baseline]}}")
    laps = study.laps.to_pylist()
    assert [(lap["participant"], lap["condition"]) for lap in laps] == [
        ("P0007", "helped"),
        ("P0007", "baseline"),
    ]
    assert [lap["training"] for lap in laps] == [True, False]


def test_a_lap_that_the_protocol_does_not_have_is_named(bring_in):
    """With the conditions that are left."""
    more = "people: {session: {participant: P0001, laps: [helped, helped]}}"
    with pytest.raises(InputError, match="no lap of 'helped' left; allowed: baseline"):
        bring_in(more=more)


def test_two_clocks_are_named(bring_in):
    """Headers an hour behind the recorder, beside messages without headers."""
    with pytest.raises(InputError, match=r"two clocks: the headers of /\w+ are 3600\.0 s behind"):
        bring_in(offset_s=3600.0)


@pytest.mark.parametrize("storage", ["ros1", "sqlite", "mcap"])
def test_a_file_cut_in_the_middle_is_one_line(storage, make_bag, mapping, tmp_path):
    """Half a file is no recording."""
    bag = make_bag(storage)
    path = bag if bag.is_file() else next(p for p in bag.iterdir() if p.suffix != ".yaml")
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    said = r"(cannot be read as a recording|is cut off or damaged): .*; allowed: a whole ROS 1 bag"
    with pytest.raises(InputError, match=said):
        import_bags([path], mapping(), tmp_path / "study", lambda _: None)
    assert not (tmp_path / "study").exists()


def test_what_is_there_is_not_overwritten(bring_in, make_bag, mapping, tmp_path):
    """A folder with something in it is refused before anything is read."""
    (tmp_path / "study").mkdir()
    (tmp_path / "study" / "mine").write_text("mine")
    with pytest.raises(InputError, match="study: is there already; allowed: a new folder"):
        import_bags([tmp_path / "none.bag"], mapping(), tmp_path / "study", lambda _: None)


def test_a_person_without_a_recording_is_named(make_bag, mapping, tmp_path):
    """A name that is no recording's, with those there are."""
    more = "people: {tuesday: {participant: P0001}}"
    with pytest.raises(InputError, match=r"people\.tuesday: no recording .* allowed: session"):
        import_bags([make_bag()], mapping(more), tmp_path / "study", lambda _: None)


def test_a_guess_is_a_mapping(make_bag, tmp_path):
    """It finds every stream by type and name."""
    (tmp_path / "m.yaml").write_text(guess_bag_mapping(make_bag()))
    guessed, _ = read_mapping(tmp_path / "m.yaml", BagMapping)
    found = (guessed.pose, guessed.scan, guessed.executed, guessed.intent, guessed.starts)
    assert [source.topic for source in found] == ["/odom", "/scan", "/cmd_vel", "/joy", "/lap"]
    assert guessed.takeover.topic == "/takeover"
    assert guessed.demonstrator.topic == "/demonstrator"


def test_the_shipped_example_is_a_mapping(tmp_path):
    """It can be copied as it is."""
    (tmp_path / "m.yaml").write_text(shipped_text("bag-mapping"))
    assert read_mapping(tmp_path / "m.yaml", BagMapping)[0].demonstrated
