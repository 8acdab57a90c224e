"""Where the pictures of a scene file are: their names are meant from the file's own folder.

So a folder with a scene and its pictures may be moved, and a scene may be loaded from anywhere. In a program, names are
meant from where it runs, as everywhere in Python.
"""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Callable
from pathlib import Path

from zeroset.scene.environment import BUILT_IN, Environment


def from_folder(environment: Environment, folder: str | os.PathLike[str]) -> Environment:
    """Surroundings as they are named in a file of this folder, named for a program."""

    def found(name: str) -> str:
        joined = os.path.join(folder, name)
        short = os.path.normpath(joined)
        # Where a link is on the way, "link/.." is not what stands before it.
        return short if os.path.realpath(short) == os.path.realpath(joined) else joined

    return _renamed(environment, found)


def for_folder(environment: Environment, folder: str | os.PathLike[str]) -> Environment:
    """Surroundings as a program names them, named for a file of this folder: relative to it where that is possible."""
    home = os.path.realpath(folder)

    def named(name: str) -> str:
        place = os.path.join(os.path.realpath(os.path.dirname(os.path.abspath(name))), os.path.basename(name))
        try:
            if os.path.dirname(os.path.commonpath([home, place])) == os.path.commonpath([home, place]):
                # Nothing in common but the root: a name from there is the clearer one.
                return Path(place).as_posix()
            return Path(os.path.relpath(place, home)).as_posix()
        except ValueError:
            # Another drive.
            return Path(place).as_posix()

    return _renamed(environment, named)


def _renamed(environment: Environment, change: Callable[[str], str]) -> Environment:
    source = environment.source
    if source in BUILT_IN:
        return environment
    renamed = change(source) if isinstance(source, str) else tuple(map(change, source))
    return dataclasses.replace(environment, source=renamed)
