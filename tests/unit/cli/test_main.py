from __future__ import annotations

from collections.abc import Callable

import click
import pytest

import zeroset as package
from zeroset import cli
from zeroset.cli import COMMANDS, as_options

Run = Callable[..., object]


def test_help_lists_the_commands_and_each_has_its_own(zeroset: Run) -> None:
    ran = zeroset("--help")
    assert ran.status == 0
    for name, text in COMMANDS.items():
        assert name in ran.out
        assert text in ran.out
        own = zeroset(name, "-h")
        assert own.status == 0
        assert f"zeroset {name}" in own.out
    assert zeroset("--version").out.strip() == package.__version__


@pytest.mark.parametrize(
    ("word", "said"),
    [("rendr", "did you mean render"), ("x^2+y^2-z", "zeroset render 'FORMULA'"), ("Gallery", "did you mean gallery")],
)
def test_unknown_commands(word: str, said: str, zeroset: Run) -> None:
    ran = zeroset(word)
    assert ran.status == 2
    assert said in ran.err


def test_hints_speak_of_options() -> None:
    hint = "no value a=1\n  hint: params={'a': 1.0} or params={'c': [1.0, 2.0]}\n  hint: device=\"interp\" needs none"
    assert as_options(hint) == "no value a=1\n  hint: -p a=1.0 or -p c=1.0,2.0\n  hint: --device interp needs none"
    assert as_options("x\n  hint: method='auto' treats any") == "x\n  hint: --method auto treats any"
    assert as_options("x\n  hint: try up=(0, 0, 1)") == "x\n  hint: try --up 0,0,1"
    assert as_options("method='auto'") == "method='auto'"


@pytest.mark.parametrize(
    ("error", "status", "said"),
    [
        (KeyboardInterrupt(), 130, "interrupted"),
        (click.Abort(), 130, "interrupted"),
        (MemoryError(), 1, "not enough memory"),
        (click.UsageError("wrong"), 2, "wrong"),
    ],
)
def test_what_ends_a_command(
    error: BaseException, status: int, said: str, zeroset: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise error

    monkeypatch.setattr(cli.zeroset, "main", fail)
    ran = zeroset("render")
    assert ran.status == status
    assert said in ran.err
