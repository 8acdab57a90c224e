"""POV-Ray: scenes that draw a surface as zeroset does, as a polynomial or as an isosurface.

No antialiasing, no shadows, one light, one thread. Tolerances are POV-Ray's defaults.
"""

from __future__ import annotations

import numpy as np
from scenes import ONE_LIGHT, Case
from surf import camera_axes

from zeroset.expr import enclose, polynomial

LOOK = "pigment { rgb <.95,.52,.12> } finish { ambient .12 diffuse .8 specular .35 }"


def polynomial_scene(case: Case) -> str | None:
    """The scene with POV-Ray's own polynomial; None for what is none."""
    view = polynomial(case.surface.field.expr) if case.surface.field.degree is not None else None
    if view is None:
        return None
    terms = ",\n".join(
        f"xyz({i},{j},{k}): {sum(enclose(c)) / 2:.17g}" for (i, j, k), c in sorted(view.coefficients.items())
    )
    ball = f"sphere {{ 0, {case.bounding_radius:.9g} }}"
    clipping = f"clipped_by {{ {ball} }} bounded_by {{ clipped_by }}"
    return _stage(case) + f"polynomial {{ {view.degree},\n{terms}\n{clipping} {LOOK} }}\n"


def isosurface_scene(case: Case) -> str:
    """The scene with POV-Ray's isosurface."""
    body = case.isosurface(case.surface)
    region = case.container or f"sphere {{ 0, {case.bounding_radius:.9g} }}"
    shape = f"isosurface {{ function {{ {body} }}\ncontained_by {{ {region} }} open "
    shape += f"max_gradient {case.max_gradient:g} {LOOK} }}\n"
    return _stage(case) + case.declarations + shape


def _stage(case: Case) -> str:
    camera = case.camera
    light = np.asarray(ONE_LIGHT[0].direction) @ np.asarray(camera_axes(camera)) * 1000.0
    return (
        "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\nbackground { rgb 1 }\n"
        # POV-Ray is left-handed: its pictures are mirrored unless x points to the left.
        f"camera {{ location {_vector(camera.eye)} sky {_vector(camera.up)} up y right -x angle {camera.fov:g} "
        f"look_at {_vector(camera.target)} }}\n"
        f"light_source {{ {_vector(light)} rgb 1 parallel point_at 0 shadowless }}\n"
    )


def _vector(values: object) -> str:
    return "<" + ",".join(f"{v:.9g}" for v in np.asarray(values, np.float64)) + ">"
