"""Maps of ROS are read as ROS means them."""

import math
import re

import numpy as np
import pytest
from PIL import Image

from protocols.files.errors import InputError
from protocols.importing.map.ros_map import read_map

HEAD = "image: m.png\nresolution: 0.5\norigin: [1.0, 2.0, {yaw}]\noccupied_thresh: 0.65\n{more}"


@pytest.fixture
def read(tmp_path):
    """Return the function that reads a map of these pixels."""

    def run(pixels, yaw=0.0, more="free_thresh: 0.196\n"):
        Image.fromarray(np.array(pixels, dtype=np.uint8)).save(tmp_path / "m.png")
        (tmp_path / "m.yaml").write_text(HEAD.format(yaw=yaw, more=more))
        return read_map(tmp_path / "m.yaml")

    return run


def test_the_first_row_is_the_top(read):
    """The lower left pixel is the first cell; dark is an obstacle, bright is free."""
    drawn = read([[254, 205], [0, 254]])
    assert drawn.occupied.tolist() == [[True, False], [False, False]]
    assert drawn.free.tolist() == [[False, True], [True, False]]


def test_negate_turns_dark_and_bright(read):
    """With it, bright is an obstacle."""
    drawn = read([[254, 0]], more="free_thresh: 0.196\nnegate: 1\n")
    assert drawn.occupied.tolist() == [[True, False]]


def test_what_is_transparent_is_unknown(read):
    """An alpha channel says what the robot has not seen."""
    drawn = read([[[255, 255, 255, 255], [255, 255, 255, 0]]])
    assert drawn.free.tolist() == [[True, False]]
    assert not drawn.occupied.any()


@pytest.mark.parametrize("ending", ["png", "pgm"])
def test_sixteen_bits_are_read_as_eight(read, ending, tmp_path):
    """An unknown pixel stays unknown; cut off at 255 it would be free."""
    grey = np.array([[254, 205], [0, 254]], dtype=np.uint16)
    wanted = read(grey)
    Image.fromarray(grey * 257).save(tmp_path / f"deep.{ending}")
    head = HEAD.format(yaw=0.0, more="free_thresh: 0.196\n").replace("m.png", f"deep.{ending}")
    (tmp_path / "deep.yaml").write_text(head)
    found = read_map(tmp_path / "deep.yaml")
    assert found.free.tolist() == wanted.free.tolist()
    assert found.occupied.tolist() == wanted.occupied.tolist()


def test_an_image_of_real_numbers_is_refused(read, tmp_path):
    """One line: nobody knows what they mean."""
    read([[254, 0]])
    Image.fromarray(np.ones((2, 2), dtype=np.float32)).save(tmp_path / "m.png", format="TIFF")
    with pytest.raises(InputError, match="has real numbers; allowed: 8 or 16 bits"):
        read_map(tmp_path / "m.yaml")


@pytest.mark.parametrize("yaw", [0.0, 0.7, -2.0])
def test_a_turned_origin_is_obeyed(read, yaw):
    """There and back again is where one was; the corner is the origin."""
    drawn = read([[254, 254]], yaw=yaw)
    assert drawn.outward(0, 0) == (1.0, 2.0)
    assert drawn.outward(1, 0) == pytest.approx((1 + math.cos(yaw), 2 + math.sin(yaw)))
    assert drawn.inward(*drawn.outward(0.3, 0.4)) == pytest.approx((0.3, 0.4))


def test_what_other_programs_add_is_passed_over(read):
    """Such as nav2's own notes."""
    assert read([[254]], more="free_thresh: 0.196\nmode: trinary\nauthor: me\n").free.all()


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ("free_thresh: 0.7\n", "m.yaml:5: free_thresh: 0.7; allowed: below occupied_thresh (0.65)"),
        ("free_thresh: 2\n", "m.yaml:5: free_thresh: "),
        ("mode: raw\nfree_thresh: 0.1\n", "m.yaml:5: mode: 'raw' has no scale"),
    ],
)
def test_a_head_that_cannot_be_is_refused(read, more, message):
    """One line with file, line and what is allowed."""
    with pytest.raises(InputError, match=re.escape(message)):
        read([[254]], more=more)


def test_a_missing_image_is_named(tmp_path):
    """The line that names it."""
    (tmp_path / "m.yaml").write_text(HEAD.format(yaw=0, more=""))
    with pytest.raises(InputError, match=r"m\.yaml:1: image: there is no file .*m\.png"):
        read_map(tmp_path / "m.yaml")


def test_an_image_that_is_none_is_named(tmp_path):
    """A text with an image's name."""
    (tmp_path / "m.yaml").write_text(HEAD.format(yaw=0, more=""))
    (tmp_path / "m.png").write_text("no picture")
    with pytest.raises(InputError, match=r"m\.yaml:1: image: .*cannot be read as an image"):
        read_map(tmp_path / "m.yaml")
