"""A panel is drawn: rays, or a mesh's triangles, then what is cut out of it or written onto it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from zeroset.figures.entry import Panel
from zeroset.figures.raster import draw_mesh
from zeroset.figures.subject import method_of, scene_of, tolerance_of
from zeroset.rendering.image import Image
from zeroset.rendering.render import render
from zeroset.runtime import Device

Pixels = npt.NDArray[np.uint8]
Progress = Callable[[float], None]
Size = tuple[int, int]
APART = 1e-3
"""Share of the distance from the eye by which a place may differ and still be the same."""
OPTIONS = ("antialias", "depth", "thin", "draft", "beams")
"""Settings that ``render`` takes as they are."""


def draw_panel(panel: Panel, size: Size, device: Device, progress: Progress | None = None) -> tuple[Pixels, str]:
    """A panel's pixels, and what stands under it.

    Args:
        panel: of a figure.
        size: its width and height in pixels.
        device: where to draw.
        progress: told the share that is done.

    Returns:
        (height, width, 3) sRGB, and the label with its numbers filled in.
    """
    settings = panel.settings
    if "mesh" in settings:
        return draw_mesh(scene_of(settings), settings["mesh"], size[0], device), panel.label
    image = _image(settings, size, device, progress)
    pixels = image.legend() if settings.get("legend") else image.pixels
    label = _filled(panel.label, image, lambda: _truth(settings, size, device))
    return (magnified(pixels, settings["crop"]) if "crop" in settings else pixels), label


def _filled(label: str, image: Image, truth: Callable[[], Image]) -> str:
    """A label with the numbers that it asks for."""
    numbers: dict[str, str] = {}
    if "{steps}" in label:
        numbers["steps"] = f"{image.aov('steps').mean():.1f}"
    if "{open}" in label:
        numbers["open"] = f"{100.0 * image.unresolved / max(image.hits, 1):.0f}%"
    if "{wrong}" in label:
        numbers["wrong"] = str(wrong_pixels(image, truth()))
    return label.format(**numbers) if numbers else label


def wrong_pixels(image: Image, truth: Image) -> int:
    """How many pixels show another place than a certified picture, or a place where it shows none, or none."""
    found, known = image.aov("t"), truth.aov("t")
    both = ~(np.isnan(found) | np.isnan(known))
    apart = np.abs(np.where(both, found - known, 0.0)) > APART * np.abs(np.where(both, known, 1.0))
    return int(np.count_nonzero(apart | (np.isnan(found) != np.isnan(known))))


def _truth(settings: Mapping[str, Any], size: Size, device: Device) -> Image:
    return render(scene_of(settings), size, device=device, thin=False)


def _image(settings: Mapping[str, Any], size: Size, device: Device, progress: Progress | None) -> Image:
    scene = scene_of(settings)
    return render(
        scene,
        size,
        method=method_of(settings),
        device=device,
        tolerance=tolerance_of(settings, scene.surface),
        progress=progress,
        **{key: settings[key] for key in OPTIONS if key in settings},
    )


def magnified(pixels: Pixels, crop: tuple[float, float, float]) -> Pixels:
    """A square part of a square picture, as large as the whole, pixels staying squares.

    Args:
        pixels: (n, n, 3).
        crop: left, top and width of the part, each as a share of the side.

    Returns:
        (n, n, 3).

    Example:
        >>> magnified(np.arange(12, dtype=np.uint8).reshape(2, 2, 3), (0.5, 0.0, 0.5))[1, 1].tolist()
        [3, 4, 5]
    """
    size = len(pixels)
    left, top, width = crop
    places = (np.arange(size) + 0.5) / size * width * size
    columns, rows = ((places + start * size).astype(int).clip(0, size - 1) for start in (left, top))
    return np.ascontiguousarray(pixels[rows[:, None], columns])
