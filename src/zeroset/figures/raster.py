"""A mesh as a picture, for figures that show what triangles make of a surface.

Triangles are put into a G-buffer of depth and interpolated normals; its pixels are then shaded by the same
kernel that shades rays, so that what differs in the picture is the geometry alone.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from zeroset.export.mesh import mesh
from zeroset.export.triangles import Mesh
from zeroset.kernel.types import F32, U32
from zeroset.rendering.buffers import NORMAL, PICTURE
from zeroset.rendering.layout import Layout
from zeroset.rendering.shade import shade_kernel
from zeroset.rendering.shading import Lighting, Smooth, shading_uniforms
from zeroset.runtime import Device
from zeroset.scene.camera import Rays, camera_uniforms, parse_camera
from zeroset.scene.scene import Scene
from zeroset.solve.status import HIT

Array = npt.NDArray[Any]
AT_ONCE = 1 << 19
"""Pixels of triangles that are looked at together."""


def draw_mesh(scene: Scene, resolution: int, size: int, device: Device) -> npt.NDArray[np.uint8]:
    """The mesh of a scene's surface, as the scene's camera sees it.

    Args:
        scene: what is shown; without shadows and surroundings.
        resolution: cells along the mesh's longest side.
        size: pixels of the picture's side.
        device: where the mesh is found and shaded.

    Returns:
        (size, size, 3), sRGB.
    """
    view = parse_camera(scene.camera, scene.surface.fitted)
    rays, layout = view.rays(size, size), Layout(size, size)
    normals, seen = rasterised(mesh(scene, resolution, device=device), rays, size)
    lighting = Lighting.of(scene, Smooth())
    uniforms = camera_uniforms(rays) | layout.uniforms()
    uniforms |= shading_uniforms(scene.material, scene.lights, scene.background, rays)
    rows = {name: normals[..., i].astype(np.float32) for i, name in enumerate(NORMAL)}
    rows["status"] = np.where(seen, HIT, 0).astype(np.uint32)
    lanes = layout.unscramble(np.arange(layout.lanes))
    buffers = {PICTURE: device.allocate(U32, size * size)}
    for name, values in rows.items():
        tiled = np.zeros(layout.lanes, values.dtype)
        tiled[lanes] = values
        buffers[name] = device.allocate(U32 if name == "status" else F32, layout.lanes)
        device.write(buffers[name], tiled)
    device.compile(shade_kernel(lighting)).run(layout.lanes, uniforms, buffers)
    packed = device.read(buffers[PICTURE]).copy()
    return packed.view(np.uint8).reshape(size, size, 4)[..., :3].copy()


def rasterised(triangles: Mesh, rays: Rays, size: int) -> tuple[Array, npt.NDArray[np.bool_]]:
    """The nearest triangle's normal at each pixel of a square perspective picture, and where there is one.

    Returns:
        (size, size, 3) unit normals, zero where nothing is; (size, size) where something is.
    """
    flat = _on_screen(triangles.vertices.astype(np.float64), rays, size)[triangles.faces]
    first, past = _windows(flat, size)
    spans = np.maximum(past - first, 0)
    counts = spans[:, 0] * spans[:, 1]
    ends = np.cumsum(counts)
    normals, nearest = np.zeros((size * size, 3)), np.full(size * size, np.inf)
    start = 0
    while start < len(flat):
        done = int(ends[start - 1]) if start else 0
        stop = max(int(np.searchsorted(ends, done + AT_ONCE, "right")), start + 1)
        faces = np.repeat(np.arange(start, stop), counts[start:stop])
        # Which pixel of its triangle's window each of them is.
        order = np.arange(len(faces)) - np.repeat(ends[start:stop] - counts[start:stop] - done, counts[start:stop])
        column = first[faces, 0] + order % np.maximum(spans[faces, 0], 1)
        row = first[faces, 1] + order // np.maximum(spans[faces, 0], 1)
        _put(triangles, flat, faces, column, row, normals, nearest)
        start = stop
    lengths = np.linalg.norm(normals, axis=-1, keepdims=True)
    np.divide(normals, lengths, out=normals, where=lengths > 0)
    return normals.reshape(size, size, 3), np.isfinite(nearest).reshape(size, size)


def _on_screen(points: Array, rays: Rays, size: int) -> Array:
    """Places in pixels from the upper left corner, and depth along the view, of points in front of the eye."""
    eye, forward, right, up = (np.array(v) for v in (rays.eye, rays.forward, rays.right, rays.up))
    away = points - eye
    depth = away @ forward
    u, v = (away @ axis / (axis @ axis) / depth for axis in (right, up))
    half = 0.5 * size
    return np.stack([half * (1 + u), half * (1 - v), depth], axis=1)


def _windows(flat: Array, size: int) -> tuple[Array, Array]:
    """For each triangle the first column and row whose middle it can hold, and those past the last; (n, 2) each."""
    first = np.clip(np.ceil(flat[..., :2].min(axis=1) - 0.5).astype(int), 0, size)
    past = np.clip(np.floor(flat[..., :2].max(axis=1) - 0.5).astype(int) + 1, 0, size)
    return first, past


def _put(triangles: Mesh, flat: Array, faces: Array, column: Array, row: Array, normals: Array, nearest: Array) -> None:
    """Put pixels of triangles where nothing is in front of them.

    What perspective does inside a triangle is too little to be seen in triangles of a few pixels.
    """
    (ax, ay, _), (bx, by, _), (cx, cy, _) = (flat[faces, i].T for i in range(3))
    x, y = column + 0.5, row + 0.5
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    scale = np.divide(1.0, area, out=np.full_like(area, np.nan), where=area != 0)
    b = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) * scale
    c = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) * scale
    weights = np.stack([1 - b - c, b, c], axis=-1)
    depth = np.einsum("ij,ij->i", weights, flat[faces, :, 2])
    pixel = row * math.isqrt(len(nearest)) + column
    # A pixel on an edge belongs to both triangles there: a hair beyond leaves no gap.
    seen = (weights.min(axis=-1) >= -1e-9) & (depth < nearest[pixel])
    # The nearest one of a pixel is written last.
    kept = np.flatnonzero(seen)[np.argsort(-depth[seen], kind="stable")]
    nearest[pixel[kept]] = depth[kept]
    corners = triangles.normals[triangles.faces[faces[kept]]]
    normals[pixel[kept]] = np.einsum("ij,ijk->ik", weights[kept], corners)
