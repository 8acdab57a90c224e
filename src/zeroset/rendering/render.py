"""``render``: a surface becomes a picture."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from zeroset.errors import ParameterError, ZerosetError
from zeroset.rendering.bands import Assembled, bands, fits
from zeroset.rendering.drawn import Drawn, as_drawn
from zeroset.rendering.frame import GBuffer, Progress, frame_for, part_of
from zeroset.rendering.image import Image
from zeroset.rendering.layout import TILE, Layout
from zeroset.rendering.materials import opaque_parts
from zeroset.rendering.shading import Illumination, Lighting, Smooth, shading_uniforms
from zeroset.runtime import Device, get_device
from zeroset.scene.bounds import SMALLEST, Bounds, number
from zeroset.scene.camera import Camera, Rays, camera_uniforms, parse_camera
from zeroset.scene.light import Color, Light, Material
from zeroset.scene.scene import Scene, Shown, as_scene
from zeroset.scene.surface import Surface
from zeroset.solve import Method, resolve_method
from zeroset.solve.names import OPAQUE

if TYPE_CHECKING:
    from zeroset.rendering.tint import Palette, Tint
    from zeroset.scene.colored import Colored
    from zeroset.scene.coloring import Coloring
    from zeroset.scene.environment import Environment

LARGEST = 16384
"""Pixels along a side."""
PREVIEW = 512
"""Longer side of the picture that tells the range of colours where a picture is drawn in bands."""
MOST_PIXELS = 1 << 26
"""Pixels in all: 48 bytes of memory each."""


def default_tolerance(bounds: Bounds) -> float:
    """World length to which a root is found: 2^-14 of the bounds' extent, a small part of a pixel."""
    return bounds.extent * 2.0**-14


