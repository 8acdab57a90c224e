"""The window: a canvas with the picture and the panels on it, and the events between them and the session."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from zeroset.view import hud, theme
from zeroset.view.atlas import Atlas
from zeroset.view.canvas import device_on, plain_format
from zeroset.view.controls import Pane
from zeroset.view.guard import Guard
from zeroset.view.panels import PANELS, formula, surfaces
from zeroset.view.panels.context import Context
from zeroset.view.picture import PictureView
from zeroset.view.session import Session
from zeroset.view.standin import slow_to_compile
from zeroset.view.state import State
from zeroset.view.thumbnails import Thumbnails

LINGER = 6
"""Frames that are drawn after an event: panels answer to some of them a frame later."""
BLINK = 4.0
"""Frames a second while text is edited, for its cursor."""
HANDLED = ("pointer_down", "pointer_up", "pointer_move", "wheel", "double_click", "key_down", "key_up")
POINTED = ("pointer_down", "pointer_up", "pointer_move")
HEARD = (*HANDLED, "char", "resize", "pointer_enter", "pointer_leave")


class Window:
    """Draws a session on a canvas with wgpu, panels included.

    Args:
        canvas: of rendercanvas.
        adapter: of wgpu.
        session: what runs behind it; its ``wake`` should ask the canvas for a draw.
    """

    def __init__(self, canvas: Any, adapter: Any, session: Session) -> None:
        from imgui_bundle import imgui
        from wgpu.utils.imgui import ImguiRenderer

        self._canvas, self._session, self._imgui = canvas, session, imgui
        device = device_on(adapter)
        self._surface = canvas.get_wgpu_context()
        target = plain_format(self._surface, adapter)
        self._surface.configure(device=device, format=target)
        self._panels = ImguiRenderer(device, canvas)
        self._panels.set_gui(self._gui)
        self._picture_view = PictureView(device, target)
        self._uploaded: Any = None
        self._linger = LINGER
        self._cursor = "default"
        self._editing = False
        theme.apply(imgui)
        self._guard = Guard(imgui, session.notes.say)
        device_name = "cpu" if slow_to_compile(session.state.device) else session.state.device
        self._thumbnails = Thumbnails(device_name, lambda: session.resting, self._wake)
        atlas = Atlas(device, self._panels.backend.register_texture, self._thumbnails)
        self._context = Context(imgui, session, theme.load_fonts(imgui), atlas)
        canvas.add_event_handler(self._heard, *HEARD, order=-100)
        canvas.add_event_handler(self._handle, *HANDLED)
        canvas.request_draw(self._draw)

    # ---------------------------------------------------------------- events

    def _wake(self) -> None:
        self._canvas.request_draw()

    def _heard(self, event: dict[str, Any]) -> None:
        """Any event: it will be seen in the next frames."""
        self._linger = LINGER
        self._canvas.request_draw()
        if event["event_type"] in POINTED:
            self._point(event)
        if event["event_type"] == "pointer_up":
            # Wherever the button is let go, the drag ends.
            self._session.handle(event, self._pane())

    def _point(self, event: dict[str, Any]) -> None:
        """Tell the panels where the pointer is, and what is held with it; they hear of the button itself after this.

        A finger does not hover before it presses, and a browser's moves may come after the press. When frames are
        slow, a last move and the button's release come together: only from a touch screen do the panels take them one
        after the other, so that a slider ends where it was let go. A notebook's widget hears of no keys before it has
        been clicked on, nor of their release when the keyboard has gone elsewhere meanwhile.
        """
        source, io = self._imgui.MouseSource, self._panels.backend.io
        io.add_mouse_source_event(source.touch_screen if event["event_type"] == "pointer_up" else source.mouse)
        io.add_mouse_pos_event(event["x"], event["y"])
        for name, key in self._panels.KEY_MAP_MOD.items():
            io.add_key_event(key, name in event["modifiers"])

    def _handle(self, event: dict[str, Any]) -> None:
        """An event that the panels have left for the picture."""
        # Not Dear ImGui's present context: where there are several windows, that is the one that was drawn last.
        kind, io = event["event_type"], self._panels.backend.io
        # Panels keep most of what is theirs, but let through double clicks and keys that they have no name for.
        if io.want_capture_mouse if kind == "double_click" else kind == "key_down" and io.want_capture_keyboard:
            return
        self._session.handle(event, self._pane())

    def close(self) -> bool:
        """End what the window has begun; gives whether it has ended."""
        return self._thumbnails.close()

    # ---------------------------------------------------------------- drawing

    def _pane(self) -> Pane:
        width, height = self._canvas.get_logical_size()
        side = min(theme.SIDEBAR, 0.6 * width)
        return Pane(side, 0.0, max(1.0, width - side), max(1.0, height))

    def _draw(self) -> None:
        _, _, width, height = self._place()
        more = self._session.tick((max(1, width), max(1, height)))
        self._context.thumbnails.update()
        # The panels say what is wanted before anything is drawn: see ``_gui``.
        self._panels.render()
        more = self._session.follow() or more
        self._linger -= 1
        if more or self._linger > 0:
            self._canvas.request_draw()

    def _place(self) -> tuple[int, int, int, int]:
        """Where the picture is, in pixels of the canvas."""
        width, height = self._canvas.get_physical_size()
        left = round(self._pane().x * self._canvas.get_pixel_ratio())
        return left, 0, width - left, height

    def _show_picture(self) -> None:
        """Draw the picture under the panels, whose own drawing is only handed over after this."""
        picture = self._session.picture
        if picture is not None and picture is not self._uploaded:
            self._picture_view.upload(picture.pixels)
            self._uploaded = picture
        target = self._surface.get_current_texture().create_view()
        left, top, width, height = self._place()
        self._picture_view.draw(target, (left, top, width, height), theme.BACK)

    def _gui(self) -> None:
        """Let the panels change the state, then wait a moment for its picture, so that both appear together."""
        imgui, state = self._imgui, self._session.state
        pane = self._pane()
        imgui.set_next_window_pos((0.0, 0.0))
        imgui.set_next_window_size((pane.x, pane.height))
        flags = imgui.WindowFlags_.no_decoration & ~imgui.WindowFlags_.no_scrollbar
        flags |= imgui.WindowFlags_.no_move | imgui.WindowFlags_.no_saved_settings
        imgui.begin("##sidebar", None, flags | imgui.WindowFlags_.no_bring_to_front_on_focus)
        for always in (surfaces.draw, formula.draw):
            state = self._guarded(always, state)
        for title, draw, opened in PANELS:
            imgui.set_next_item_open(opened(state), imgui.Cond_.first_use_ever)
            if imgui.collapsing_header(title):
                imgui.push_id(title)
                state = self._guarded(draw, state)
                imgui.pop_id()
                imgui.spacing()
        imgui.end()
        self._session.state = state
        self._session.follow()
        self._session.catch_up()
        hud.draw(self._session.state, self._context, pane)
        self._follow_cursor()
        self._show_picture()

    def _guarded(self, draw: Callable[[State, Context], State], state: State) -> State:
        return self._guard.drawn(state, lambda known: draw(known, self._context))

    def _follow_cursor(self) -> None:
        """Show the pointer that the panels want, and keep the text cursor blinking."""
        imgui = self._imgui
        kinds = imgui.MouseCursor_
        names = {kinds.text_input: "text", kinds.hand: "pointer", kinds.resize_ew: "ew-resize"}
        cursor = names.get(imgui.get_mouse_cursor(), "default")
        if cursor != self._cursor:
            self._cursor = cursor
            self._canvas.set_cursor(cursor)
        editing = bool(imgui.get_io().want_text_input)
        if editing != self._editing:
            self._editing = editing
            self._canvas.set_update_mode("ondemand", min_fps=BLINK if editing else 0.0)


def desktop_clipboard(imgui: Any) -> Any:
    """Connect the panels to the system's clipboard; gives what puts text there."""
    import glfw as module

    # GLFW takes any window, none included; its annotations know only of one.
    glfw: Any = module

    def put(text: str) -> bool:
        glfw.set_clipboard_string(None, text)
        return True

    def get(context: Any) -> str:
        found = glfw.get_clipboard_string(None)
        return found.decode("utf-8", "replace") if found else ""

    def take(context: Any, text: str) -> None:
        put(text)

    platform = imgui.get_platform_io()
    platform.platform_set_clipboard_text_fn = take
    platform.platform_get_clipboard_text_fn = get
    return put
