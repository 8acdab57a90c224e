"""MP4 files: H.264 by PyAV, in the colours of high-definition television, playable while they are being loaded."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from zeroset.errors import OutputError
from zeroset.export.film.frames import Pictures, Pixels

if TYPE_CHECKING:
    from av.video.stream import VideoStream

QUALITIES = {"small": 28, "good": 20, "best": 14}
"""Constant rate factors of H.264: six more halve the file."""
BT709 = 1
"""Number of the colour primaries, transfer and matrix of high-definition television, in H.264's own tables."""
STUDIO = 1
"""Number of the range 16 to 235, which players expect."""


def check_encoder(shown: str) -> None:
    """Raise ``OutputError`` unless an MP4 file can be encoded here."""
    if find_spec("av") is None:
        raise OutputError(
            f"cannot write {shown!r}: MP4 files are encoded by PyAV, which is not installed",
            hints=('pip install "zeroset[export]", or pip install av', "or write a .gif, or frames as out-####.png"),
        )
    import av

    if "libx264" not in av.codecs_available:
        raise OutputError(
            f"cannot write {shown!r}: this PyAV has no H.264 encoder",
            hints=("pip install --force-reinstall av", "or write a .gif, or frames as out-####.png"),
        )


def write_mp4(scratch: Path, frames: Pictures, fps: Fraction, quality: str, progress: Callable[[float], None]) -> None:
    """Encode frames into a file that nobody else sees yet, and make sure that all of them are in it.

    Raises:
        OutputError: the encoder failed, as it does on a full disk.
    """
    import av

    try:
        with av.open(str(scratch), "w", format="mp4", options={"movflags": "+faststart"}) as container:
            stream = container.add_stream("libx264", rate=fps, options={"crf": str(QUALITIES[quality])})
            _describe(stream, frames[0], fps)
            for i, pixels in enumerate(frames):
                frame = av.VideoFrame.from_ndarray(_even(pixels), format="rgb24")
                encoded = frame.reformat(
                    format="yuv420p", dst_colorspace="ITU709", src_color_range="JPEG", dst_color_range="MPEG"
                )
                encoded.pts, encoded.time_base = i, 1 / fps
                container.mux(stream.encode(encoded))
                progress(i / len(frames))
            container.mux(stream.encode())
        _check(scratch, len(frames))
    except OutputError:
        raise
    except (av.error.FFmpegError, OSError) as error:
        reason = error.strerror or str(error)
        raise OutputError(
            f"cannot encode the movie in {str(scratch.parent)!r}: {reason}", hint="is the disk full? Frames are kept"
        ) from None


def _describe(stream: VideoStream, pixels: Pixels, fps: Fraction) -> None:
    height, width, _ = _even(pixels).shape
    stream.width, stream.height, stream.pix_fmt = width, height, "yuv420p"
    stream.time_base = 1 / fps
    context = stream.codec_context
    context.color_primaries = context.color_trc = context.colorspace = BT709
    context.color_range = STUDIO


def _even(pixels: Pixels) -> Pixels:
    """H.264 shares colours among 2 x 2 pixels: an odd picture has its last row or column twice."""
    height, width, _ = pixels.shape
    if height % 2 or width % 2:
        return np.pad(pixels, ((0, height % 2), (0, width % 2), (0, 0)), mode="edge")
    return pixels


def _check(path: Path, count: int) -> None:
    """Raise unless a movie has so many frames: FFmpeg does not tell of everything that fails at the end."""
    import av

    with av.open(str(path)) as container:
        found = sum(1 for packet in container.demux(video=0) if packet.size)
    if found != count:
        raise OSError(f"{found} of {count} frames arrived")
