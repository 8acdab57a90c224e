"""The way in: what is checked before a window is opened, and what is said when there can be none."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

import zeroset as zs
from zeroset.errors import MethodError, OutputError, ParameterError, ViewError
from zeroset.view import canvas, errands, notebook
from zeroset.view.hud import fitting
from zeroset.view.log import Log
from zeroset.view.panels import bounds as bounds_panel
from zeroset.view.panels import light as light_panel
from zeroset.view.panels import method as method_panel
from zeroset.view.panels.gallery import matching
from zeroset.view.show import scene_of, start, window
from zeroset.view.state import BACKGROUND

LINUX = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="elsewhere there is always a display")


def test_text_surface_or_scene() -> None:
    scene, texts = scene_of("x^2 + b*y = 1")
    assert (scene.background, texts) == (BACKGROUND, ("x^2 + b*y = 1",))
    assert [dict(surface.params) for surface in scene.surface.surfaces] == [{"b": 1.0}]
    assert scene_of(zs.gallery["ding-dong"])[1] == ("x^2 + y^2 = (1 - z) z^2",)
    own = zs.Scene(zs.surface("x = y"), background=(1.0, 0.0, 0.0))
    assert scene_of(own) == (own, ("x - y",))


def test_a_solid_is_shown_as_one_formula() -> None:
    ball, rod = zs.surface("x^2 + y^2 + z^2 = r^2", {"r": 1.0}), zs.surface("x^2 + y^2 = 0.1")
    for source in (ball - rod, zs.Scene(ball - rod)):
        scene, texts = scene_of(source)
        assert isinstance(scene.surface, zs.Surface)
        assert texts == (scene.surface.formula,) == ("max(x^2 + y^2 + z^2 - r^2, 0.1 - (x^2 + y^2))",)


def test_several_things_have_a_box_each() -> None:
    ball, rod, ground = zs.surface("x^2 + y^2 + z^2 = 1"), zs.surface("x^2 + y^2 = 0.1"), zs.gallery["ding-dong"]
    scene, texts = scene_of([ball - rod, ground])
    assert texts == ("max(x^2 + y^2 + z^2 - 1, 0.1 - (x^2 + y^2))", "x^2 + y^2 = (1 - z) z^2")
    assert scene.surface.surfaces[1] == ground
    assert scene.background == BACKGROUND


def test_a_method_that_cannot_is_refused_before_there_is_a_window() -> None:
    shells = zs.surface("x^2 + y^2 + z^2").with_isovalues((1.0, 2.0))
    with pytest.raises(MethodError, match="marching-points cannot treat several isovalues"):
        start(*scene_of(shells), zs.methods.MarchingPoints(), "cpu", None)


def test_a_changed_gallery_surface_shows_its_own_formula() -> None:
    changed = zs.surface("x = y", name="ding-dong")
    assert scene_of(changed)[1] == (changed.formula,)


@LINUX
def test_without_a_display_it_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("glfw")
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    monkeypatch.setattr(canvas, "check_packages", lambda names, extra: None)
    with pytest.raises(ViewError, match="no display"):
        zs.show("x^2 + y^2 + z^2 = 1")


@LINUX
def test_a_display_that_does_not_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("glfw")
    monkeypatch.setenv("DISPLAY", ":6543")
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    with pytest.raises(ViewError, match=":6543 does not answer"):
        canvas.check_display()


def test_what_is_not_installed_is_named_with_the_command(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(canvas, "find_spec", lambda name: None if name in ("glfw", "imgui_bundle") else object())
    with pytest.raises(ViewError) as caught:
        zs.show("x^2 + y^2 + z^2 = 1")
    assert "glfw, imgui-bundle, which are not installed" in str(caught.value)
    assert caught.value.hint == 'pip install "zeroset[desktop]"'


def test_without_any_adapter_and_toolkit_it_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(canvas, "find_spec", lambda name: None)
    with pytest.raises(ViewError, match="no graphics adapter"):
        canvas.desktop_canvas((640, 480), "", False)


@pytest.mark.parametrize("size", [(10, 10), (800, 10**6), ("a", 3), 5])
def test_sizes_of_windows(size: Any) -> None:
    state = start(*scene_of("x = y"), zs.methods.Auto(), "auto", None)
    with pytest.raises((ViewError, ParameterError), match="window"):
        window(state, size, Log(None))


def test_the_command_line_says_it_in_one_message(zeroset_command: Callable[..., tuple[int, str]]) -> None:
    for args in (
        ["x^2 +"],
        ["barth-sextik"],
        ["x=y", "-m", "nonesuch"],
        ["x=y", "-d", "toaster"],
        ["x=y", "--log", "."],
        ["x=y", "--isovalues", "1,?"],
        ["x=y", "--isovalues", "0,1", "-m", "marching-points"],
    ):
        status, text = zeroset_command("view", *args)
        assert status == 2
        assert text.startswith("error: ")


def test_a_notebook_is_told_from_a_script(monkeypatch: pytest.MonkeyPatch) -> None:
    assert not notebook.running()

    class Shell:
        def has_trait(self, name: str) -> bool:
            return name == "kernel"

    monkeypatch.setitem(sys.modules, "IPython", type("IPython", (), {"get_ipython": staticmethod(Shell)})())
    assert notebook.running()
    with pytest.raises(ViewError, match="a window of 10x10 is not possible"):
        zs.show("x = y", size=(10, 10))


def test_the_log_cannot_be_written_where_there_is_no_folder(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="cannot write"):
        Log(tmp_path / "no" / "log.jsonl")


def test_sizes_that_are_typed() -> None:
    assert errands.read_size(" 640X480 ", (1, 1)) == (640, 480)
    for wrong in ("3x", "a", "1x2x3", "-"):
        with pytest.raises(zs.ZerosetError, match="cannot read the size"):
            errands.read_size(wrong, (1, 1))


@pytest.mark.parametrize("name", list(zs.methods.METHODS))
def test_every_option_of_every_method_has_a_field(name: str) -> None:
    import dataclasses

    method = zs.methods.METHODS[name]()
    for field in dataclasses.fields(method):
        value = getattr(method, field.name)
        assert isinstance(value, (bool, int, float, str))
        if isinstance(value, str):
            assert value in method_panel.CHOICES[field.name]
            for word in method_panel.CHOICES[field.name]:
                assert getattr(dataclasses.replace(method, **{field.name: word}), field.name) == word


def test_an_option_that_is_refused_stays_as_it_was() -> None:
    fields: dict[str, str] = {}
    method = zs.methods.MarchingPoints(steps=20)
    assert method_panel.changed_method(method, "steps", -1.0, fields) is method
    assert "steps" in fields["method"]
    assert method_panel.changed_method(method, "steps", 30.0, fields) == zs.methods.MarchingPoints(steps=30.0)
    assert fields == {}


def test_why_a_method_cannot_draw_stands_beside_it() -> None:
    ball = zs.surface("x^2 + y^2 + z^2 = 1 + sin(5x)/9", bounds=2)
    assert method_panel.refusal(ball, zs.methods.Mitchell()) == ""
    assert "isovalues" in method_panel.refusal(ball.with_isovalues((0, 1)), zs.methods.Mitchell())
    assert "no polynomial" in method_panel.refusal(ball, zs.methods.Analytic())


def test_a_light_stays_where_it_is_seen() -> None:
    camera = zs.Camera(eye=(2.0, -3.0, 1.0))
    for headlight in (True, False):
        light = zs.Light((0.3, -0.5, 0.8), headlight=headlight)
        toward = light_panel.seen(light, camera)
        assert light_panel.seen(light_panel.placed(light, camera, toward), camera) == pytest.approx(toward)
    around, height = light_panel.angles((0.3, -0.5, 0.8))
    unit = tuple(v / 0.98**0.5 for v in (0.3, -0.5, 0.8))
    assert light_panel.direction(around, height) == pytest.approx(unit)


def test_a_lamp_that_is_dragged_becomes_a_light_far_away() -> None:
    camera = zs.Camera(eye=(0.0, -4.0, 0.0))
    for headlight, place in ((False, (3.0, 0.0, 0.0)), (True, (3.0, 0.0, -4.0))):
        lamp = zs.Light(position=place, headlight=headlight)
        assert light_panel.seen(lamp, camera) == pytest.approx((1.0, 0.0, 0.0))
        dragged = light_panel.placed(lamp, camera, (0.0, 1.0, 0.0))
        assert dragged.position is None
        assert light_panel.seen(dragged, camera) == pytest.approx((0.0, 1.0, 0.0))


def test_ball_and_box_hold_one_another() -> None:
    assert bounds_panel.other(zs.Ball(1.0, (1, 2, 3))) == zs.Box((0, 1, 2), (2, 3, 4))
    ball = bounds_panel.other(zs.Box((0, 0, 0), (2, 2, 1)))
    assert ball == zs.Ball(1.5, (1.0, 1.0, 0.5))


def test_the_gallerys_filter() -> None:
    assert matching("") == tuple(zs.gallery)
    assert matching("CHMUTOV 7") == ("chmutov-7",)
    assert matching("nothing of the kind") == ()


def test_nothing_that_draws_windows_is_loaded_before_there_is_one() -> None:
    import subprocess

    program = (
        "import sys, zeroset.view.show, zeroset.view.window, zeroset.view.plain, zeroset.cli.view, zeroset.view.atlas\n"
        "print(*sorted({'wgpu', 'rendercanvas', 'glfw', 'imgui_bundle', 'PIL', 'llvmlite'} & set(sys.modules)))"
    )
    found = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == ""


def test_a_narrow_picture_keeps_the_word_on_what_is_proven() -> None:
    widths = [52.0, 70.0, 90.0, 100.0, 28.0, 60.0]
    assert fitting(widths, 18.0, 600.0) == [0, 1, 2, 3, 4, 5]
    assert fitting(widths, 18.0, 450.0) == [0, 2, 3, 4, 5]
    assert fitting(widths, 18.0, 400.0) == [0, 2, 3, 5]
    assert fitting(widths, 18.0, 200.0) == [3, 5]
    assert fitting(widths, 18.0, 10.0) == [5]
    # What comes after it is a message, and stays.
    assert fitting([*widths, 150.0], 18.0, 10.0) == [5, 6]


def test_opengl_draws_no_windows(monkeypatch: pytest.MonkeyPatch) -> None:
    wgpu = pytest.importorskip("wgpu")
    for kind, drawn in (("OpenGL", False), ("Vulkan", True)):
        adapter = SimpleNamespace(info={"backend_type": kind})
        monkeypatch.setattr(wgpu.gpu, "request_adapter_sync", lambda found=adapter, **options: found)
        assert (canvas.find_adapter() is adapter) == drawn
