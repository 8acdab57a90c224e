"""A canvas to draw on, and what draws on it: found out before anything is opened, so that what is missing can be said.

The desktop's canvas is a GLFW window; in a notebook it is a widget. Panels and picture are drawn with wgpu on whatever
adapter there is, software included. Where there is none, a canvas that takes bitmaps (Qt, wx, the notebook's widget)
still shows the picture.
"""

from __future__ import annotations

import importlib
import os
import sys
import warnings
from collections.abc import Callable
from importlib.util import find_spec
from typing import Any

from zeroset.errors import ViewError
from zeroset.runtime.gpu.adapter import BACKENDS, quiet_wayland

DESKTOP = ("wgpu", "rendercanvas", "glfw", "imgui_bundle")
NOTEBOOK = ("wgpu", "rendercanvas", "anywidget", "imgui_bundle")
FRAMES = 90.0
"""Most pictures a second."""
BORDER = 8
"""Pixels beside a notebook's widget that its frame and its cell take."""


def check_packages(names: tuple[str, ...], extra: str) -> None:
    """Raise ``ViewError`` unless all packages of an extra are installed."""
    missing = [name.replace("_", "-") for name in names if find_spec(name) is None]
    if missing:
        verb = "is" if len(missing) == 1 else "are"
        raise ViewError(
            f"the window needs {', '.join(missing)}, which {verb} not installed",
            hint=f'pip install "zeroset[{extra}]"',
        )


def check_display() -> None:
    """Raise ``ViewError`` unless there is a display that answers."""
    unix = sys.platform.startswith(("linux", "freebsd"))
    shown = os.environ.get("WAYLAND_DISPLAY") or os.environ.get("DISPLAY")
    if unix and not shown:
        raise ViewError(
            "there is no display to open a window on: neither DISPLAY nor WAYLAND_DISPLAY is set",
            hints=("to draw into a file: zeroset render", "on a machine without a screen: xvfb-run zeroset view"),
        )
    import glfw

    with warnings.catch_warnings():
        # GLFW tells what it dislikes by warnings, and that it failed by what it gives back.
        warnings.simplefilter("ignore")
        ready = glfw.init()
    if not ready:
        where = f"the display {shown}" if unix else "the display"
        raise ViewError(f"cannot open a window: {where} does not answer", hint="to draw into a file: zeroset render")


def find_adapter() -> Any:
    """The adapter that windows are drawn with, or None."""
    import wgpu

    try:
        with quiet_wayland():
            adapter = wgpu.gpu.request_adapter_sync(power_preference="high-performance")
    except RuntimeError:
        return None
    # On OpenGL wgpu ends the process where it cannot make a window.
    return adapter if adapter.info["backend_type"] in BACKENDS else None


def desktop_canvas(size: tuple[int, int], title: str, panels: bool) -> tuple[Any, Any]:
    """A window and the loop that it lives in; one that takes bitmaps where there are no panels.

    Raises:
        ViewError: nothing here can show a window without an adapter.
    """
    if panels:
        module: Any = importlib.import_module("rendercanvas.glfw")
    else:
        module = _bitmap_module()
    canvas = module.RenderCanvas(size=size, title=title, max_fps=FRAMES, update_mode="ondemand", vsync=True)
    return canvas, module.loop


def _bitmap_module() -> Any:
    """The backend of a toolkit that shows bitmaps by itself."""
    for toolkit, name in (("PySide6", "pyside6"), ("PyQt6", "pyqt6"), ("PyQt5", "pyqt5"), ("wx", "wx")):
        if find_spec(toolkit) is not None:
            return importlib.import_module(f"rendercanvas.{name}")
    raise ViewError(
        "no graphics adapter was found, not even one in software, so there is nothing to draw a window with",
        hints=(
            "install a Vulkan driver; Mesa's runs without a GPU (Debian: apt-get install mesa-vulkan-drivers)",
            "or pip install pyside6, for a window without panels",
        ),
    )


def notebook_canvas(size: tuple[int, int]) -> Any:
    """A widget of the notebook."""
    module: Any = importlib.import_module("rendercanvas.anywidget")
    canvas = module.RenderCanvas(size=size, max_fps=30.0, update_mode="ondemand")
    # Never wider than its cell, which would have to be scrolled sideways.
    canvas.set_css_width(f"min({size[0]}px, calc(100% - {BORDER}px))")
    # As it closes, rendercanvas 2.7 tells itself so as the browser would, and closes, without end.
    canvas.close = _once(canvas.close)
    return canvas


def _once(function: Callable[[], object]) -> Callable[[], None]:
    """What calls a function the first time, and does nothing after that, nor while it runs."""
    left = [function]

    def call() -> None:
        if left:
            left.pop()()

    return call


def device_on(adapter: Any) -> Any:
    """A device for pictures and panels, with the least that they need."""
    return adapter.request_device_sync(label="zeroset window", required_limits={})


def plain_format(context: Any, adapter: Any) -> str:
    """The canvas's colour format without conversion: our bytes are sRGB already."""
    return str(context.get_preferred_format(adapter)).removesuffix("-srgb")
