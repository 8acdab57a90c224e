"""How the panels look: fonts, colours, distances."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

Color = tuple[float, float, float]

BACK: Color = (0.082, 0.090, 0.106)
PANEL: Color = (0.105, 0.114, 0.133)
FIELD: Color = (0.157, 0.169, 0.196)
FIELD_HOT: Color = (0.204, 0.220, 0.255)
TEXT: Color = (0.878, 0.890, 0.910)
FAINT: Color = (0.545, 0.573, 0.624)
ACCENT: Color = (0.949, 0.604, 0.239)
ERROR: Color = (1.0, 0.498, 0.451)
GOOD: Color = (0.447, 0.820, 0.561)
SIDEBAR = 348.0
"""Width of the sidebar, in logical pixels."""
LABEL = 88.0
"""Where fields begin, right of their labels."""
SIZE = 15.0
"""Size of the text, in logical pixels."""


@dataclass(frozen=True)
class Fonts:
    """The two fonts: for words, and for formulas."""

    words: Any
    code: Any


def load_fonts(imgui: Any) -> Fonts:
    """Roboto with icons, and Inconsolata, as they come with imgui-bundle."""
    import imgui_bundle

    folder = Path(imgui_bundle.__file__).parent / "assets" / "fonts"
    atlas = imgui.get_io().fonts
    roboto = str(folder / "Roboto" / "Roboto-Regular.ttf")
    words = atlas.add_font_from_file_ttf(roboto, SIZE)
    config = imgui.ImFontConfig()
    config.merge_mode = True
    atlas.add_font_from_file_ttf(str(folder / "Font_Awesome_6_Free-Solid-900.otf"), SIZE * 0.8, config)
    code = atlas.add_font_from_file_ttf(str(folder / "Inconsolata-Medium.ttf"), SIZE)
    # Inconsolata has no Greek letters, which parameters may be.
    atlas.add_font_from_file_ttf(roboto, SIZE, config)
    return Fonts(words, code)


def apply(imgui: Any) -> None:
    """Set colours and distances."""
    style = imgui.get_style()
    imgui.style_colors_dark()
    style.font_size_base = SIZE
    style.window_padding = (14.0, 12.0)
    style.frame_padding = (8.0, 5.0)
    style.item_spacing = (8.0, 7.0)
    style.item_inner_spacing = (6.0, 5.0)
    style.scrollbar_size = 10.0
    style.grab_min_size = 12.0
    for name in ("frame_rounding", "grab_rounding", "popup_rounding", "child_rounding", "scrollbar_rounding"):
        setattr(style, name, 5.0)
    style.window_border_size = style.frame_border_size = style.child_border_size = 0.0
    style.popup_border_size = 1.0
    for names, color, alpha in _COLORS:
        for name in names.split():
            style.set_color_(getattr(imgui.Col_, name), (*color, alpha))


_COLORS: tuple[tuple[str, Color, float], ...] = (
    ("window_bg", PANEL, 1.0),
    ("child_bg", BACK, 1.0),
    ("popup_bg", (0.13, 0.14, 0.165), 0.98),
    ("frame_bg button header", FIELD, 1.0),
    ("frame_bg_hovered button_hovered header_hovered", FIELD_HOT, 1.0),
    ("frame_bg_active button_active header_active", (0.25, 0.27, 0.31), 1.0),
    ("slider_grab check_mark input_text_cursor", ACCENT, 1.0),
    ("slider_grab_active", (1.0, 0.72, 0.40), 1.0),
    ("checkbox_selected_bg", FIELD, 1.0),
    ("text", TEXT, 1.0),
    ("text_disabled", FAINT, 1.0),
    ("text_selected_bg", ACCENT, 0.30),
    ("border separator", (0.20, 0.215, 0.245), 1.0),
    ("scrollbar_bg", BACK, 0.0),
    ("scrollbar_grab", (0.25, 0.27, 0.31), 1.0),
    ("scrollbar_grab_hovered scrollbar_grab_active", (0.35, 0.37, 0.42), 1.0),
    ("plot_lines plot_histogram", ACCENT, 1.0),
)
