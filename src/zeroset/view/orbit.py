"""Camera control: turning, panning, zooming, flying, and the way between pixels and points. Pure functions.

Everything holds for perspective and orthographic cameras alike, since both are one affine map (``scene.camera``). Pixel
positions are counted from the upper left corner of the picture: (0.5, 0.5) is the middle of the first pixel.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from zeroset.scene.bounds import Bounds, Vector
from zeroset.scene.camera import Camera, Rays

Array = npt.NDArray[np.float64]

STEEPEST = math.radians(89.95)
"""How near to straight up or down an orbit comes: there the picture's "up" would be lost."""
AXES: dict[str, Vector] = {
    "1": (0.0, -1.0, 0.0),
    "2": (0.0, 1.0, 0.0),
    "3": (1.0, 0.0, 0.0),
    "4": (-1.0, 0.0, 0.0),
    "5": (0.0, 0.0, 1.0),
    "6": (0.0, 0.0, -1.0),
    "7": (0.45, -0.82, 0.36),
}
"""Keys, and the side from which they look: front, back, right, left, top, bottom, three-quarter."""


def _array(vector: Vector) -> Array:
    return np.asarray(vector, np.float64)


def _vector(array: Array) -> Vector:
    x, y, z = (float(v) for v in array)
    return x, y, z


def _unit(array: Array) -> Array:
    return array / np.linalg.norm(array)


def frame(camera: Camera) -> tuple[Array, Array, Array]:
    """The camera's right, up and forward, each of length 1."""
    rays = camera.rays(1, 1)
    right = _unit(_array(rays.right) + _array(rays.right_origin))
    up = _unit(_array(rays.up) + _array(rays.up_origin))
    return right, up, _array(rays.forward)


def distance(camera: Camera) -> float:
    """From the eye to the target."""
    return math.dist(camera.eye, camera.target)


def _rotated(vector: Array, axis: Array, angle: float) -> Array:
    """A vector turned around an axis of length 1 (Rodrigues)."""
    cosine, sine = math.cos(angle), math.sin(angle)
    turned = vector * cosine + np.cross(axis, vector) * sine + axis * np.dot(axis, vector) * (1.0 - cosine)
    return np.asarray(turned, np.float64)


def _swung(direction: Array, camera: Camera, yaw: float, pitch: float) -> Array:
    """A direction turned by angles in radians about the camera's up, and towards it, short of the poles."""
    up = _unit(_array(camera.up))
    length = float(np.linalg.norm(direction))
    climb = math.asin(max(-1.0, min(1.0, float(np.dot(direction, up)) / length)))
    level = direction - np.dot(direction, up) * up
    if np.linalg.norm(level) < 1e-9 * length:
        level = frame(camera)[1]
    level = _rotated(_unit(level), up, yaw)
    climb = max(-STEEPEST, min(STEEPEST, climb + pitch))
    return length * (math.cos(climb) * level + math.sin(climb) * up)


def turn(camera: Camera, degrees: float, elevation: float = 0.0) -> Camera:
    """The camera led around its target: about "up", and up.

    Example:
        >>> turned = turn(Camera(eye=(0, -4, 0)), 90)
        >>> [round(v, 9) + 0.0 for v in turned.eye]
        [4.0, 0.0, 0.0]
    """
    offset = _array(camera.eye) - _array(camera.target)
    offset = _swung(offset, camera, math.radians(degrees), math.radians(elevation))
    return replace(camera, eye=_vector(_array(camera.target) + offset))


def look(camera: Camera, degrees: float, elevation: float = 0.0) -> Camera:
    """The camera turned on the spot, as a head turns."""
    offset = _array(camera.target) - _array(camera.eye)
    offset = _swung(offset, camera, math.radians(degrees), math.radians(elevation))
    return replace(camera, target=_vector(_array(camera.eye) + offset))


def shift(camera: Camera, offset: Array) -> Camera:
    """Eye and target moved by the same world vector."""
    return replace(camera, eye=_vector(_array(camera.eye) + offset), target=_vector(_array(camera.target) + offset))


def walk(camera: Camera, forward: float, right: float, up: float) -> Camera:
    """The camera moved by world lengths along its own axes."""
    x, y, z = frame(camera)
    return shift(camera, right * x + up * y + forward * z)


def pan(camera: Camera, size: tuple[float, float], dx: float, dy: float, depth: float) -> Camera:
    """The camera moved so that what lies at ``depth`` follows the pointer by (dx, dy) pixels."""
    rays = camera.rays(1, 1)
    # With a square frame the vectors span half the shorter side.
    length = 2.0 * float(np.linalg.norm(_array(rays.right) * depth + _array(rays.right_origin)))
    pixel = length / min(size)
    x, y, _ = frame(camera)
    return shift(camera, (-dx * x + dy * y) * pixel)


