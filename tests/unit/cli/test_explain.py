from __future__ import annotations

from collections.abc import Callable

import pytest
from tests.gpus import needs_gpu

from zeroset.errors import DeviceError
from zeroset.kernel.passes import PASSES
from zeroset.runtime import Device, get_device, registry
from zeroset.runtime.gpu import adapter
from zeroset.runtime.gpu.device import GpuDevice

Run = Callable[..., object]


def test_the_short_form_fits_a_screen(zeroset: Run) -> None:
    ran = zeroset("explain", "x^2 + a*y = 1", "-p", "a=2", "-b", "2")
    assert ran.status == 0
    assert "formula     x^2 + a*y - 1 = 0" in ran.out
    assert "polynomial of degree 2" in ran.out
    assert "a = 2" in ran.out
    assert "%4 = mul %2, %3" in ran.out
    for kernel in ("beams", "primary", "second", "parts", "shade"):
        assert f"\n  {kernel}" in ran.out
    assert len(ran.out.splitlines()) < 40


def test_what_parameters_alone_decide_is_shown(zeroset: Run) -> None:
    ran = zeroset("explain", "2a x + y = floor(b/3)", "-p", "a=1", "-p", "b=4", "-b", "2")
    assert ran.status == 0
    assert "in kernels  part 0*x + y - part 1 = 0" in ran.out
    assert "\n  part 0 = 2*a = 2\n" in ran.out
    assert "\n  part 1 = floor(1/3*b) = 1\n" in ran.out
    assert "in kernels" not in zeroset("explain", "x + a y", "-p", "a=2", "-b", "2").out


def test_a_gallery_surface_and_a_method_without_proof(zeroset: Run) -> None:
    ran = zeroset("explain", "barth-sextic", "-m", "marching-points")
    assert ran.status == 0
    assert "barth-sextic" in ran.out
    assert "not certified" in ran.out
    assert "beams" not in ran.out
    ran = zeroset("explain", "blinn-blobby", "--dag")
    assert ran.status == 0
    assert "sum" in ran.out


def test_a_kernel_after_each_pass(zeroset: Run) -> None:
    ran = zeroset("explain", "x + y", "-b", "2", "--kernel", "shade", "--passes")
    heads = [line for line in ran.out.splitlines() if line.startswith("# shade, ")]
    assert [head.split(",")[1].split(":")[0].strip() for head in heads] == ["traced", *PASSES]
    last = zeroset("explain", "x + y", "-b", "2", "--kernel", "shade")
    assert last.out.startswith("# shade, dce: ")
    assert "kernel shade(" in last.out
    traced = zeroset("explain", "x + y", "-b", "2", "--kernel", "shade", "--pass", "traced")
    assert len(traced.out) > len(last.out)


def test_the_target_code(zeroset: Run) -> None:
    ran = zeroset("explain", "x + y", "-b", "2", "--kernel", "shade", "--target", "llvm")
    assert "define internal void @kernel" in ran.out
    ran = zeroset("explain", "x + y", "-b", "2", "--kernel", "shade", "--target", "asm")
    assert "drain:" in ran.out
    assert "ret" in ran.out


def test_a_shader_needs_no_gpu(zeroset: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(adapter, "likely", lambda: False)
    ran = zeroset("explain", "x + y", "-b", "2", "--kernel", "shade", "--target", "wgsl")
    assert ran.status == 0
    first, *rest = ran.out.splitlines()
    assert first == "// for a GPU with the least that zeroset needs: nothing optional"
    assert "@compute @workgroup_size(64)" in rest
    assert "subgroupAny" not in ran.out


@needs_gpu
def test_a_shader_is_the_one_that_the_gpu_here_gets(zeroset: Run) -> None:
    gpu = get_device("gpu")
    assert isinstance(gpu, GpuDevice)
    ran = zeroset("explain", "x^2 + y", "-b", "2", "--target", "wgsl", "-d", "gpu")
    assert ran.status == 0
    head = ran.out.splitlines()[0]
    assert gpu.found.title in head
    assert ("subgroups" in head, "doubles" in head) == (gpu.target.subgroups, gpu.target.doubles)


def test_a_gpu_asked_for_by_name_must_be_there(zeroset: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def none() -> Device:
        raise DeviceError("there is no GPU", hint="buy one")

    monkeypatch.setattr(registry, "_made", {})
    monkeypatch.setitem(registry.DEVICES, "gpu", none)
    monkeypatch.setattr(adapter, "likely", lambda: True)
    asked = ("explain", "x", "-b", "1", "--kernel", "shade", "--target", "wgsl")
    assert zeroset(*asked).out.startswith("// for a GPU with the least")
    ran = zeroset(*asked, "-d", "gpu")
    assert ran.status == 2
    assert "there is no GPU" in ran.err


@pytest.mark.parametrize(
    ("args", "said"),
    [
        (["x +"], "a value is missing"),
        (["x", "-b", "1", "--kernel", "primry"], "did you mean primary"),
        (["x", "-b", "1", "--kernel", "beams", "-m", "marching-points"], "there are primary, shade"),
        (["x", "-b", "1", "--kernel", "shade", "--pass", "fould"], "did you mean fold"),
        (["x", "-b", "1", "--target", "glsl"], "there are llvm, asm, wgsl"),
        (["sin(x)", "-b", "1", "-m", "analytic"], "needs a polynomial"),
    ],
)
def test_mistakes(args: list[str], said: str, zeroset: Run) -> None:
    ran = zeroset("explain", *args)
    assert ran.status == 2
    assert said in ran.err
    assert ran.out == ""
