"""Scene files: a whole picture as TOML, read with errors that name the line, and written back the same.

Every key is optional but ``formula``:

    formula = "x^4 - a*x^2 + y^4 - 5y^2 + z^4 - 5z^2 + 11.8"
    name = "tangle"
    bounds = 3.0                                    # or {center, radius}, or {min, max}
    background = [1.0, 1.0, 1.0]
    shadows = true
    environment = "sky"                             # or "room", or a picture's file name
    params = {a = 5.0}
    camera = {eye = [4, -7, 4], target = [0, 0, 0], up = [0, 0, 1], fov = 35}
    material = {front = [0.9, 0.5, 0.1], shininess = 40}
    material.coloring = {by = "gaussian-curvature", map = "coolwarm", range = [-2, 2]}   # or the quantity alone
    [[lights]]
    direction = [-0.4, 0.7, 0.7]
"""

from __future__ import annotations

import dataclasses
import os
import re
import tomllib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from zeroset.errors import SceneFileError, ZerosetError, did_you_mean
from zeroset.scene.bounds import Ball, Bounds, parse_bounds
from zeroset.scene.camera import Camera
from zeroset.scene.coloring import Coloring, formula_of
from zeroset.scene.environment import Environment, as_environment
from zeroset.scene.light import DEFAULT_BACKGROUND, DEFAULT_LIGHTS, Light, Material
from zeroset.scene.scene import MOST_LIGHTS, Scene, as_scene
from zeroset.scene.surface import Surface, surface

KEYS = ("formula", "name", "bounds", "background", "params", "camera", "material", "lights", "shadows", "environment")
LARGEST = 4_000_000
"""Bytes of a scene file."""


def load(path: str | os.PathLike[str]) -> Scene:
    """Read a scene file.

    Args:
        path: a ``.toml`` file.

    Returns:
        The scene; ``scene.surface`` is its surface.

    Raises:
        SceneFileError: the file is missing, is no scene, or has a wrong entry; the message names file and line.

    Example:
        >>> import os, tempfile
        >>> import zeroset as zs
        >>> path = os.path.join(tempfile.mkdtemp(), "ball.toml")
        >>> _ = zs.save(zs.surface("x^2 + y^2 + z^2 = r^2", {"r": 2.0}), path)
        >>> zs.load(path).surface.params["r"]
        2.0
    """
    source = Path(path)
    _check_suffix(source)
    try:
        if source.stat().st_size > LARGEST:
            raise SceneFileError(f"the scene file is larger than {LARGEST} bytes", path=path)
        text = source.read_text(encoding="utf-8")
    except OSError as error:
        raise SceneFileError(f"cannot read the scene file: {error.strerror or error}", path=path) from None
    except UnicodeDecodeError:
        raise SceneFileError("the scene file is not text in UTF-8", path=path) from None
    return loads(text, path)


def _check_suffix(path: Path) -> None:
    if path.suffix.lower() != ".toml":
        raise SceneFileError(f"cannot tell the format of {path.name!r}", path=path, hint="scene files end in .toml")


def loads(text: str, path: str | os.PathLike[str] = "scene.toml") -> Scene:
    """A scene from the text of a scene file; ``path`` is what errors call it."""
    try:
        data = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        found = re.search(r"line (\d+)", str(error))
        line = int(found[1]) if found else None
        if "end of document" in str(error):
            line = max(1, len(text.splitlines()))
        raise SceneFileError(f"this is no TOML: {error}", path=path, line=line) from None
    return _Reader(text, path).scene(data)


