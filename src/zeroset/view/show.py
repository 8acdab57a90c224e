"""``zs.show``: a surface in a live window, or in a notebook's widget."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from zeroset.errors import ParameterError, ViewError
from zeroset.rendering.drawn import as_drawn
from zeroset.runtime import get_device
from zeroset.scene.camera import Camera
from zeroset.scene.plain import merged
from zeroset.scene.scene import Scene, Shown, as_scene
from zeroset.scene.several import Drawable, Several
from zeroset.scene.solid import Solid
from zeroset.scene.surface import Surface, surface
from zeroset.solve.method import Method, resolve_method
from zeroset.view import canvas, notebook
from zeroset.view.log import Log
from zeroset.view.session import Session
from zeroset.view.state import BACKGROUND, State, opened

if TYPE_CHECKING:
    from zeroset.runtime import Device

SIZE = (1280, 800)
NOTEBOOK_SIZE = (960, 600)


def show(
    source: Shown,
    size: tuple[int, int] | None = None,
    camera: Camera | None = None,
    method: str | Method = "auto",
    device: str | Device = "auto",
    tolerance: float | None = None,
    log: str | Path | None = None,
) -> None:
    """Show surfaces in a window in which they can be turned, and their formulas changed.

    In a script it returns when the window is closed. In a notebook it shows a widget and returns at once; the widget
    works until its cell runs again.

    Args:
        source: a Surface, a Solid (shown as one f), a sequence of both, a Scene, or a formula as text, in which single
            letters may be parameters.
        size: of the window, in logical pixels.
        camera: where to begin; None takes the scene's or the surface's own, or one that fits the bounds.
        method: as for ``render``; it can be changed in the window.
        device: the name of the device that draws.
        tolerance: world length to which roots are found; None takes the default.
        log: a file that is told what happens, one JSON object a line.

    Raises:
        FormulaError: the text is no formula.
        ViewError: there is no display, or something that windows need is not installed.

    Example:
        >>> import zeroset as zs
        >>> zs.show("x^2 + y^2 + a*z^2 = 1")  # doctest: +SKIP
    """
    name = device if isinstance(device, str) else device.name
    state = start(*scene_of(source), resolve_method(method), name, tolerance, camera)
    if notebook.running():
        _check_size(size or NOTEBOOK_SIZE)
        ipython: Any = importlib.import_module("IPython.display")
        ipython.display(notebook.widget(state, size or NOTEBOOK_SIZE, Log(log)))
        return
    window(state, size or SIZE, Log(log))


def start(
    scene: Scene,
    texts: Sequence[str],
    method: Method,
    device: str,
    tolerance: float | None,
    camera: Camera | None = None,
) -> State:
    """The state that a window begins with, checked as far as that is quick."""
    get_device(device)
    as_drawn(scene.surface).check(method)
    state = opened(scene, texts, method, device, tolerance)
    return state if camera is None else replace(state, camera=camera, home=camera)


def scene_of(source: Shown) -> tuple[Scene, tuple[str, ...]]:
    """The scene that a window opens with, and the text in each of its formula boxes. A solid becomes one formula.

    Example:
        >>> scene, texts = scene_of("x^2 + a*y^2 = 1")
        >>> dict(scene.surface.params), texts
        ({'a': 1.0}, ('x^2 + a*y^2 = 1',))
    """
    if isinstance(source, str):
        from zeroset.view.formula import read

        return Scene(read(source, {}).surface, background=BACKGROUND), (source,)
    # Whatever else can be made into a surface can be shown: a function, a SymPy expression.
    given = source if isinstance(source, (Scene, Surface, Solid, Several, list, tuple)) else surface(source)
    scene = as_scene(given)
    scene = replace(scene, surface=_without_solids(scene.surface))
    if not isinstance(source, Scene):
        scene = replace(scene, background=BACKGROUND)
    return scene, tuple(map(_text, scene.surface.surfaces))


def _without_solids(thing: Drawable) -> Drawable:
    """The same with every solid as one f."""
    if isinstance(thing, Several):
        return Several(tuple(merged(each) if isinstance(each, Solid) else each for each in thing))
    return merged(thing) if isinstance(thing, Solid) else thing


def _text(shape: Surface) -> str:
    """The formula of a surface: as it is printed for one of the gallery, which reads better than what it became."""
    from zeroset.surfaces import entry, names

    if shape.name in names():
        from zeroset.shelf import gallery

        if gallery[shape.name].field.digest == shape.field.digest:
            return entry(shape.name).formula
    return shape.formula


def window(state: State, size: tuple[int, int], log: Log) -> bool:
    """Open a window and wait until it is closed; gives whether all threads have ended with it.

    Raises:
        ViewError: there is no display, or something that windows need is not installed.
    """
    _check_size(size)
    canvas.check_packages(canvas.DESKTOP, "desktop")
    canvas.check_display()
    adapter = canvas.find_adapter()
    names = [item.surface.name for item in state.items if item.surface.name]
    title = f"zeroset: {', '.join(names)}" if names else "zeroset"
    surface_, loop = canvas.desktop_canvas(size, title, adapter is not None)
    if adapter is None:
        print("no graphics adapter was found: the window has no panels, only mouse and keys", file=sys.stderr)
    session = Session(state, log, surface_.request_draw)
    shown = _fill(surface_, adapter, session)
    log.say("opened", size=list(size), panels=adapter is not None)
    try:
        loop.run()
    finally:
        ended = [shown.close(), session.close()]
    return all(ended)


def _fill(surface_: Any, adapter: Any, session: Session) -> Any:
    """Put picture and panels on a canvas."""
    if adapter is None:
        from zeroset.view.plain import PlainWindow

        return PlainWindow(surface_, session)
    from imgui_bundle import imgui

    from zeroset.view.window import Window, desktop_clipboard

    made = Window(surface_, adapter, session)
    session.clipboard = desktop_clipboard(imgui)
    return made


def _check_size(size: tuple[int, int]) -> None:
    try:
        width, height = (int(v) for v in size)
    except (TypeError, ValueError):
        raise ParameterError(f"the window's size must be width and height, not {size!r}") from None
    if not (200 <= width <= 16384 and 150 <= height <= 16384):
        raise ViewError(f"a window of {width}x{height} is not possible", hint="from 200x150 to 16384x16384")
