"""Files whole or not at all."""

from pathlib import Path

import pytest

from protocols.record import atomic


class _KilledError(BaseException):
    """Stands for whatever stops the process."""


def test_a_file_is_replaced_as_a_whole(tmp_path: Path):
    """After writing, the new content is there and nothing else is."""
    path = tmp_path / "a.txt"
    atomic.write_whole(path, b"old")
    atomic.write_whole(path, b"new")
    assert path.read_bytes() == b"new"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("failure", [OSError(28, "No space left on device"), _KilledError()])
def test_a_failed_write_leaves_the_old_content(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, failure: BaseException
):
    """A full disk or an interruption while writing changes nothing and leaves no rubbish."""
    path = tmp_path / "a.txt"
    path.write_bytes(b"old")

    def half(partial: Path, content: bytes) -> None:
        partial.write_bytes(content[:1])
        raise failure

    monkeypatch.setattr(atomic, "write_through", half)
    with pytest.raises(type(failure)):
        atomic.write_whole(path, b"new")
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_partials_of_killed_processes_are_removed(tmp_path: Path):
    """Unfinished files and folders go, everything else stays; a link is not followed."""
    (tmp_path / "kept").mkdir()
    (tmp_path / "kept" / "a").write_text("a")
    (tmp_path / ".partial-x-1").mkdir()
    (tmp_path / ".partial-x-1" / "a").write_text("a")
    (tmp_path / ".partial-y-1").write_text("y")
    (tmp_path / ".partial-link").symlink_to(tmp_path / "kept")
    atomic.remove_partials(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["kept"]
    assert (tmp_path / "kept" / "a").exists()
    atomic.remove_partials(tmp_path / "nowhere")