def zoom(camera: Camera, factor: float, point: Vector) -> Camera:
    """The view enlarged by ``1 / factor`` about a point, which stays where it is in the picture.

    Example:
        >>> zoom(Camera(eye=(0, -4, 0)), 0.5, (0, 0, 0)).eye
        (0.0, -2.0, 0.0)
    """
    if camera.height is None:
        nearer = [_array(point) + (_array(v) - _array(point)) * factor for v in (camera.eye, camera.target)]
        return replace(camera, eye=_vector(nearer[0]), target=_vector(nearer[1]))
    # An orthographic eye keeps its distance: it must stay outside of what it looks at.
    *_, forward = frame(camera)
    offset = _array(point) - _array(camera.target)
    sideways = (offset - np.dot(offset, forward) * forward) * (1.0 - factor)
    return replace(shift(camera, sideways), height=camera.height * factor)


def aim(camera: Camera, point: Vector) -> Camera:
    """The camera with its target, about which it orbits, at a point; the eye stays unless it is there itself."""
    return camera if math.dist(camera.eye, point) < 1e-9 * distance(camera) else replace(camera, target=point)


def fit(camera: Camera, bounds: Bounds) -> Camera:
    """The camera from the same side, at the distance from which the bounds fill the picture."""
    *_, forward = frame(camera)
    if camera.height is not None:
        far = max(distance(camera), 3.0 * bounds.reach)
        eye = _array(bounds.center) - forward * far
        return replace(camera, eye=_vector(eye), target=bounds.center, height=2.04 * bounds.reach)
    far = 1.02 * bounds.reach / math.sin(math.radians(min(camera.fov or 35.0, 150.0)) / 2)
    return replace(camera, eye=_vector(_array(bounds.center) - forward * far), target=bounds.center)


def refitted(camera: Camera, before: Bounds, after: Bounds) -> Camera:
    """The camera that sees new bounds as it saw the old ones."""
    scale = after.reach / before.reach
    eye, target = (
        _vector(_array(after.center) + (_array(v) - _array(before.center)) * scale) for v in (camera.eye, camera.target)
    )
    height = None if camera.height is None else camera.height * scale
    return replace(camera, eye=eye, target=target, height=height)


def along(camera: Camera, side: Vector) -> Camera:
    """The camera that looks at its target from another side."""
    direction, up = _unit(_array(side)), _unit(_array(camera.up))
    offset = direction * distance(camera)
    if abs(float(np.dot(direction, up))) > math.sin(STEEPEST):
        # From straight above, "up" in the picture is what lies behind from the front.
        behind = np.array((0.0, 1.0, 0.0)) if abs(up[1]) < 0.9 else np.array((0.0, 0.0, -1.0))
        sign = math.copysign(1.0, float(np.dot(direction, up)))
        tilt = sign * math.sin(STEEPEST) * up - math.cos(STEEPEST) * behind
        offset = tilt * distance(camera)
    return replace(camera, eye=_vector(_array(camera.target) + offset))


def orthographic(camera: Camera) -> Camera:
    """The orthographic camera that shows its target as large."""
    if camera.height is not None:
        return camera
    height = 2.0 * distance(camera) * math.tan(math.radians(camera.fov or 0.0) / 2)
    return replace(camera, fov=None, height=height)


def perspective(camera: Camera, fov: float) -> Camera:
    """The perspective camera of that opening that shows its target as large as this one."""
    spanned = orthographic(camera).height or 1.0
    far = 0.5 * spanned / math.tan(math.radians(fov) / 2)
    *_, forward = frame(camera)
    return replace(camera, fov=fov, height=None, eye=_vector(_array(camera.target) - far * forward))


def _frame_coordinates(size: tuple[float, float], x: float, y: float) -> tuple[float, float]:
    scale = 2.0 / max(size)
    return (x - 0.5 * size[0]) * scale, (0.5 * size[1] - y) * scale


def _rays(camera: Camera, size: tuple[float, float]) -> Rays:
    """The camera's affine map for a picture whose sides need not be whole."""
    # The map depends on the ratio of the sides alone; thousandths of a pixel are whole numbers.
    return camera.rays(max(1, round(size[0] * 1000)), max(1, round(size[1] * 1000)))


def unproject(camera: Camera, size: tuple[float, float], x: float, y: float, depth: float) -> Vector:
    """The point that is seen at a place of the picture, at a depth along the viewing direction."""
    rays = _rays(camera, size)
    u, v = _frame_coordinates(size, x, y)
    origin = _array(rays.eye) + u * _array(rays.right_origin) + v * _array(rays.up_origin)
    direction = _array(rays.forward) + u * _array(rays.right) + v * _array(rays.up)
    return _vector(origin + depth * direction)


def project(camera: Camera, size: tuple[float, float], points: Array) -> tuple[Array, Array]:
    """Where points, (N, 3), are seen: pixel positions, (N, 2), and depths along the viewing direction, (N,)."""
    rays = _rays(camera, size)
    offset = np.asarray(points, np.float64) - _array(rays.eye)
    depth = offset @ _array(rays.forward)
    across, upwards = (_array(p) + _array(q) for p, q in ((rays.right, rays.right_origin), (rays.up, rays.up_origin)))
    divisor = np.where(depth > 1e-12, depth, np.nan) if camera.height is None else np.ones_like(depth)
    u = offset @ across / np.dot(across, across) / divisor
    v = offset @ upwards / np.dot(upwards, upwards) / divisor
    half = 0.5 * max(size)
    return np.stack([0.5 * size[0] + u * half, 0.5 * size[1] - v * half], axis=-1), depth
