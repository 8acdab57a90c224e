"""The picture as a program: Python that makes it again, and the same as a command line."""

from __future__ import annotations

import dataclasses
import shlex
from typing import Any

from zeroset.scene.bounds import Ball, Bounds
from zeroset.scene.camera import Camera
from zeroset.scene.coloring import Coloring
from zeroset.scene.environment import Environment
from zeroset.scene.file import dumps
from zeroset.scene.isovalues import colors_of
from zeroset.scene.light import DEFAULT_BACKGROUND, DEFAULT_LIGHTS, Color, Light, Material
from zeroset.scene.surface import Surface
from zeroset.solve.method import Method
from zeroset.view.state import State


def python(state: State, size: tuple[int, int]) -> str:
    """A program that draws what the window shows and saves it as ``picture.png``; colours of overlays apart."""
    lines = ["import zeroset as zs", "", *_surfaces(state), f"camera = {_camera(state.camera)}"]
    scene = ["surfaces" if state.several else "surface", "camera"]
    material = state.scene.material
    if material != Material():
        scene.append(f"material={_changed('zs.Material', material, Material())}")
    if state.lights != DEFAULT_LIGHTS:
        lights = ", ".join(_changed("zs.Light", light, Light()) for light in state.lights)
        scene.append(f"lights=({lights}{',' if len(state.lights) == 1 else ''})")
    if state.background != DEFAULT_BACKGROUND:
        scene.append(f"background={state.background!r}")
    if state.shadows:
        scene.append("shadows=True")
    if state.environment is not None:
        scene.append(f"environment={_environment(state.environment)}")
    lines += [f"scene = zs.Scene({', '.join(scene)})"]
    call = ["scene", f"size={size!r}"]
    if state.method.name != "auto" or _options(state.method):
        call.append(f"method={_method(state.method)}")
    if state.tolerance is not None:
        call.append(f"tolerance={state.tolerance!r}")
    if state.antialias > 1:
        call.append(f"antialias={state.antialias}")
    lines += [f"image = zs.render({', '.join(call)})", 'image.save("picture.png")', ""]
    return "\n".join(lines)


def command(state: State, size: tuple[int, int]) -> str:
    """A command line that does the same; a scene file goes before it where colours, lights or bounds ask for one."""
    method = ",".join(f"{k}={v}" for k, v in _options(state.method).items())
    rest = ["-s", f"{size[0]}x{size[1]}"]
    if state.method.name != "auto" or method:
        rest += ["-m", state.method.name + (f":{method}" if method else "")]
    if state.tolerance is not None:
        rest += ["-t", repr(state.tolerance)]
    if state.antialias > 1:
        rest += ["--antialias", str(state.antialias)]
    rest += ["-o", "picture.png"]
    if not _plain(state):
        scene = dumps(state.scene).rstrip("\n")
        return f"cat > scene.toml <<'END'\n{scene}\nEND\n{shlex.join(['zeroset', 'render', 'scene.toml', *rest])}\n"
    return shlex.join(["zeroset", "render", state.item.surface.formula, *_places(state), *rest]) + "\n"


def _plain(state: State) -> bool:
    """Whether options alone say all that there is to say."""
    bounds, surface = state.bounds, state.item.drawn
    if state.several or surface.arrays or surface.colors != _usual_colors(surface):
        return False
    lit = (state.item.material, state.lights, state.background) == (Material(), DEFAULT_LIGHTS, DEFAULT_BACKGROUND)
    lit = lit and not state.shadows and state.environment is None
    return lit and (not isinstance(bounds, Ball) or not any(bounds.center))


def _places(state: State) -> list[str]:
    """Parameters, isovalues, bounds and camera as options; with = where a value may begin with a minus sign."""
    surface = state.item.drawn
    made = [f"--param={name}={value!r}" for name, value in surface.params.items()]
    if surface.isovalues:
        made.append("--isovalues=" + ",".join(map(repr, surface.isovalues)))
    bounds, camera = state.bounds, state.camera
    numbers = (bounds.radius,) if isinstance(bounds, Ball) else (*bounds.min, *bounds.max)
    made.append("--bounds=" + ",".join(map(repr, numbers)))
    made += [f"--{name}=" + ",".join(map(repr, getattr(camera, name))) for name in ("eye", "target", "up")]
    made.append(f"--fov={camera.fov!r}" if camera.height is None else f"--height={camera.height!r}")
    return made


def _usual_colors(surface: Surface) -> tuple[Color, ...]:
    """The colours that isovalues get on the command line."""
    return colors_of(None, tuple(range(len(surface.isovalues))))


def _surfaces(state: State) -> list[str]:
    """The lines that make what is drawn."""
    made = state.drawn.surfaces
    if not state.several:
        return [f"surface = {_surface(made[0])}"]
    return ["surfaces = [", *(f"    {_surface(surface)}," for surface in made), "]"]


def _surface(surface: Surface) -> str:
    params: dict[str, Any] = {**surface.params, **{name: values.tolist() for name, values in surface.arrays.items()}}
    parts = [repr(surface.formula)]
    if params:
        parts.append(f"params={params!r}")
    made = f"zs.surface({', '.join([*parts, f'bounds={_bounds(surface.fitted)}'])})"
    if surface.isovalues:
        made += f".with_isovalues({surface.isovalues!r}, colors={surface.colors!r})"
    if surface.material is not None:
        made += f".with_material({_changed('zs.Material', surface.material, Material())})"
    return made


def _bounds(bounds: Bounds) -> str:
    if isinstance(bounds, Ball):
        return repr(bounds.radius) if not any(bounds.center) else f"zs.Ball({bounds.radius!r}, {bounds.center!r})"
    return f"zs.Box({bounds.min!r}, {bounds.max!r})"


def _camera(camera: Camera) -> str:
    lens = f"fov={camera.fov!r}" if camera.height is None else f"height={camera.height!r}"
    return f"zs.Camera(eye={camera.eye!r}, target={camera.target!r}, up={camera.up!r}, {lens})"


def _environment(around: Environment) -> str:
    return repr(around.source) if around.strength == 1 else f"zs.Environment({around.source!r}, {around.strength!r})"


def _method(method: Method) -> str:
    options = ", ".join(f"{k}={v!r}" for k, v in _options(method).items())
    return f"zs.methods.{type(method).__name__}({options})" if options else repr(method.name)


def _options(method: Method) -> dict[str, Any]:
    """The options that are not what they are by default."""
    return {f.name: getattr(method, f.name) for f in dataclasses.fields(method) if getattr(method, f.name) != f.default}


def _changed(name: str, value: Any, plain: Any) -> str:
    """A call that makes a value, with those fields only that differ from the plain one's."""
    fields = [f.name for f in dataclasses.fields(value)]
    changed = [f"{f}={_value(getattr(value, f))}" for f in fields if getattr(value, f) != getattr(plain, f)]
    return f"{name}({', '.join(changed)})"


def _value(value: Any) -> str:
    return _changed("zs.Coloring", value, Coloring()) if isinstance(value, Coloring) else repr(value)
