"""surf (Debian: surf-alggeo): scripts that draw a polynomial as zeroset does.

surf's spectator sits on its z axis and looks at a picture of 20 by 20 units in the plane z = 0. So the script writes
the surface in coordinates of the camera, scaled to fill that picture, and leaves expanding it to surf.
"""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
from scenes import ONE_LIGHT, Case

import zeroset as zs

HALF = 10.0
"""Units from the middle of surf's picture to its edge."""
FAR = 1000.0
"""Units to the light, which surf wants somewhere."""


def script(case: Case, size: int, picture: Path) -> str | None:
    """The script that writes a picture; None for what is no polynomial."""
    surface = case.surface
    if surface.field.degree is None:
        return None
    camera = case.camera
    axes = camera_axes(camera)
    distance = math.dist(camera.eye, camera.target)
    unit = distance * math.tan(math.radians(camera.fov or 0.0) / 2) / HALF
    names = ("u", "v", "w")
    lines = [f"width={size};", f"height={size};", "perspective=central;", f"spec_z={distance / unit:.9g};"]
    lines += ["clip=sphere;", f"radius={case.bounding_radius / unit:.9g};", "double phi=(1+sqrt(5))/2;"]
    for i, name in enumerate(names):
        lines.append(
            f"poly {name}=" + "".join(f"+({axes[j][i] * unit:.17g})*{axis}" for j, axis in enumerate("xyz")) + ";"
        )
    formula = re.sub(r"\b[xyz]\b", lambda found: names["xyz".index(found[0])], surface.formula)
    lines += [f"surface={formula};", *_light(), "draw_surface;"]
    lines += [f'filename="{picture}";', "color_file_format=ppm;", "save_color_image;"]
    return "\n".join(lines) + "\n"


def camera_axes(camera: zs.Camera) -> list[list[float]]:
    """The camera's right, up and backward directions."""
    back = np.subtract(camera.eye, camera.target) / math.dist(camera.eye, camera.target)
    right = np.cross(camera.up, back)
    right /= np.linalg.norm(right)
    return [right.tolist(), np.cross(back, right).tolist(), back.tolist()]


def _light() -> list[str]:
    material = zs.Material()
    lines = ["background_red=255;", "background_green=255;", "background_blue=255;", "light1_vol=100;"]
    lines += [f"light1_{axis}={value * FAR:.9g};" for axis, value in zip("xyz", ONE_LIGHT[0].direction, strict=True)]
    for side, color in (("surface", material.front), ("inside", material.back)):
        lines += [f"{side}_{c}={round(255 * v)};" for c, v in zip(("red", "green", "blue"), color, strict=True)]
    return lines
