"""The command line: ``zeroset render FORMULA -o out.png`` and its fellows, one file a command.

Commands are loaded when they are called for. Every mistake of a user ends in one clear message on stderr and exit
status 2, an interruption in 130, what cannot be printed in 1; there is no traceback for any of them.
"""

from __future__ import annotations

import atexit
import errno
import gc
import importlib
import os
import re
import sys
from typing import Any

import click

from zeroset.errors import ZerosetError

COMMANDS = {
    "render": "Draw a formula, a gallery surface or a scene file.",
    "view": "Show a surface in a window: turn it, type another formula.",
    "mesh": "Make triangles of a surface: STL, OBJ, PLY or GLB.",
    "animate": "Draw a surface as it changes: a movie, or numbered pictures.",
    "gallery": "List the named surfaces, or draw them all on one sheet.",
    "figure": "Draw a figure of the papers, or list them.",
    "explain": "Show a formula, its kernels after each pass, and the target code.",
    "bench": "Time the gallery on this machine.",
    "doctor": "Say what this machine offers and what is missing.",
}


UNWRITTEN = (errno.ENOSPC, errno.EIO, errno.EBADF, errno.EFBIG, errno.EDQUOT, errno.EPIPE)
"""What systems say of output that cannot be written."""


class _Lazy(click.Group):
    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, name: str) -> click.Command | None:
        if name not in COMMANDS:
            return None
        command: click.Command = importlib.import_module(f"zeroset.cli.{name}").command
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))

    def resolve_command(self, ctx: click.Context, args: list[str]) -> Any:
        if args[0] not in COMMANDS:
            from zeroset.errors import did_you_mean

            hints = did_you_mean(args[0], COMMANDS) or ("to draw a formula: zeroset render 'FORMULA' -o out.png",)
            raise ZerosetError(f"there is no command {args[0]!r}", hints=(*hints, f"there are {', '.join(COMMANDS)}"))
        return super().resolve_command(ctx, args)


@click.command(cls=_Lazy, context_settings={"help_option_names": ["-h", "--help"]}, no_args_is_help=True)
@click.version_option(package_name="zeroset", message="%(version)s")
def zeroset() -> None:
    """Draw the surface f(x, y, z) = 0 of any formula, with certified answers."""


def main(args: list[str] | None = None) -> int:
    """Run the command line; gives the exit status."""
    # A command makes many small objects and keeps most to its end: looking for garbage often takes a tenth of its time.
    gc.set_threshold(100_000)
    # Nor need it look for any before it goes with everything that it has: often another tenth.
    atexit.register(gc.freeze)
    # NumPy's linear algebra starts a thread for each core, which for a tenth of a second only waits for work, busily,
    # while everything else is being loaded. A command has no matrices that are worth it.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    try:
        status = _run(args)
        if sys.stdout is not None:
            sys.stdout.flush()
        elif status == 0:
            return _unwritten("it is closed")
    except OSError as error:
        # Files that cannot be written are errors of our own: what is left is what we print.
        if error.filename is not None or error.errno not in UNWRITTEN:
            raise
        # What is still in the buffer goes nowhere.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        # Where its reader has gone (`zeroset gallery | head`), that is no error.
        return 0 if error.errno == errno.EPIPE else _unwritten(error.strerror or str(error))
    return status


def _unwritten(reason: str) -> int:
    """Say why what was printed cannot be read by anybody; gives the exit status."""
    click.echo(f"error: cannot write to the standard output: {reason}", err=True)
    return 1


def _run(args: list[str] | None) -> int:
    """Run a command; gives the exit status."""
    try:
        zeroset.main(args, prog_name="zeroset", standalone_mode=False)
    except ZerosetError as error:
        click.echo(f"error: {as_options(str(error))}", err=True)
        return 2
    except click.ClickException as error:
        error.show()
        return error.exit_code
    except (KeyboardInterrupt, click.Abort):
        click.echo("interrupted: no file was left half written", err=True)
        return 130
    except MemoryError:
        click.echo("error: there is not enough memory for this\n  hint: try a smaller --size or --resolution", err=True)
        return 1
    return 0


_ARGUMENT = re.compile(
    r"\b(bounds|method|device|precision|up|eye|orbit)=(?:'([^']*)'|\"([^\"]*)\"|\(([^)]*)\)|([-+.\deE]*\d))"
)


def as_options(message: str) -> str:
    """A message whose hints speak of Python's arguments, in the words of the command line.

    Example:
        >>> print(as_options("no bounds\\n  hint: try bounds=3.0"))
        no bounds
          hint: try --bounds 3.0
    """
    return "\n".join(_translated(line) if line.startswith("  hint: ") else line for line in message.split("\n"))


def _translated(hint: str) -> str:
    hint = re.sub(r"params=\{'(\w+)': \[([^]]*)\]\}", lambda m: f"-p {m[1]}={m[2].replace(' ', '')}", hint)
    hint = re.sub(r"params=\{'(\w+)': ([^}]*)\}", r"-p \1=\2", hint)
    hint = re.sub(r"vary=\{'(\w+)': \(([^,]*), ([^)]*)\)\}", r"--vary \1=\2:\3", hint).replace(
        "restart=True", "--restart"
    )
    return _ARGUMENT.sub(lambda m: f"--{m[1]} {''.join(filter(None, m.groups()[1:])).replace(' ', '')}", hint)
