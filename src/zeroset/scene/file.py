"""Scene files: a whole picture as TOML, read with errors that name the line, and written back the same.

Every key is optional but ``formula``, in whose place there may be surfaces and solids (``file_shapes``):

    formula = "x^4 - a*x^2 + y^4 - 5y^2 + z^4 - 5z^2 + 11.8"
    name = "tangle"
    bounds = 3.0                                    # or {center, radius}, or {min, max}
    background = [1.0, 1.0, 1.0]
    shadows = true
    environment = "sky"                             # or "room", or pictures, named from this file's folder
    params = {a = 5.0}
    isovalues = [0.0, 2.0]                          # instead of f = 0
    colors = [[0.9, 0.3, 0.1], [0.1, 0.3, 0.8]]
    camera = {eye = [4, -7, 4], target = [0, 0, 0], up = [0, 0, 1], fov = 35}
    material = {front = [0.9, 0.5, 0.1], shininess = 40}
    material.coloring = {by = "gaussian-curvature", map = "coolwarm", range = [-2, 2]}   # or the quantity alone
    [[lights]]
    direction = [-0.4, 0.7, 0.7]
"""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from zeroset.errors import SceneFileError, ZerosetError, did_you_mean
from zeroset.scene.blame import blamed, blamed_coloring, in_toml
from zeroset.scene.camera import Camera
from zeroset.scene.colored import colored
from zeroset.scene.coloring import Coloring
from zeroset.scene.environment import Environment, as_environment
from zeroset.scene.file_shapes import TOP, given, material_data, read_shapes, shapes_data
from zeroset.scene.kinds import shown, wrong_kind
from zeroset.scene.light import DEFAULT_BACKGROUND, DEFAULT_LIGHTS, Light, Material
from zeroset.scene.lines import Lines, read_toml
from zeroset.scene.lines import Path as KeyPath
from zeroset.scene.places import for_folder, from_folder
from zeroset.scene.scene import MOST_LIGHTS, Scene, Shown, as_scene
from zeroset.scene.several import Drawable

KEYS = (*TOP, "background", "camera", "material", "lights", "shadows", "environment")
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
            raise SceneFileError(
                f"the scene file is larger than {LARGEST:,} bytes", path=path, hint="is this the file that was meant?"
            )
        text = source.read_text(encoding="utf-8")
    except OSError as error:
        raise SceneFileError(f"cannot read the scene file: {error.strerror or error}", path=path) from None
    except UnicodeDecodeError:
        raise SceneFileError("the scene file is not text in UTF-8", path=path, hint="save it as UTF-8") from None
    except ValueError as error:
        raise SceneFileError(f"cannot read the scene file: {error}", path=path) from None
    return loads(text, path)


def _check_suffix(path: Path) -> None:
    if path.suffix.lower() != ".toml":
        raise SceneFileError(f"cannot tell the format of {path.name!r}", path=path, hint="scene files end in .toml")


def loads(text: str, path: str | os.PathLike[str] = "scene.toml") -> Scene:
    """A scene from the text of a scene file.

    Args:
        text: TOML.
        path: what errors call it; pictures are named from the folder of this file.

    Raises:
        SceneFileError: it is no scene; the message names the line.
    """
    # Some editors begin a file with a mark that says in what order a character's bytes stand.
    text = text.removeprefix("\ufeff")
    return _Reader(text, path).scene(read_toml(text, path))


