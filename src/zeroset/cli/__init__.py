"""The command line: ``zeroset render FORMULA -o out.png`` and its fellows, one file a command.

Commands are loaded when they are called for. Every mistake of a user ends in one clear message on stderr and exit
status 2, an interruption in 130; there is no traceback for either.
"""

from __future__ import annotations

import importlib
import sys
from typing import Any

import click

from zeroset.errors import ZerosetError

COMMANDS = {
    "render": "Draw a formula, a gallery surface or a scene file.",
    "gallery": "List the named surfaces, or draw them all on one sheet.",
    "explain": "Show a formula, its kernels after each pass, and the target code.",
    "bench": "Time the gallery on this machine.",
    "doctor": "Say what this machine offers and what is missing.",
}


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
        try:
            return super().resolve_command(ctx, args)
        except click.UsageError as error:
            from zeroset.errors import did_you_mean

            hints = did_you_mean(args[0], COMMANDS) or ("to draw a formula: zeroset render 'FORMULA' -o out.png",)
            raise click.UsageError(f"{error.format_message()} {hints[0]}", ctx) from None


@click.command(cls=_Lazy, context_settings={"help_option_names": ["-h", "--help"]}, no_args_is_help=True)
@click.version_option(package_name="zeroset", message="%(version)s")
def zeroset() -> None:
    """Draw the surface f(x, y, z) = 0 of any formula, with certified answers."""


def main(args: list[str] | None = None) -> int:
    """Run the command line; gives the exit status."""
    try:
        zeroset.main(args, prog_name="zeroset", standalone_mode=False)
    except ZerosetError as error:
        click.echo(f"error: {error}", err=True)
        return 2
    except click.ClickException as error:
        error.show()
        return error.exit_code
    except (KeyboardInterrupt, click.Abort):
        click.echo("interrupted; nothing was written", err=True)
        return 130
    except BrokenPipeError:
        # The reader of our output has gone (`zeroset gallery | head`): not a mistake of anybody.
        sys.stderr.close()
        return 0
    return 0