def render(
    surface: Shown,
    size: tuple[int, int] | int = (1024, 1024),
    camera: Camera | None = None,
    method: str | Method = "auto",
    device: str | Device = "auto",
    tolerance: float | None = None,
    material: Material | None = None,
    lights: Sequence[Light] | None = None,
    background: Color | None = None,
    thin: bool = True,
    draft: bool = False,
    shadows: bool | None = None,
    shadow_tolerance: float | None = None,
    environment: Environment | str | None = None,
    depth: int | None = None,
    antialias: int = 1,
    samples: int = 1,
    progress: Progress | None = None,
    color_by: Coloring | str | None = None,
    beams: bool = True,
) -> Image:
    """Draw a surface.

    Args:
        surface: a Surface, a Solid, a sequence of both, a Scene, or a formula as text.
        size: width and height in pixels; one number for a square.
        camera: None takes the scene's or the surface's own, or one that fits the bounds.
        method: ``"auto"`` or another name of ``zs.methods``, or an instance with options.
        device: ``"auto"``, ``"cpu"``, ``"interp"``, or a Device.
        tolerance: world length to which roots are found; None takes 2^-14 of the (smallest) bounds' extent.
        material: colours and reflectance.
        lights: where the light comes from; None takes two headlights.
        background: linear RGB.
        thin: also draw what is thinner than a pixel and lies between the rays, down to lines and points without any
            thickness, as UNRESOLVED; certified methods only.
        draft: leave out thin parts, and second looks at what f32 left unresolved: the picture of a window that moves.
            It does not wait for beams that are still being compiled, so what it leaves unresolved depends on when.
        shadows: whether the lights throw shadows; None takes the scene's own.
        shadow_tolerance: world length to which shadows are found; None takes 2^-11 of the bounds' extent.
        environment: what is seen all around; None takes the scene's own.
        depth: how many surfaces a ray may meet after the first one, 0 to 32; None takes 6 where surfaces mirror or
            bend light, and 3 (four layers in all) where it only passes through.
        antialias: rays of each pixel at a silhouette, a crease or another edge, 1 to 256; 16 makes them smooth.
        samples: rays of every pixel, 1 to 256, instead.
        progress: called now and then with the share that is done, from 0 to 1.
        color_by: a quantity that gives the colour of each point of all that is drawn: a ``zs.Coloring``, one's name, or
            a formula; None takes the materials' own.
        beams: whether tiles of 8x8 pixels share beams, which say where their rays begin; without them each ray shows
            what its method alone can tell. Only what stays unresolved depends on it.

    Returns:
        The picture, with depth, normals, status, steps and the value coloured by as ``image.aov(name)``.

    Raises:
        ZerosetError: and its kinds, for what cannot be drawn; the message says what and how to mend it.

    Example:
        >>> import zeroset as zs
        >>> image = zs.render("x^2 + y^2 + z^2 = 1", size=64)
        >>> image.size, image.hits > 500
        ((64, 64), True)
    """
    scene = as_scene(surface)
    # Surroundings and colours of a quantity are imported where they are asked for, which they seldom are.
    if color_by is not None:
        from zeroset.scene.coloring import as_coloring

        coloring = as_coloring(color_by)
        scene, material = _colored(scene, coloring), None if material is None else replace(material, coloring=coloring)
    scene = replace(
        scene,
        material=scene.material if material is None else material,
        lights=scene.lights if lights is None else tuple(lights),
        background=scene.background if background is None else background,
        shadows=scene.shadows if shadows is None else shadows,
    )
    if environment is not None:
        from zeroset.scene.environment import as_environment

        scene = replace(scene, environment=as_environment(environment))
    shown, lit, materials = as_drawn(scene.surface), scene.lights, scene.materials
    layout = _layout(size)
    chosen = resolve_method(method)
    shown.check(chosen)
    target = get_device(device)
    smooth = Smooth.of(antialias, samples)
    lighting = Lighting.of(scene, smooth)
    colored = scene.colored
    tint = None if colored is None else _tint(colored, shown, target)
    whole = fits(layout, target)
    # First the frame: its kernels are compiled while the bounds are being fitted.
    frame = frame_for(shown, chosen, lighting, layout, target, draft, tint, beams) if whole else None
    shown, guessed = shown.with_fitted_bounds(), shown
    if frame is not None and shown.shape != guessed.shape:
        frame = frame_for(shown, chosen, lighting, layout, target, draft, tint, beams)
    view = parse_camera(camera or scene.camera or scene.surface.camera, shown.fitted)
    rays = view.rays(layout.width, layout.height)
    uniforms = frame_uniforms(shown, chosen, rays, layout, world_tolerance(tolerance, shown.smallest))
    uniforms[OPAQUE] = opaque_parts(materials)
    uniforms |= shading_uniforms(materials[0], lit, scene.background, rays)
    coarse = shadow_length(shadow_tolerance, shown.smallest)
    light, deep = None, lighting.depth(depth)
    if scene.shadows or lighting.optics is not None:
        light = Illumination.of(scene, rays, coarse, deep, smooth)
    palette = None if colored is None else _palette(colored, rays)
    outputs: GBuffer | Assembled
    if frame is not None:
        with frame.lock:
            outputs = frame.draw(shown, uniforms, thin, progress, draft, light, materials, palette, beams)
    else:
        if palette is not None and palette.range is None:
            # All bands have one range: that of the whole picture, drawn smaller.
            small = _smaller(layout, target)
            seen = render(scene, (small.width, small.height), camera, method, target, tolerance, thin=thin, beams=beams)
            palette = palette._replace(range=seen.range)
        outputs = Assembled(layout, shown.parts, palette)
        parts = tuple(bands(layout, target))
        for i, band in enumerate(parts):
            own = uniforms | camera_uniforms(band.rays(layout, rays)) | band.layout.uniforms()
            part = frame_for(shown, chosen, lighting, band.layout, target, draft, tint, beams)
            with part.lock:
                share = part_of(progress, i, len(parts))
                outputs.add(band, part.draw(shown, own, thin, share, draft, light, materials, palette, beams))
    values = () if colored is None else colored.values
    return Image((layout.width, layout.height), outputs, chosen.certified, scene.coloring, values)


