"""Finding files by a shipped name or a path."""

import os
from pathlib import Path

import pytest

from protocols.files.errors import InputError
from protocols.shipped import locate, shipped_names, shipped_text


def test_shipped_names_are_listed_without_suffix():
    """What ships is known by plain names, sorted."""
    assert "four-lap" in shipped_names("studies")
    assert "lab-office" in shipped_names("courses")
    assert shipped_names("instruments") == tuple(sorted(shipped_names("instruments")))


def test_a_shipped_name_wins_over_a_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """A file or folder that happens to be named like a shipped study does not hide it."""
    (tmp_path / "four-lap").write_text("junk")
    monkeypatch.chdir(tmp_path)
    assert locate("studies", "four-lap").label == "four-lap.yaml"


def test_paths_start_at_the_folder_of_the_file_that_names_them(tmp_path: Path):
    """A relative path is looked up beside the file in which it stands."""
    (tmp_path / "c.yaml").write_text("a: 1")
    source = locate("courses", "c.yaml", tmp_path)
    assert source.document().data == {"a": 1}
    assert source.folder == tmp_path


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("four-lop", "no protocol is named 'four-lop'; allowed: a file, "),
        ("four-lop", "(did you mean 'four-lap'?)"),
        ("four-lop.yaml", "four-lop.yaml: no such file; allowed: a file, "),
        ("some/where", "some/where: no such file"),
        ("", "no protocol is named ''"),
        ("a\0b", "no protocol is named 'a\\x00b'"),
        ("x" * 5000, "no protocol is named 'xxx"),
        (".", ".: is a folder, not a protocol file"),
    ],
)
def test_what_cannot_be_found_is_said_with_what_can(name: str, message: str):
    """An unknown name, a missing file and a folder are told apart, and what ships is listed."""
    with pytest.raises(InputError) as caught:
        locate("studies", name)
    assert message in str(caught.value)


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read everything")
def test_an_unreadable_file_is_an_input_error(tmp_path: Path):
    """Permissions are the person's to change: one line, not a traceback."""
    path = tmp_path / "p.yaml"
    path.write_text("a: 1")
    path.chmod(0)
    with pytest.raises(InputError, match="cannot be read: Permission denied"):
        locate("studies", str(path)).text()


def test_shipped_files_are_shown_with_their_comments():
    """What is printed to be copied is the file itself; an unknown name lists what ships."""
    assert shipped_text("four-lap").startswith("# The study with people")
    assert "Q11" in shipped_text("driving-assistance")
    with pytest.raises(
        InputError, match=r"no shipped protocol.* is named 'lab'; allowed: .*lab-office"
    ):
        shipped_text("lab")
