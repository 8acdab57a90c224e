"""Draws docs/pictures/mesh.png: meshes as they are, triangle by triangle, by a small rasteriser of its own.

Run it in the repository: .venv/bin/python docs/pictures/mesh.py
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import Image

import zeroset as zs

Array = npt.NDArray[Any]
SIZE, SUPER = 420, 3
"""Pixels of a panel's side, and samples along each side of a pixel."""
FRONT, BACK, LINE = np.array([0.93, 0.55, 0.22]), np.array([0.25, 0.45, 0.75]), np.array([0.12, 0.1, 0.1])
LIGHT = np.array([0.35, 0.45, 0.82])


def screen(surface: zs.Surface, points: Array) -> Array:
    """Points in samples of the panel, and their depth, as the surface's own camera sees them."""
    camera = surface.camera
    assert camera is not None
    rays = camera.rays(SIZE, SIZE)
    eye, forward, right, up = (np.array(v) for v in (rays.eye, rays.forward, rays.right, rays.up))
    away = points - eye
    depth = away @ forward / (forward @ forward)
    u = away @ right / (right @ right) / depth
    v = away @ up / (up @ up) / depth
    half = 0.5 * SIZE * SUPER
    return np.stack([half * (1 + u), half * (1 - v), depth], axis=1)


def panel(name: str, resolution: int, lines: float, smooth: bool) -> Array:
    """One mesh; ``lines`` is half the width of its edges in samples."""
    surface = zs.gallery[name]
    mesh = zs.mesh(surface, resolution)
    assert surface.camera is not None
    rays = surface.camera.rays(SIZE, SIZE)
    towards = np.stack([np.array(v) / np.linalg.norm(v) for v in (rays.right, rays.up, -np.array(rays.forward))])
    flat = screen(surface, mesh.vertices.astype(np.float64))
    side = SIZE * SUPER
    picture, nearest = np.ones((side, side, 3)), np.full((side, side), np.inf)
    for face in mesh.faces:
        draw(picture, nearest, flat[face], mesh.normals[face] @ towards.T, lines, smooth)
    return picture.reshape(SIZE, SUPER, SIZE, SUPER, 3).mean(axis=(1, 3))


def draw(picture: Array, nearest: Array, corners: Array, normals: Array, lines: float, smooth: bool) -> None:
    """Put one triangle into the picture where nothing is in front of it."""
    low = np.maximum(np.floor(corners[:, :2].min(axis=0)).astype(int), 0)
    high = np.minimum(np.ceil(corners[:, :2].max(axis=0)).astype(int) + 1, len(picture))
    (ax, ay), (bx, by), (cx, cy) = corners[:, :2]
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    if area == 0 or np.any(high <= low):
        return
    x, y = np.meshgrid(np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1]) + 0.5)
    b = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area
    c = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area
    weights = np.stack([1 - b - c, b, c], axis=-1)
    depth = weights @ corners[:, 2]
    window = (slice(low[1], high[1]), slice(low[0], high[0]))
    seen = (weights.min(axis=-1) >= 0) & (depth < nearest[window])
    if not seen.any():
        return
    normal = weights[seen] @ normals if smooth else np.broadcast_to(normals.mean(axis=0), (int(seen.sum()), 3))
    normal = normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-9)
    # The screen's y axis goes down: a triangle that turns left there has a negative area.
    base = FRONT if area < 0 else BACK
    shade = 0.3 + 0.7 * np.abs(normal @ LIGHT)[:, None]
    colour = base * shade
    sides = np.linalg.norm(np.roll(corners, -1, axis=0)[:, :2] - np.roll(corners, 1, axis=0)[:, :2], axis=1)
    from_edge = (weights[seen] * (abs(area) / np.maximum(sides, 1e-9))).min(axis=1)
    colour[from_edge < lines] = LINE
    picture[window][seen] = colour
    nearest[window][seen] = depth[seen]


def main() -> None:
    """Draw the three panels side by side."""
    panels = [panel("tangle", 20, 0.9, False), panel("clebsch", 24, 0.9, False), panel("barth-sextic", 128, 0.0, True)]
    pixels = np.concatenate(panels, axis=1)
    encoded = np.where(pixels <= 0.0031308, 12.92 * pixels, 1.055 * pixels ** (1 / 2.4) - 0.055)
    path = Path(__file__).with_name("mesh.png")
    Image.fromarray((255 * np.clip(encoded, 0, 1) + 0.5).astype(np.uint8)).save(path, optimize=True)


if __name__ == "__main__":
    main()
