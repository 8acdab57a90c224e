"""``zeroset bench``: what its tables hold; never how fast anything was."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from tests.gpus import needs_gpu

from zeroset.cli import main
from zeroset.runtime import get_device
from zeroset.runtime.gpu.device import GpuDevice

TINY = ("--size", "64", "--seconds", "0", "--threads", "1")


def _cells(printed: str) -> list[list[str]]:
    lines = [line for line in printed.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def test_two_surfaces_in_markdown_and_json(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "figures.json"
    assert main(["bench", "barth-sextic", "blinn-blobby", *TINY, "--markdown", "--json", str(file)]) == 0
    head, rule, *rows = _cells(capsys.readouterr().out)
    assert head[0] == "surface"
    assert {"64²", "limit", "ratio", "steps"} < set(head)
    assert set(rule) == {":--", "--:"}
    assert [row[0] for row in rows] == ["barth-sextic", "blinn-blobby"]
    assert all(len(row) == len(head) for row in rows)

    figures = json.loads(file.read_text())
    assert figures["machine"]["threads"] == 1
    for result in figures["results"]:
        assert result["error"] == ""
        assert result["compile"] > result["load"] > 0
        (frame,) = result["frames"]
        assert frame["size"] == 64
        assert frame["hits"] > 100
        assert frame["steps"] > 0
        assert frame["ratio"] == pytest.approx(frame["frame"]["best"] / frame["limit"]["best"])
        assert frame["frame"]["count"] >= 3


def test_both_sizes_have_columns(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", "goursat", *TINY, "--size", "32", "--markdown"]) == 0
    head, _, row = _cells(capsys.readouterr().out)
    assert [cell for cell in head if cell.endswith("²")] == ["64²", "32²"]
    assert len(row) == len(head)


def test_table_for_people(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", "goursat", *TINY]) == 0
    out = capsys.readouterr().out
    assert "goursat" in out
    assert "ratio" in out


def test_what_a_method_cannot_draw_is_named_and_the_rest_is_done(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", "blobby", "goursat", *TINY, "--markdown", "--method", "analytic"]) == 0
    _, _, refused, drawn = _cells(capsys.readouterr().out)
    assert refused[0].startswith("blobby: ")
    assert len(refused[0]) > len("blobby: ")
    assert drawn[0] == "goursat"
    assert all(drawn)


def test_interruption_prints_what_is_done(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from zeroset.bench import frames

    measured = frames.measure

    def interrupted(surface: object, *rest: object) -> object:
        if getattr(surface, "name", "") == "clebsch":
            raise KeyboardInterrupt
        return measured(surface, *rest)  # type: ignore[arg-type]

    monkeypatch.setattr(frames, "measure", interrupted)
    file = tmp_path / "figures.json"
    assert main(["bench", "goursat", "clebsch", "kummer", *TINY, "--markdown", "--json", str(file)]) == 130
    _, _, *rows = _cells(capsys.readouterr().out)
    assert [row[0] for row in rows] == ["goursat"]
    assert not file.exists()


def test_memory(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", "--memory", "--frames", "3", *TINY, "--markdown"]) == 0
    head, _, row = _cells(capsys.readouterr().out)
    cells = dict(zip(head, row, strict=True))
    assert cells["surface"] == "tangle"
    assert cells["frames"] == "3"
    assert cells["moving"] == "camera, r"
    assert cells["compilations after the first frame"] == "0"


@needs_gpu
def test_memory_on_a_gpu(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", "--memory", "--device", "gpu", "--frames", "14", "--size", "32", "--markdown"]) == 0
    head, _, row = _cells(capsys.readouterr().out)
    cells = dict(zip(head, row, strict=True))
    assert cells["GPU objects"] == "+0"
    assert cells["compilations after the first frame"] == "0"


@needs_gpu
def test_frames_on_a_gpu(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "figures.json"
    assert main(["bench", "goursat", "--device", "gpu", *TINY, "--markdown", "--json", str(file)]) == 0
    head, _, row = _cells(capsys.readouterr().out)
    assert {"made", "first", "whole", "again", "64² GPU", "in flight", "host", "limit", "ratio", "steps"} < set(head)
    assert len(row) == len(head)
    figures = json.loads(file.read_text())
    assert figures["machine"]["gpu"]
    (frame,) = figures["results"][0]["frames"]
    assert frame["hits"] > 100
    assert 0 < frame["host"]["best"] <= frame["wall"]["best"]
    if frame["gpu"] is not None:
        assert frame["ratio"] == pytest.approx(frame["gpu"]["best"] / frame["limit"]["best"])


@needs_gpu
def test_passes_of_a_frame(capsys: pytest.CaptureFixture[str]) -> None:
    gpu = get_device("gpu")
    assert isinstance(gpu, GpuDevice)
    if gpu.stream.clock is None:
        pytest.skip(f"{gpu.found.name} has no clock")
    assert main(["bench", "goursat", "--passes", "--device", "gpu", *TINY, "--markdown"]) == 0
    head, _, row = _cells(capsys.readouterr().out)
    assert head[:4] == ["surface", "size", "beams", "primary"]
    assert head[-3:] == ["shade", "between", "frame"]
    cells = dict(zip(head, row, strict=True))
    # Its runs: tiles, blocks of pixels, quarters of them, pixels, parts.
    assert cells["beams"].count("+") == 4
    assert all(float(cells[name]) >= 0 for name in ("primary", "shade", "frame"))


def test_papers(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "figures.json"
    arguments = ["bench", "peninsula", "--papers", "--seconds", "0", "--device", "cpu", "--threads", "1"]
    assert main([*arguments, "--markdown", "--json", str(file)]) == 0
    _, _, row = _cells(capsys.readouterr().out)
    assert row[:4] == ["peninsula", "512²", "SN10, Table 5", "535 (AMP Taylor, tuned)"]
    (result,) = json.loads(file.read_text())["results"]
    assert float(row[4]) == pytest.approx(1e3 / result["wall"]["median"], rel=1e-3)
    assert float(row[5]) == pytest.approx(1e3 / result["wall"]["median"] / 535, rel=1e-2)
    assert row[6:8] == ["-", "-"]


def test_one_kind_at_a_time(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", "tangle", "--memory", "--light"]) == 2
    assert "--memory and --light are measured one at a time" in capsys.readouterr().err


def test_cold(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", "goursat", "--cold", "--runs", "1", "--size", "16", "--markdown"]) == 0
    head, _, row = _cells(capsys.readouterr().out)
    cells = dict(zip(head, row, strict=True))
    assert cells["formula of"] == "goursat"
    assert all(cells[name].endswith(" s") for name in ("cold", "warm", "python alone"))


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["no-such-surface"], "no-such-surface"),
        (["--size", "0"], "0"),
        (["--method", "no-such-method"], "no-such-method"),
        (["--device", "no-such-device"], "no-such-device"),
        (["--json", "no-such-folder/x.json"], "no-such-folder"),
        (["--papers", "goursat", "--size", "64"], "leave --size out"),
        (["--papers", "chmutov-30"], "no paper has a frame rate"),
        (["--passes", "--device", "cpu"], "only a GPU"),
    ],
)
def test_mistakes_are_named_before_anything_is_timed(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["bench", *arguments]) == 2
    captured = capsys.readouterr()
    assert said in captured.err
    assert captured.out == ""


def test_what_light_costs(zeroset: Any) -> None:
    ran = zeroset("bench", "--light", "sphere", "-s", "32", "--seconds", "0", "--markdown")
    assert (ran.status, ran.err) == (0, "")
    rows = [line.split("|")[1:-1] for line in ran.out.splitlines() if line.startswith("| sphere")]
    assert [row[1].strip() for row in rows] == [
        "one shadow light",
        "four layers",
        "six reflections",
        "glass",
        "smooth edges, 16",
        "two isovalues",
    ]
    assert all(float(row[5]) > 0 for row in rows)