class _Reader:
    def __init__(self, text: str, path: str | os.PathLike[str]) -> None:
        self._text = text
        self._path = path

    def placing(self, place: Callable[[ZerosetError], KeyPath]) -> _placing:
        """Errors inside get the line of a place."""
        return _placing(self, place)

    def fail(self, message: str, place: str | KeyPath, hints: tuple[str, ...] = ()) -> SceneFileError:
        path: KeyPath = (place,) if isinstance(place, str) else place
        return SceneFileError(message, path=self._path, line=Lines(self._text).of(path), hints=hints)

    def known(self, data: Any, keys: tuple[str, ...], where: str, path: KeyPath = ()) -> Mapping[str, Any]:
        if not isinstance(data, Mapping):
            raise self.fail(f"{where} must be a table, not {shown(data)}", path)
        for key in data:
            if key not in keys:
                hints = (*did_you_mean(key, keys), f"it has {', '.join(keys)}")
                raise self.fail(f"{where} has no {key!r}", (*path, key), hints)
        return data

    def kinds(self, value: Any, path: KeyPath) -> Any:
        """The value, if all in it is of the kind that is meant there."""
        wrong = wrong_kind(value, path)
        if wrong is not None:
            raise self.fail(wrong[1], wrong[0])
        return value

    def scene(self, data: dict[str, Any]) -> Scene:
        self.known(data, KEYS, "a scene")
        lights = data.get("lights")
        if lights is not None and not isinstance(lights, list):
            raise self.fail("lights must be a list of tables", "lights", ("write each as [[lights]]",))
        shape = read_shapes(self, data)
        camera = None if "camera" not in data else self.build(Camera, data["camera"], "the camera", ("camera",))
        material = self._material(data, shape)
        around = self._environment(data.get("environment"))
        for key in {"background", "shadows"} & set(data):
            self.kinds(data[key], (key,))
        lit = DEFAULT_LIGHTS
        if lights is not None:
            lit = tuple(self.build(Light, light, "a light", ("lights", i)) for i, light in enumerate(lights))
        place = ("lights", MOST_LIGHTS) if len(lit) > MOST_LIGHTS else ("background",)
        with _placing(self, lambda error: place):
            return Scene(
                shape,
                camera,
                material,
                lit,
                data.get("background", DEFAULT_BACKGROUND),
                data.get("shadows", False),
                around,
            )

    def _material(self, data: Mapping[str, Any], shape: Drawable) -> Material:
        material = self.material(data.get("material", {}), ("material",))
        with _placing(self, lambda error: blamed_coloring(data)):
            colored(shape, material)
        return material

    def material(self, data: Any, path: KeyPath) -> Material:
        """A material from a table."""
        written = data.get("coloring") if isinstance(data, Mapping) else None
        if not isinstance(written, Mapping):
            plain: Material = self.build(Material, data, "the material", path)
            return plain
        coloring = self.build(Coloring, written, "the coloring", (*path, "coloring"))
        rest = {key: value for key, value in data.items() if key != "coloring"}
        return dataclasses.replace(self.material(rest, path), coloring=coloring)

    def table(self, data: Mapping[str, Any], key: str, path: KeyPath) -> Mapping[str, Any]:
        """A table of names and values in a table; an empty one where there is none."""
        value = data.get(key, {})
        if not isinstance(value, Mapping):
            raise self.fail(f"{key} must be a table of names and values", (*path, key))
        kept: Mapping[str, Any] = self.kinds(value, (*path, key))
        return kept

    def _environment(self, data: Any) -> Environment | None:
        """The surroundings, their pictures named from the file's folder; they are there, and fit."""
        if data is None:
            return None
        if isinstance(data, Mapping):
            self.known(data, ("source", "strength"), "the environment", ("environment",))
            if "source" not in data:
                raise self.fail("the environment needs a source", "environment", ('source = "sky"',))
            around = self.build(Environment, data, "the environment", ("environment",))
        else:
            with _placing(self, lambda error: ("environment",)):
                around = as_environment(self.kinds(data, ("environment",)))
        with _placing(self, lambda error: ("environment", "source")):
            around = from_folder(around, os.path.dirname(self._path))
            around.check()
        return around

    def build(self, cls: type[Any], data: Any, where: str, path: KeyPath) -> Any:
        fields = tuple(f.name for f in dataclasses.fields(cls))
        known = self.kinds(self.known(data, fields, where, path), path)
        values = {k: tuple(v) if isinstance(v, list) else v for k, v in known.items()}
        if "fov" in values and "height" in values:
            raise self.fail(
                "the camera has both a fov and a height", (*path, "height"), ("height alone is without perspective",)
            )
        try:
            return cls(**values)
        except ZerosetError as error:
            hints = tuple(map(in_toml, error.hints))
            raise self.fail(error.message, (*path, *blamed(cls, values)), hints) from None


class _placing:  # noqa: N801 - reads as a statement
    """Errors of what a file says get the file and the line."""

    def __init__(self, reader: _Reader, place: Callable[[ZerosetError], KeyPath]) -> None:
        self._reader = reader
        self._place = place

    def __enter__(self) -> None:
        return None

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: Any) -> None:
        if isinstance(error, ZerosetError) and not (isinstance(error, SceneFileError) and error.path is not None):
            said = "\n".join(filter(None, (error.message, error.place())))
            raise self._reader.fail(said, self._place(error), tuple(map(in_toml, error.hints))) from None


def dumps(scene: Shown) -> str:
    """The text of a scene file; ``loads`` gives the same scene back."""
    import tomli_w

    scene = as_scene(scene)
    shape = scene.surface
    data: dict[str, Any] = shapes_data(shape)
    params, tables = data.pop("params", None), data.pop("surfaces", None)
    data["background"] = [float(v) for v in scene.background]
    if params:
        data["params"] = params
    camera = scene.camera or shape.camera
    if camera is not None:
        data["camera"] = given(dataclasses.asdict(camera))
    data["material"] = material_data(scene.material)
    if scene.shadows:
        data["shadows"] = True
    if scene.environment is not None:
        around = scene.environment
        data["environment"] = around.source if around.strength == 1.0 else dataclasses.asdict(around)
    data["lights"] = [_light_data(light) for light in scene.lights]
    if tables:
        # After all plain values, since tables end the top of a file.
        data["surfaces"] = tables
    return tomli_w.dumps(data)


def save(scene: Shown, path: str | os.PathLike[str]) -> Path:
    """Write a scene file, whole or not at all; gives its path.

    Pictures of the surroundings stay where they are; the file names them from its own folder.

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
    scene = as_scene(scene)
    if scene.environment is not None:
        scene = dataclasses.replace(scene, environment=for_folder(scene.environment, target.parent))
    try:
        data = dumps(scene).encode()
    except UnicodeEncodeError:
        raise SceneFileError("a name in the scene cannot be written in UTF-8", path=path, hint="rename it") from None
    with replacing(target) as file:
        file.write(data)
    return target


def _light_data(light: Light) -> dict[str, Any]:
    """A light as a scene file has it: one at a place has no direction."""
    data = given(dataclasses.asdict(light))
    if light.position is not None:
        del data["direction"]
    return data