def _colored(scene: Scene, coloring: Coloring | None) -> Scene:
    """A scene coloured by a quantity, whoever has the material."""
    material = replace(scene.material, coloring=coloring)

    def own(surface: Surface) -> Surface:
        material = surface.material
        return surface if material is None else surface.with_material(replace(material, coloring=coloring))

    return replace(scene, surface=scene.surface.mapped(own), material=material)


def _tint(colored: Colored, drawn: Drawn, device: Device) -> Tint:
    from zeroset.rendering.tint import Tint

    return Tint.of(colored, drawn, device)


def _palette(colored: Colored, rays: Rays) -> Palette:
    from zeroset.rendering.tint import Palette

    return Palette.of(colored, rays)


def _smaller(layout: Layout, device: Device) -> Layout:
    """A picture's size with its longer side cut down to ``PREVIEW``, and further until it fits."""
    side = min(PREVIEW, max(layout.width, layout.height))
    while True:
        scale = side / max(layout.width, layout.height)
        small = Layout(max(round(layout.width * scale), 1), max(round(layout.height * scale), 1))
        if side <= TILE or fits(small, device):
            return small
        side //= 2


def _layout(size: tuple[int, int] | int) -> Layout:
    try:
        width, height = (operator.index(v) for v in (size if isinstance(size, (tuple, list)) else (size, size)))
    except (TypeError, ValueError):
        raise ZerosetError(f"the size must be width and height in whole pixels, not {size!r}") from None
    if not (1 <= width <= LARGEST and 1 <= height <= LARGEST):
        raise ZerosetError(f"the size must be from 1 to {LARGEST} pixels a side, not {width}x{height}")
    if width * height > MOST_PIXELS:
        raise ZerosetError(
            f"{width}x{height} are more than {MOST_PIXELS:,} pixels", hint="8192x8192 is the largest square"
        )
    return Layout(width, height)


def world_tolerance(value: float | None, bounds: Bounds) -> float:
    """The tolerance that was asked for, or the default; raises ``ParameterError`` for one that is no length."""
    if value is None:
        return default_tolerance(bounds)
    length = number(value, "the tolerance", ParameterError)
    if not length >= SMALLEST:
        raise ParameterError(f"the tolerance must be at least {SMALLEST:g}, not {value!r}")
    return length


def shadow_length(value: float | None, bounds: Bounds) -> float:
    """The shadows' tolerance that was asked for, or the default; raises ``ParameterError`` for no length."""
    if value is None:
        return bounds.extent * 2.0**-11
    length = number(value, "the shadow tolerance", ParameterError)
    if not length >= SMALLEST:
        raise ParameterError(f"the shadow tolerance must be at least {SMALLEST:g}, not {value!r}")
    return length


def frame_uniforms(drawn: Drawn, method: Method, rays: Rays, layout: Layout, tolerance: float) -> dict[str, float]:
    """Everything that the beams and the primary rays need to know."""
    bounds = drawn.fitted
    depth = float(np.dot(np.subtract(bounds.center, rays.eye), rays.forward))
    slack = 1e-6 * (abs(depth) + bounds.reach)
    near, far = max(0.0, depth - bounds.reach - slack), max(0.0, depth + bounds.reach + slack)
    # Length of one pixel step, at the bounds' centre, in world units: a beam is about a tile of them wide.
    spread = np.linalg.norm(rays.right) * max(depth, near) + np.linalg.norm(rays.right_origin)
    finest = max(float(spread) * 2.0 / max(layout.width, layout.height) * TILE, tolerance, 1e-6 * far)
    uniforms = camera_uniforms(rays) | drawn.limits() | layout.uniforms()
    uniforms["world_pixel"] = float(spread) * 2.0 / max(layout.width, layout.height)
    uniforms |= {"near": near, "far": far, "finest": finest, "tolerance": tolerance}
    return uniforms | drawn.parameters(method)
