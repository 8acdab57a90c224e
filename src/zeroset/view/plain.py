"""The window without panels, on a canvas that takes bitmaps: mouse and keys work, and wgpu draws nothing."""

from __future__ import annotations

from typing import Any

from zeroset.view.controls import Pane
from zeroset.view.session import Session
from zeroset.view.window import HANDLED


class PlainWindow:
    """Shows a session's pictures as bitmaps.

    Args:
        canvas: of rendercanvas.
        session: what runs behind it.
    """

    def __init__(self, canvas: Any, session: Session) -> None:
        self._canvas, self._session = canvas, session
        self._surface = canvas.get_bitmap_context()
        canvas.add_event_handler(self._handle, *HANDLED)
        canvas.request_draw(self._draw)

    def close(self) -> bool:
        """End what the window has begun, which is nothing; gives whether it has ended."""
        return True

    def _handle(self, event: dict[str, Any]) -> None:
        width, height = self._canvas.get_logical_size()
        self._session.handle(event, Pane(0.0, 0.0, max(1.0, width), max(1.0, height)))
        self._canvas.request_draw()

    def _draw(self) -> None:
        width, height = self._canvas.get_physical_size()
        more = self._session.tick((max(1, width), max(1, height)))
        picture = self._session.picture
        if picture is not None:
            self._surface.set_bitmap(picture.pixels)
        if more:
            self._canvas.request_draw()