class _Reader:
    def __init__(self, text: str, path: str | os.PathLike[str]) -> None:
        self._text = text
        self._path = path

    def _line(self, key: str) -> int | None:
        """The first line that mentions a key; TOML's reader does not tell where values stood."""
        pattern = re.compile(rf"(^|[\s{{,\[.]){re.escape(key)}\s*[=\]]")
        return next((i for i, line in enumerate(self._text.splitlines(), 1) if pattern.search(line)), None)

    def fail(self, message: str, key: str, hints: tuple[str, ...] = ()) -> SceneFileError:
        return SceneFileError(message, path=self._path, line=self._line(key), hints=hints)

    def known(self, data: Any, keys: tuple[str, ...], where: str) -> Mapping[str, Any]:
        if not isinstance(data, Mapping):
            raise self.fail(f"{where} must be a table, not {data!r}", where)
        for key in data:
            if key not in keys:
                raise self.fail(f"{where} has no {key!r}", key, (*did_you_mean(key, keys), f"it has {', '.join(keys)}"))
        return data

    def scene(self, data: dict[str, Any]) -> Scene:
        self.known(data, KEYS, "a scene")
        if not isinstance(data.get("formula"), str):
            raise self.fail("a scene needs a formula as text", "formula", ('formula = "x^2 + y^2 + z^2 = 1"',))
        lights = data.get("lights")
        if lights is not None and not isinstance(lights, list):
            raise self.fail("lights must be a list of tables", "lights", ("write each as [[lights]]",))
        params = self._table(data, "params")
        with _placing(self, "formula"):
            shape = surface(data["formula"], params, name=str(data.get("name", "")))
        with _placing(self, "bounds"):
            shape = dataclasses.replace(shape, bounds=parse_bounds(data.get("bounds")))
        camera = None if "camera" not in data else self.build(Camera, data["camera"], "camera")
        material = self._material(data.get("material", {}), shape)
        around = data.get("environment")
        if isinstance(around, Mapping):
            around = self.build(Environment, around, "environment")
        with _placing(self, "environment"):
            around = as_environment(around)
        lit = DEFAULT_LIGHTS if lights is None else tuple(self.build(Light, light, "lights") for light in lights)
        with _placing(self, "lights" if len(lit) > MOST_LIGHTS else "background"):
            return Scene(
                shape,
                camera,
                material,
                lit,
                data.get("background", DEFAULT_BACKGROUND),
                data.get("shadows", False),
                around,
            )

    def _material(self, data: Any, shape: Surface) -> Any:
        if isinstance(data, Mapping) and isinstance(data.get("coloring"), Mapping):
            data = {**data, "coloring": self.build(Coloring, data["coloring"], "coloring")}
        material = self.build(Material, data, "material")
        if material.coloring is not None:
            with _placing(self, "by" if isinstance(data["coloring"], Coloring) else "coloring"):
                formula_of(material.coloring, shape)
        return material

    def _table(self, data: Mapping[str, Any], key: str) -> Mapping[str, Any]:
        value = data.get(key, {})
        if not isinstance(value, Mapping):
            raise self.fail(f"{key} must be a table of names and values", key)
        return value

    def build(self, cls: type[Any], data: Any, where: str) -> Any:
        fields = tuple(f.name for f in dataclasses.fields(cls))
        values = {k: tuple(v) if isinstance(v, list) else v for k, v in self.known(data, fields, where).items()}
        try:
            return cls(**values)
        except ZerosetError as error:
            raise self.fail(str(error), next(filter(_refused(cls, values), values), where)) from None


def _refused(cls: type[Any], values: Mapping[str, Any]) -> Callable[[str], bool]:
    """Says which one of several values is not taken even by itself: the one to blame."""

    def refuses(key: str) -> bool:
        try:
            cls(**{key: values[key]})
        except ZerosetError:
            return True
        return False

    return refuses


class _placing:  # noqa: N801 - reads as a statement
    """Errors of what a file says get the file and the line."""

    def __init__(self, reader: _Reader, key: str) -> None:
        self._reader = reader
        self._key = key

    def __enter__(self) -> None:
        return None

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: Any) -> None:
        if isinstance(error, ZerosetError) and not (isinstance(error, SceneFileError) and error.path is not None):
            raise self._reader.fail(str(error), self._key) from None


def dumps(scene: Scene | Surface) -> str:
    """The text of a scene file; ``loads`` gives the same scene back."""
    import tomli_w

    scene = as_scene(scene)
    shape = scene.surface
    data: dict[str, Any] = {"formula": shape.formula}
    if shape.name:
        data["name"] = shape.name
    if shape.bounds is not None:
        data["bounds"] = _bounds_data(shape.bounds)
    data["background"] = [float(v) for v in scene.background]
    params: dict[str, Any] = dict(shape.params) | {k: [float(v) for v in a] for k, a in shape.arrays.items()}
    if params:
        data["params"] = params
    camera = scene.camera or shape.camera
    if camera is not None:
        data["camera"] = _given(dataclasses.asdict(camera))
    data["material"] = _given(dataclasses.asdict(scene.material))
    if scene.material.coloring is not None:
        data["material"]["coloring"] = _given(dataclasses.asdict(scene.material.coloring))
    if scene.shadows:
        data["shadows"] = True
    if scene.environment is not None:
        around = scene.environment
        data["environment"] = around.source if around.strength == 1.0 else dataclasses.asdict(around)
    data["lights"] = [_given(dataclasses.asdict(light)) for light in scene.lights]
    return tomli_w.dumps(data)


def _given(data: dict[str, Any]) -> dict[str, Any]:
    """What of it is not None, which TOML does not know."""
    return {k: v for k, v in data.items() if v is not None}


def _bounds_data(bounds: Bounds) -> Any:
    if isinstance(bounds, Ball):
        return bounds.radius if not any(bounds.center) else dataclasses.asdict(bounds)
    return dataclasses.asdict(bounds)


def save(scene: Scene | Surface, path: str | os.PathLike[str]) -> Path:
    """Write a scene file, whole or not at all; gives its path.

    Raises:
        SceneFileError: the file's name does not end in ``.toml``.
        OutputError: the file cannot be written.

    Example:
        >>> import os, tempfile
        >>> import zeroset as zs
        >>> path = os.path.join(tempfile.mkdtemp(), "ball.toml")
        >>> zs.save(zs.surface("x^2 + y^2 + z^2 = 1"), path).name
        'ball.toml'
    """
    from zeroset.atomic import replacing

    target = Path(path)
    _check_suffix(target)
    data = dumps(scene).encode()
    with replacing(target) as file:
        file.write(data)
    return target
