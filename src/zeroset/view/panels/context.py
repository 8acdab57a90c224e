"""What a panel may look at besides the state."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from zeroset.view.session import Session
from zeroset.view.theme import Fonts


@dataclass
class Context:
    """What panels share.

    Attributes:
        imgui: the module.
        session: what runs behind the window; to be looked at.
        fonts: for words and formulas.
        thumbnails: draws a gallery surface's picture at the cursor, given its name and side.
        fields: texts being typed that are no part of the state (yet), by name.
    """

    imgui: Any
    session: Session
    fonts: Fonts
    thumbnails: Any
    fields: dict[str, str] = field(default_factory=dict)
