"""The camera: from pixel coordinates to rays, perspective and orthographic alike.

Both kinds are one affine map. With u, v in [-1, 1] across the longer side of the frame (v upwards), a ray's origin is
``eye + u*right_origin + v*up_origin`` and its direction ``forward + u*right + v*up``; a perspective camera has zero
origin vectors and an orthographic one has zero direction vectors. So one kernel serves both, and beams are affine in
u and v.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from zeroset.errors import CameraError
from zeroset.scene.bounds import LARGEST, SMALLEST, Bounds, Vector, number, vector

NARROWEST = 1e-3
"""Least opening angle, and how far it stays below 180 degrees."""


class Rays(NamedTuple):
    """The six vectors of a camera's affine map, in world units; see the module's text."""

    eye: Vector
    right_origin: Vector
    up_origin: Vector
    forward: Vector
    right: Vector
    up: Vector


@dataclass(frozen=True, slots=True)
class Camera:
    """A view of a surface.

    Attributes:
        eye: where the camera is.
        target: what it looks at; lands in the middle of the frame.
        up: the direction that is upwards in the frame.
        fov: opening angle in degrees across the frame's shorter side, below 180; None for an orthographic camera.
        height: world length across the shorter side of an orthographic camera's frame.

    Example:
        >>> Camera(eye=(0, -5, 2)).target
        (0.0, 0.0, 0.0)
    """

    eye: Vector = (3.0, -5.0, 2.4)
    target: Vector = (0.0, 0.0, 0.0)
    up: Vector = (0.0, 0.0, 1.0)
    fov: float | None = 35.0
    height: float | None = None

    def __post_init__(self) -> None:
        for name in ("eye", "target", "up"):
            object.__setattr__(self, name, vector(getattr(self, name), f"the camera's {name}", CameraError))
        if self.height is not None:
            object.__setattr__(self, "fov", None)
            object.__setattr__(self, "height", number(self.height, "the camera's height", CameraError))
            if not SMALLEST <= self.height < LARGEST:
                raise CameraError(f"the camera's height must be from {SMALLEST:g} to {LARGEST:g}, not {self.height!r}")
        elif self.fov is None:
            raise CameraError("a camera needs a fov (perspective) or a height (orthographic)")
        else:
            object.__setattr__(self, "fov", number(self.fov, "the camera's fov", CameraError))
            if not NARROWEST <= self.fov <= 180 - NARROWEST:
                raise CameraError(f"the camera's fov must be between 0 and 180 degrees, not {self.fov!r}")
        if math.dist(self.eye, self.target) < SMALLEST:
            raise CameraError("the camera looks at its own place: move eye away from target")
        if math.hypot(*self.up) < SMALLEST:
            raise CameraError("the camera's up must not be zero", hint="try up=(0, 0, 1)")

    def rays(self, width: int, height: int) -> Rays:
        """The affine map from frame coordinates to rays for a frame of that many pixels."""
        eye, target, up = (np.asarray(v, np.float64) for v in (self.eye, self.target, self.up))
        forward = target - eye
        forward /= np.linalg.norm(forward)
        right = np.cross(forward, up)
        if np.linalg.norm(right) <= 1e-9 * np.linalg.norm(up):
            # Looking straight along up: any sideways direction will do.
            right = np.cross(forward, (0.0, 1.0, 0.0) if abs(forward[1]) < 0.9 else (1.0, 0.0, 0.0))
        right /= np.linalg.norm(right)
        upward = np.cross(right, forward)
        half = 0.5 * self.height if self.height is not None else math.tan(math.radians(self.fov or 0.0) / 2)
        # u and v run over [-1, 1] along the longer side, so the shorter one spans what fov or height says.
        scale = half * max(width, height) / min(width, height)
        zero = (0.0, 0.0, 0.0)
        across, upwards = _vector(right * scale), _vector(upward * scale)
        if self.height is not None:
            return Rays(_vector(eye), across, upwards, _vector(forward), zero, zero)
        return Rays(_vector(eye), zero, zero, _vector(forward), across, upwards)

    def orbit(self, degrees: float, elevation: float = 0.0) -> Camera:
        """The camera turned around its target: ``degrees`` about z, then ``elevation`` degrees up.

        Raises:
            CameraError: an angle is not finite.
        """
        turn = math.radians(number(degrees, "the orbit's angle", CameraError))
        climb = math.radians(number(elevation, "the orbit's elevation", CameraError))
        offset = np.asarray(self.eye) - np.asarray(self.target)
        radius = float(np.linalg.norm(offset))
        azimuth = math.atan2(offset[1], offset[0]) + turn
        polar = math.asin(max(-1.0, min(1.0, offset[2] / radius))) + climb
        polar = max(-math.pi / 2 + 1e-6, min(math.pi / 2 - 1e-6, polar))
        turned = (math.cos(polar) * math.cos(azimuth), math.cos(polar) * math.sin(azimuth), math.sin(polar))
        eye = np.asarray(self.target) + radius * np.asarray(turned)
        # Up turns along: seen from straight above, the picture itself is what turns.
        x, y, z = self.up
        up = (x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn), z)
        return replace(self, eye=_vector(eye), up=up)


def _vector(array: Any) -> Vector:
    x, y, z = (float(v) for v in array)
    return x, y, z


def fit_camera(bounds: Bounds, fov: float = 35.0) -> Camera:
    """A camera that sees the whole of the bounds from a three-quarter view, a little from above."""
    direction = np.array((0.45, -0.82, 0.36))
    direction /= np.linalg.norm(direction)
    distance = 1.02 * bounds.reach / math.sin(math.radians(fov) / 2)
    center = np.asarray(bounds.center)
    return Camera(eye=_vector(center + distance * direction), target=bounds.center, fov=fov)


def parse_camera(value: Any, bounds: Bounds) -> Camera:
    """A camera from what users write: a Camera, a mapping with its fields, or None for one that fits the bounds."""
    if value is None:
        return fit_camera(bounds)
    if isinstance(value, Camera):
        return value
    if isinstance(value, Mapping):
        unknown = set(value) - {"eye", "target", "up", "fov", "height"}
        if unknown:
            raise CameraError(f"a camera has no {min(map(str, unknown))!r}: it has eye, target, up, fov and height")
        return Camera(**value)
    raise CameraError(f"a camera must be a Camera or a mapping, not {value!r}")


VECTORS = ("eye", "right_origin", "up_origin", "forward", "right", "up")


def camera_uniforms(rays: Rays) -> dict[str, float]:
    """The camera's numbers by uniform name."""
    return {
        f"{name}_{axis}": vector[i] for name, vector in zip(VECTORS, rays, strict=True) for i, axis in enumerate("xyz")
    }
