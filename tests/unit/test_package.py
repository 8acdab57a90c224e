"""The public face: what is offered, documented and annotated, and what importing it costs."""

from __future__ import annotations

import doctest
import importlib
import inspect
import pkgutil
import subprocess
import sys
import typing
import warnings
from collections.abc import Iterator
from types import ModuleType
from typing import Any

import pytest

import zeroset as zs

MODULES = sorted(m.name for m in pkgutil.walk_packages(zs.__path__, "zeroset.") if not m.name.endswith("__main__"))


def public() -> Iterator[tuple[str, Any]]:
    for name in zs.__all__:
        yield name, getattr(zs, name)


def test_all_is_complete_and_sorted() -> None:
    # Constants, then classes, then the rest, as ruff has it.
    assert zs.__all__ == sorted(zs.__all__, key=lambda name: (not name.isupper(), not name[0].isupper(), name))
    assert len(set(zs.__all__)) == len(zs.__all__)
    promised = {
        *("surface", "Surface", "Ball", "Box", "gallery", "load", "save", "cast", "Hits", "render", "Image", "Scene"),
        *(
            "Camera",
            "Coloring",
            "Environment",
            "Light",
            "Material",
            "methods",
            "errors",
            "ZerosetError",
            "MISS",
            "HIT",
            "UNRESOLVED",
            "show",
        ),
        *("Mesh", "mesh", "animate", "Solid"),
    }
    assert promised | {"__version__"} == set(zs.__all__)
    assert dir(zs) == sorted(zs.__all__)


def test_every_name_is_there_and_no_other() -> None:
    for name, value in public():
        assert value is not None, name
    with pytest.raises(AttributeError, match="no attribute 'rendr'"):
        zs.rendr  # type: ignore[attr-defined]  # noqa: B018
    assert (zs.MISS, zs.HIT, zs.UNRESOLVED) == (0, 1, 2)


def members(value: Any) -> Iterator[tuple[str, Any]]:
    """The public functions, methods and properties of a public thing."""
    if inspect.isclass(value):
        for name, member in vars(value).items():
            if not name.startswith("_") and (inspect.isfunction(member) or isinstance(member, property)):
                yield f"{value.__name__}.{name}", member
    elif inspect.isfunction(value):
        yield value.__name__, value


def everything() -> list[tuple[str, Any]]:
    found = [pair for _, value in public() for pair in members(value)]
    found += [pair for name in zs.methods.__all__ for pair in members(getattr(zs.methods, name))]
    return found + [pair for name in zs.errors.__all__ for pair in members(getattr(zs.errors, name))]


def test_everything_public_is_documented() -> None:
    modules = (zs, zs.methods, zs.errors)
    kinds = [getattr(m, n) for m in modules for n in m.__all__ if inspect.isclass(getattr(m, n))]
    plain = [kind.__name__ for kind in kinds if not kind.__doc__ or kind.__doc__.startswith(f"{kind.__name__}(")]
    assert plain == []
    # Methods of methods inherit their text.
    assert [name for name, member in everything() if not inspect.getdoc(member) and "." not in name] == []


def test_everything_public_is_annotated() -> None:
    missing = []
    for name, member in everything():
        function = member.fget if isinstance(member, property) else member
        parameters = inspect.signature(function).parameters
        wanted = {p for p in parameters if p not in ("self", "cls")} | {"return"}
        missing += [f"{name}: {p}" for p in wanted - set(function.__annotations__)]
    assert missing == []


def test_the_main_public_things_have_an_example() -> None:
    without = [name for name, value in public() if callable(value) and ">>>" not in (value.__doc__ or "")]
    assert set(without) <= {"Hits", "Light", "Material", "ZerosetError"}


@pytest.mark.parametrize("name", MODULES)
def test_the_examples_in_the_documentation_run(name: str) -> None:
    module = importlib.import_module(name)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        results = doctest.testmod(module, optionflags=doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS)
    assert results.failed == 0


def test_every_module_says_what_it_is() -> None:
    def described(module: ModuleType) -> bool:
        return len((module.__doc__ or "").strip()) > 20

    assert [name for name in MODULES if not described(importlib.import_module(name))] == []


def test_types_can_be_read_at_run_time() -> None:
    assert typing.get_type_hints(zs.Ball)["radius"] is float


def test_importing_is_cheap_and_loads_nothing_optional() -> None:
    program = (
        "import sys, zeroset; light = set(sys.modules); import pkgutil, importlib\n"
        "for m in pkgutil.walk_packages(zeroset.__path__, 'zeroset.'):\n"
        "    if not m.name.endswith('__main__'): importlib.import_module(m.name)\n"
        "print(*sorted({'numpy', 'llvmlite', 'lark', 'PIL', 'rich', 'click'} & light), '|',\n"
        "      *sorted({'sympy', 'flint', 'llvmlite', 'PIL', 'rich', 'lark'} & set(sys.modules)))"
    )
    found = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "|", "nothing of these may be loaded by importing zeroset, or any module of it"
