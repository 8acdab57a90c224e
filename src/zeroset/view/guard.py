"""Keeps a window alive where a panel fails: what it was to change stays as it was, and the user is told why.

Panels open groups and close them again. An error in between would leave them open, and from then on no frame could be
drawn; Dear ImGui closes what was opened since it was asked to remember where it stood.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from zeroset.view.state import State
from zeroset.view.worker import told


class Guard:
    """Draws panels.

    Args:
        imgui: the module; the present context is the window's.
        say: tells the user something.

    Attributes:
        failures: how often one has failed.
    """

    def __init__(self, imgui: Any, say: Callable[[str], object]) -> None:
        self._imgui = imgui
        self._say = say
        self.failures = 0
        io = imgui.get_io()
        # It has to report what it closes in one way at least.
        io.config_error_recovery_enable_debug_log = True
        io.config_error_recovery_enable_assert = False
        io.config_error_recovery_enable_tooltip = False

    def drawn(self, state: State, draw: Callable[[State], State]) -> State:
        """What a panel makes of the state; the same state where it fails."""
        internal = self._imgui.internal
        place = internal.ErrorRecoveryState()
        internal.error_recovery_store_state(place)
        try:
            return draw(state)
        except Exception as error:
            internal.error_recovery_try_to_recover_state(place)
            self.failures += 1
            self._say(told(error))
            return state
