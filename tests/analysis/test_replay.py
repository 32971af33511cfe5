"""A lap as a moving picture."""

import pytest
from PIL import Image

from analysis.replay import shown_steps, write_replay
from protocols.files.errors import InputError


def test_a_replay_moves_and_shows_who_is_in_control(study, tmp_path):
    """Every other step and the last one; the trail takes the model's colour where it helped."""
    out = tmp_path / "lap.gif"
    write_replay(study.folder, [("P0001", 4)], out)
    t = study.steps("P0001", 4)["t_s"].to_numpy()
    with Image.open(out) as gif:
        assert gif.format == "GIF"
        assert gif.n_frames == len(shown_steps(t))
        first = gif.convert("RGB").tobytes()
        gif.seek(gif.n_frames - 1)
        last = gif.convert("RGB")
    assert last.tobytes() != first
    assert any(g > r + 60 and g > b + 20 for _, (r, g, b) in last.getcolors(1 << 20))
    assert out.stat().st_size < 6_000_000


def test_a_lap_without_a_model_can_be_replayed(study, tmp_path):
    """There is no p(h) to draw; the lap is."""
    out = tmp_path / "lap.gif"
    write_replay(study.folder, [("P0001", 1)], out)
    with Image.open(out) as gif:
        assert gif.n_frames > 1


def test_who_is_not_there_is_one_clear_line(study, tmp_path):
    """An unknown participant or lap names what there is, and nothing is written."""
    out = tmp_path / "lap.gif"
    with pytest.raises(InputError, match="P9999"):
        write_replay(study.folder, [("P9999", 1)], out)
    with pytest.raises(InputError, match="no lap 17"):
        write_replay(study.folder, [("P0001", 17)], out)
    assert not out.exists()


def test_a_folder_that_is_not_there_is_one_clear_line(study, tmp_path):
    """The output cannot be written: says where, before anything is drawn."""
    with pytest.raises(InputError, match="no such folder"):
        write_replay(study.folder, [("P0001", 1)], tmp_path / "nowhere" / "lap.gif")


def test_a_file_that_is_no_replay_by_its_name_is_refused(study, tmp_path):
    """A GIF under another ending would not open."""
    with pytest.raises(InputError, match=r"lap.avi: .*allowed: a name that ends with .gif, .mp4"):
        write_replay(study.folder, [("P0001", 1)], tmp_path / "lap.avi")
    assert not list(tmp_path.iterdir())


def test_two_laps_stand_side_by_side_as_mp4_and_as_page(study, tmp_path, monkeypatch):
    """Twice as wide as one, and as long as the longer one; the same bytes each time."""
    # Frames are not what is tested here: few, small ones will do.
    monkeypatch.setattr("analysis.replay.DPI", 20)
    two = [("P0001", 3), ("P0002", 4)]
    paths = [tmp_path / name for name in ("a.mp4", "b.mp4", "a.html", "b.html")]
    for path in paths:
        write_replay(study.folder, two, path)
    for one, other in (paths[:2], paths[2:]):
        assert one.read_bytes() == other.read_bytes()
    frames = [sum(shown_steps(study.steps(*lap)["t_s"].to_numpy()).values()) for lap in two]
    av = pytest.importorskip("av")
    with av.open(str(paths[0])) as film:
        (video,) = film.streams.video
        assert (video.width, video.height) == (2 * 112, 128)
        assert sum(1 for _ in film.decode(video)) == max(frames)
        assert video.average_rate == 10


def test_an_mp4_without_its_encoder_is_one_clear_line(study, tmp_path, monkeypatch):
    """Before anything is drawn: the line that installs it."""
    monkeypatch.setattr("analysis.film.find_spec", lambda _: None)
    with pytest.raises(InputError, match=r"lap.mp4: .*pip install 'lad-study\[video\]'"):
        write_replay(study.folder, [("P0001", 1)], tmp_path / "lap.mp4")
    assert not list(tmp_path.iterdir())
