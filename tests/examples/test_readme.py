"""Every command and every program in README.md runs as it is printed, in an empty folder."""

from __future__ import annotations

import contextlib
import io
import itertools
import re
import shlex
from pathlib import Path

import pytest

from zeroset.cli import main

ROOT = Path(__file__).parents[2]
BLOCKS = re.findall(r"^```(\w*)\n(.*?)^```", (ROOT / "README.md").read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


def lines(*, starting: str) -> list[str]:
    """Lines of shell blocks; ones that end in a backslash go on."""
    joined = [text.replace("\\\n", " ") for language, text in BLOCKS if language in ("sh", "bash", "console", "shell")]
    stripped = [line.strip().removeprefix("$ ") for text in joined for line in text.splitlines()]
    return [line for line in stripped if line.startswith(starting)]


PROGRAMS = [text for language, text in BLOCKS if language == "python"]
MESSAGES = [text for language, text in BLOCKS if text.startswith("error:")]
COMMANDS = lines(starting="zeroset ")


def test_there_is_something_to_try() -> None:
    assert COMMANDS
    assert PROGRAMS
    assert lines(starting="scripts/")


@pytest.mark.parametrize("command", COMMANDS)
def test_commands(
    command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    _, *args = shlex.split(command, comments=True)
    assert main(args) == 0
    out, err = capsys.readouterr()
    assert out
    assert err == ""
    for option, name in itertools.pairwise(args):
        if option in ("-o", "--output", "--sheet", "--save-scene"):
            assert (tmp_path / name).stat().st_size > 100


@pytest.mark.parametrize("program", PROGRAMS, ids=[text.splitlines()[0] for text in PROGRAMS])
def test_programs(program: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    # One program may go on where the one before it ended.
    names: dict[str, object] = {"__name__": "__main__"}
    with contextlib.redirect_stdout(io.StringIO()):
        for earlier in PROGRAMS[: PROGRAMS.index(program) + 1]:
            exec(compile(earlier, "README.md", "exec"), names)


@pytest.mark.parametrize("message", MESSAGES, ids=[text.splitlines()[0] for text in MESSAGES])
def test_error_messages(message: str, capsys: pytest.CaptureFixture[str]) -> None:
    formula = message.splitlines()[1].strip()
    assert main(["render", formula, "-o", "unwritten.png"]) == 2
    assert capsys.readouterr().err.startswith(message.rstrip("\n"))


@pytest.mark.parametrize("line", lines(starting="scripts/"))
def test_scripts_are_there(line: str) -> None:
    script = ROOT / line.split()[0]
    assert script.is_file()
    assert script.stat().st_mode & 0o111, f"{script.name} cannot be executed"
    assert script.read_text().startswith("#!/")


def test_links_lead_somewhere() -> None:
    targets = re.findall(r"\]\(([^)#:]+)\)", (ROOT / "README.md").read_text(encoding="utf-8"))
    assert [target for target in targets if not (ROOT / target).exists()] == []
