"""``zeroset bench``: what its tables hold; never how fast anything was."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from zeroset.cli import main

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
    ],
)
def test_mistakes_are_named_before_anything_is_timed(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["bench", *arguments]) == 2
    captured = capsys.readouterr()
    assert said in captured.err
    assert captured.out == ""
