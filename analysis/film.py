"""Frames as a GIF or an MP4: the same frames give the same bytes."""

import io
from collections.abc import Callable, Sequence
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from PIL import Image

from protocols.files.errors import InputError

Encoder = Callable[[list[Image.Image], list[int], float], bytes]
"""From frames, for how many times a frame's time each is shown, and that time in s, to a file."""

EXTRA = "an MP4 needs a package that encodes it: pip install 'lad-study[video]'"


def gif(
    frames: list[Image.Image], lasting: list[int], frame_s: float, colours: Sequence[str]
) -> bytes:
    """Return the frames as an endless GIF with one palette, so that little changes per frame.

    The format counts hundredths of a second, 65535 at most.

    Parameters
    ----------
    frames, lasting, frame_s
        As of every ``Encoder``.
    colours
        Those that mean something: they are in the palette however little they take.
    """
    palette = _palette(frames[len(frames) // 2], colours)
    flat = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    stream = io.BytesIO()
    flat[0].save(stream, "GIF", save_all=True, append_images=flat[1:], loop=0, optimize=False,
                 duration=[min(round(1000 * frame_s * n), 655_350) for n in lasting])  # fmt: skip
    return stream.getvalue()


def _palette(frame: Image.Image, colours: Sequence[str]) -> Image.Image:
    """Return a palette with the frame's shades and every colour that means something."""
    sample = frame.copy()
    size = max(sample.height // 16, 1)
    for i, colour in enumerate(colours):
        sample.paste(colour, (0, i * 2 * size, 4 * size, (i + 1) * 2 * size))
    return sample.quantize(32, dither=Image.Dither.NONE)


def require_encoder(out: Path) -> None:
    """Refuse a file that needs a package which is not here, before anything is drawn.

    Raises
    ------
    InputError
        Names the line that installs it.
    """
    if find_spec("av") is None:
        raise InputError(f"{out}: {EXTRA}")


def mp4(frames: list[Image.Image], lasting: list[int], frame_s: float) -> bytes:
    """Return the frames as an MP4 (H.264) that browsers and slides play."""
    import av  # noqa: PLC0415  # an extra

    stream = io.BytesIO()
    # One thread and no date: the same frames give the same bytes.
    with av.open(stream, "w", format="mp4", options={"fflags": "+bitexact"}) as file:
        rate = Fraction(1) / Fraction(str(frame_s))
        video = file.add_stream("libx264", rate=rate, options={"crf": "20", "threads": "1"})
        video.width, video.height = (side - side % 2 for side in frames[0].size)
        video.pix_fmt = "yuv420p"
        shape = (0, 0, video.width, video.height)
        for frame, n in zip(frames, lasting, strict=True):
            pixels = np.asarray(frame.crop(shape))
            for _ in range(n):
                file.mux(video.encode(av.VideoFrame.from_ndarray(pixels, format="rgb24")))
        file.mux(video.encode())
    return stream.getvalue()
