"""The ROS 2 recordings."""

import json
import shutil

import numpy as np
import pytest

mcap_reader = pytest.importorskip("mcap.reader")
rosbags = pytest.importorskip("rosbags.highlevel")


def messages(path, topic):
    """Return a topic's messages in order, read by rosbags."""
    with rosbags.AnyReader([path]) as reader:
        connections = [c for c in reader.connections if c.topic == topic]
        return [
            (ns, reader.deserialize(raw, connection.msgtype))
            for connection, ns, raw in reader.messages(connections)
        ]


def test_values_are_the_sources(exported, study):
    """Pose, velocity, commands, segments and signals of every step of a session."""
    path = exported("mcap") / "P0002.mcap"
    laps = [row for row in study.laps.to_pylist() if row["participant"] == "P0002"]
    tables = [study.steps("P0002", row["lap"]) for row in laps]

    def column(name):
        return [v for t in tables for v in t[name].to_pylist() if v is not None]

    odometry = [m for _, m in messages(path, "/odom")]
    assert [m.pose.pose.position.x for m in odometry] == column("x_m")
    headings = [2 * np.arctan2(m.pose.pose.orientation.z, m.pose.pose.orientation.w)
                for m in odometry]  # fmt: skip
    turns = np.remainder(np.array(headings) - column("heading_rad") + np.pi, 2 * np.pi) - np.pi
    assert np.abs(turns).max() < 1e-12
    assert [m.twist.twist.linear.x for m in odometry] == column("velocity_v")
    for topic, name in (
        ("/intent", "intent"),
        ("/cmd_vel", "executed"),
        ("/demonstrator", "would"),
    ):
        assert [m.twist.angular.z for _, m in messages(path, topic)] == column(f"{name}_w")
    assert [m.data for _, m in messages(path, "/takeover")] == column("h")
    assert [m.data for _, m in messages(path, "/p_help")] == column("p_help")
    ranges = np.array([m.ranges for _, m in messages(path, "/scan")])
    wanted = np.array([column(f"segment_{i:02d}") for i in range(15)]).T
    np.testing.assert_allclose(ranges, wanted, atol=3e-7)


def test_laps_are_marked(exported, study):
    """Every lap has a start and an end with what its row says."""
    said = [json.loads(m.data) for _, m in messages(exported("mcap") / "P0001.mcap", "/lap")]
    rows = [row for row in study.laps.to_pylist() if row["participant"] == "P0001"]
    assert [s["event"] for s in said] == ["start", "end"] * len(rows)
    assert [s["lap_time_s"] for s in said[1::2]] == [row["lap_time_s"] for row in rows]
    assert [s["condition"] for s in said[::2]] == [row["condition"] for row in rows]


def whole(path):
    """Tell whether MCAP's own reader gets through a file, checksums compared."""
    with path.open("rb") as stream:
        reader = mcap_reader.make_reader(stream, validate_crcs=True)
        return sum(1 for _ in reader.iter_messages())


def test_mcaps_own_reader_accepts_it(exported, study):
    """Every file, with its checksums."""
    for name in study.sessions():
        assert whole(exported("mcap") / f"{name}.mcap") > 1000


@pytest.mark.parametrize("place", [0.02, 0.05])
def test_a_damaged_copy_is_refused(place, exported, tmp_path):
    """A few bytes of the first chunk are changed."""
    path = tmp_path / "damaged.mcap"
    shutil.copy(exported("mcap") / "P0001.mcap", path)
    content = bytearray(path.read_bytes())
    at = int(len(content) * place)
    content[at : at + 8] = bytes(b ^ 0xFF for b in content[at : at + 8])
    path.write_bytes(bytes(content))
    with pytest.raises(Exception):  # noqa: B017, PT011  # whatever the reader says
        whole(path)
