"""GIF and MP4 files, read back by what reads them elsewhere."""

from __future__ import annotations

import io
import tempfile
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import av
import numpy as np
import numpy.typing as npt
import pytest
from PIL import Image

from zeroset.errors import OutputError
from zeroset.export.film import movie, target
from zeroset.export.film.gif import DITHERS, delays, write_gif
from zeroset.export.film.movie import QUALITIES, write_mp4

Pixels = npt.NDArray[np.uint8]


def smooth(count: int, height: int = 48, width: int = 64) -> list[Pixels]:
    """Frames with more colours than a palette has, each frame another."""
    v, u = np.mgrid[0:height, 0:width] / np.array([height, width]).reshape(2, 1, 1)
    made = [np.stack([u, v, np.full_like(u, i / count)], axis=-1) for i in range(count)]
    return [np.rint(40 + 170 * frame).astype(np.uint8) for frame in made]


def ignore(_: float) -> None:
    pass


def gif(frames: list[Pixels], dither: str, fps: int = 20) -> list[Pixels]:
    # Frames that come out the same are one that is shown longer.
    with tempfile.TemporaryDirectory() as folder:
        write_gif(Path(folder) / "a.gif", frames, Fraction(fps), dither, ignore)
        data = io.BytesIO((Path(folder) / "a.gif").read_bytes())
    with Image.open(data) as image:
        assert image.info["loop"] == 0
        shown = []
        for i in range(image.n_frames):  # type: ignore[attr-defined]
            image.seek(i)
            shown += [np.asarray(image.convert("RGB"))] * round(image.info["duration"] * fps / 1000)
    return shown


@pytest.mark.parametrize("dither", DITHERS)
def test_a_gif_shows_its_frames(dither: str) -> None:
    frames = smooth(4)
    shown = gif(frames, dither)
    assert len(shown) == 4
    for frame, picture in zip(frames, shown, strict=True):
        assert picture.shape == frame.shape
        assert np.abs(picture.astype(int) - frame).mean() < 14


def test_dithering_keeps_what_areas_look_like() -> None:
    frames = smooth(6)

    def off(dither: str) -> float:
        pairs = zip(frames, gif(frames, dither), strict=True)
        errors = [np.subtract(shown, frame, dtype=float).reshape(6, 8, 8, 8, 3) for frame, shown in pairs]
        return float(np.abs([error.mean(axis=(1, 3)) for error in errors]).mean())

    assert off("diffused") < 0.75 * off("none")


def test_each_pixel_has_the_nearest_colour_of_all() -> None:
    frames = smooth(3)
    shown = gif(frames, "none")
    colors = np.unique(np.concatenate(shown).reshape(-1, 3), axis=0).astype(float)
    for frame, picture in zip(frames, shown, strict=True):
        chosen = np.square(picture.astype(float) - frame).sum(axis=-1)
        best = np.square(frame[:, :, None, :] - colors).sum(axis=-1).min(axis=-1)
        assert np.array_equal(chosen, best)


@pytest.mark.parametrize("dither", DITHERS)
def test_a_background_keeps_its_colour(dither: str) -> None:
    frames = smooth(4)
    for frame in frames:
        frame[:10] = (255, 255, 255)
        frame[10:20] = (3, 5, 7)
    for picture in gif(frames, dither):
        assert np.abs(picture[:10].astype(int) - 255).max() <= (0 if dither == "none" else 8)
        assert np.abs(picture[10:19].astype(int) - (3, 5, 7)).max() <= (0 if dither == "none" else 8)


def test_pictures_of_few_colours_are_exact() -> None:
    frames = [np.full((8, 8, 3), value, np.uint8) for value in (0, 100, 255)]
    assert all(np.array_equal(a, b) for a, b in zip(frames, gif(frames, "none"), strict=True))


def test_what_rests_in_a_picture_rests_in_the_gif() -> None:
    frames = smooth(5)
    for frame in frames:
        frame[:, :32] = frames[0][:, :32]
    shown = gif(frames, "none")
    assert all(np.array_equal(picture[:, :32], shown[0][:, :32]) for picture in shown)


def test_delays_do_not_drift() -> None:
    for fps in (Fraction(30), Fraction(24000, 1001), Fraction(50), Fraction(7)):
        shown = delays(700, fps)
        assert abs(sum(shown) - 700_000 / fps) <= 5
        assert min(shown) >= 20


def read_mp4(path: Path) -> tuple[list[Pixels], Any]:
    with av.open(str(path)) as container:
        stream = container.streams.video[0]
        frames = [frame.to_ndarray(format="rgb24") for frame in container.decode(stream)]
        facts = (stream.codec_context.name, stream.average_rate, stream.pix_fmt, int(stream.codec_context.colorspace))
    return frames, facts


def test_an_mp4_shows_its_frames(tmp_path: Path) -> None:
    frames = smooth(5)
    shares: list[float] = []
    write_mp4(tmp_path / "a.mp4", frames, Fraction(25), "best", shares.append)
    shown, facts = read_mp4(tmp_path / "a.mp4")
    assert facts == ("h264", 25, "yuv420p", 1)
    assert len(shown) == 5
    assert shares == sorted(shares)
    for frame, picture in zip(frames, shown, strict=True):
        assert np.abs(picture.astype(int) - frame).mean() < 3


def test_an_odd_picture_gets_its_last_row_and_column_twice(tmp_path: Path) -> None:
    frames = smooth(2, 31, 45)
    write_mp4(tmp_path / "a.mp4", frames, Fraction(10), "best", ignore)
    shown, _ = read_mp4(tmp_path / "a.mp4")
    assert shown[0].shape == (32, 46, 3)
    assert np.abs(shown[1][:31, :45].astype(int) - frames[1]).mean() < 4


def test_better_movies_are_larger(tmp_path: Path) -> None:
    noise = np.random.default_rng(0).integers(0, 60, (6, 64, 64, 1), np.uint8)
    frames = [np.repeat(frame, 3, axis=2) for frame in noise]
    sizes = []
    for quality in QUALITIES:
        write_mp4(tmp_path / f"{quality}.mp4", frames, Fraction(10), quality, ignore)
        sizes.append((tmp_path / f"{quality}.mp4").stat().st_size)
    assert sizes == sorted(sizes)
    assert sizes[0] < 0.7 * sizes[-1]


def test_without_pyav_the_cure_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(movie, "find_spec", lambda name: None if name == "av" else find_spec(name))
    with pytest.raises(OutputError, match=r"PyAV, which is not installed(.|\n)*pip install(.|\n)*\.gif"):
        target.read_target(tmp_path / "a.mp4")
    assert target.read_target(tmp_path / "a.gif").kind == "gif"


def test_an_encoder_that_fails_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="cannot encode the movie"):
        write_mp4(tmp_path / "none" / "a.mp4", smooth(2), Fraction(10), "good", ignore)


def test_frames_that_do_not_arrive_are_noticed(tmp_path: Path) -> None:
    write_mp4(tmp_path / "a.mp4", smooth(3), Fraction(10), "good", ignore)
    with pytest.raises(OSError, match="3 of 4 frames"):
        movie._check(tmp_path / "a.mp4", 4)
