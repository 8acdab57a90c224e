"""The programs and commands in docs/ run as they are printed; those that open windows or take minutes are left out."""

from __future__ import annotations

import contextlib
import io
import re
import shlex
from pathlib import Path

import pytest

from zeroset.cli import main

DOCS = Path(__file__).parents[2] / "docs"
ELSEWHERE = ("view", "bench")
"""Commands with tests of their own."""


def blocks(*languages: str) -> list[tuple[str, str]]:
    """File name and text of each block in one of these languages."""
    found = []
    for path in sorted(DOCS.glob("*.md")):
        text = path.read_text(encoding="utf-8")
        for language, body in re.findall(r"^```(\w*)\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
            if language in languages:
                found.append((path.name, body))
    return found


PROGRAMS = [(name, body) for name, body in blocks("python") if "zs.show" not in body]
LINES = [(name, line.strip()) for name, body in blocks("sh") for line in body.replace("\\\n", " ").splitlines()]
COMMANDS = [(name, line) for name, line in LINES if line.startswith("zeroset ") and line.split()[1] not in ELSEWHERE]


def test_there_is_something_to_try() -> None:
    assert PROGRAMS
    assert COMMANDS


@pytest.mark.parametrize(("name", "program"), PROGRAMS, ids=[f"{n}-{i}" for i, (n, _) in enumerate(PROGRAMS)])
def test_programs(name: str, program: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with contextlib.redirect_stdout(io.StringIO()):
        exec(compile(program, name, "exec"), {"__name__": "__main__"})


@pytest.mark.parametrize(("name", "command"), COMMANDS, ids=[line[:50] for _, line in COMMANDS])
def test_commands(
    name: str, command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    _, *args = shlex.split(command, comments=True)
    if args[0] == "figure" and len(args) > 1:
        # Whole figures are dozens of pictures: their commands are the same for small ones.
        args += ["--size", "12"]
    elif args[0] == "animate" and "--list" not in args:
        # Whole films are hundreds of pictures: likewise.
        args += ["--size", "64x48"]
    assert main(args) == 0, capsys.readouterr().err
