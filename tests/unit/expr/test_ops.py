from __future__ import annotations

import ast
from fractions import Fraction
from pathlib import Path

import pytest

import zeroset.expr
from zeroset.expr.decimals import Decimals
from zeroset.expr.ops import FUNCTIONS, OPS, rational_root

CONTRACT = (
    "const variable parameter element add sub mul div neg sqr powi pow powr cbrt sqrt exp log sin cos tan asin acos "
    "atan atan2 sinh cosh tanh abs sign floor ceil mod min max lt le and or not select sum"
)


def test_the_table_has_the_agreed_operators():
    assert set(OPS) == set(CONTRACT.split())


def test_spellings_and_ufuncs_are_unambiguous():
    for column in ("spellings", "ufuncs", "sympy"):
        names = [name for row in OPS.values() for name in getattr(row, column)]
        assert len(names) == len(set(names)), column
    assert FUNCTIONS["arcsin"] is FUNCTIONS["asin"] is OPS["asin"]


def test_keywords_get_an_underscore_as_methods():
    assert [OPS[name].method for name in ("and", "or", "not", "add")] == ["and_", "or_", "not_", "add"]


@pytest.mark.parametrize(
    "row", [row for row in OPS.values() if row.kind not in {"leaf", "sum"}], ids=lambda row: row.name
)
def test_constants_have_an_enclosure_for_every_operator(row):
    assert callable(getattr(Decimals(20), row.method))


@pytest.mark.parametrize(
    ("value", "degree", "root"),
    [(8, 3, 2), (Fraction(4, 9), 2, Fraction(2, 3)), (2, 2, None), (10**60, 6, 10**10), (0, 5, 0), (7, 100, None)],
)
def test_rational_roots_are_exact_or_none(value, degree, root):
    assert rational_root(Fraction(value), degree) == root


@pytest.mark.parametrize("base", [3, 10**20 + 7, 2**61 - 1])
@pytest.mark.parametrize("degree", [2, 3, 5, 17])
def test_roots_of_neighbours_of_powers(base, degree):
    assert rational_root(Fraction(base**degree), degree) == base
    assert rational_root(Fraction(base**degree + 1), degree) is None
    assert rational_root(Fraction(base**degree - 1), degree) is None


def test_the_package_imports_no_neighbour_and_nothing_heavy():
    folder = Path(zeroset.expr.__file__).parent
    for path in folder.glob("*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for item in tree.body:
            names = [alias.name for alias in item.names] if isinstance(item, ast.Import) else []
            names += [item.module or ""] if isinstance(item, ast.ImportFrom) else []
            for name in names:
                assert name.split(".")[0] not in {"numpy", "sympy", "lark", "flint"}, path.name
                assert not name.startswith(("zeroset.arith", "zeroset.kernel")), path.name
