from __future__ import annotations

import tomllib

import pytest

from zeroset.errors import UnknownSurfaceError
from zeroset.surfaces import chmutov, entry, names
from zeroset.surfaces.chebyshev import chmutov_of_order
from zeroset.surfaces.load import DATA, FAMILIES, SOLIDS, family, index


def test_every_table_of_every_file_is_listed_once() -> None:
    listed = [name for each in FAMILIES for name in family(each)]
    assert list(names()) == listed
    assert len(set(listed)) == len(listed)


def test_every_data_file_is_a_family() -> None:
    assert {path.stem for path in DATA.glob("*.toml")} == {*FAMILIES, SOLIDS}


def test_asking_for_a_name_parses_one_family_only(monkeypatch: pytest.MonkeyPatch) -> None:
    parsed = []
    loads = tomllib.loads

    def counted(text: str) -> dict[str, object]:
        parsed.append(text)
        return loads(text)

    monkeypatch.setattr(tomllib, "loads", counted)
    family.cache_clear()
    names()
    assert parsed == []
    entry("cayley")
    entry("clebsch")
    assert len(parsed) == 1


@pytest.mark.parametrize(
    "wanted",
    [
        *("ding-dong", "clebsch", "cayley"),
        *("torus", "nordstrand", "cushion", "goursat", "kummer", "miter", "cross-cap", "piriform", "tooth"),
        *("cassini", "steiner", "peninsula", "kiss", "dervish", "barth-sextic", "hunt", "klein-bottle", "heart"),
        *("labs", "endrass", "barth-decic", "sarti-dodecic"),
        *(f"chmutov-{order}" for order in (6, 7, 8, 9, 12, 14, 18, 20, 22, 30)),
        *("torus-root", "blinn-blobby", "blinn-blobby-30", "blobby", "scherk", "diamond", "superquadric"),
        *("sphere", "knoll-steiner", "mitchell", "teardrop", "4-bretzel", "tangle", "decocube"),
        *("knoll-superquadric", "sin-blob", "cloth", "water"),
    ],
)
def test_the_papers_surfaces_are_there(wanted: str) -> None:
    assert wanted in index()
    assert entry(wanted).name == wanted


@pytest.mark.parametrize(
    ("wrong", "near"),
    [("barth-sextik", "barth-sextic"), ("Steiner", "steiner"), ("blin-blobby", "blinn-blobby"), ("tooht", "tooth")],
)
def test_an_unknown_name_is_told_the_nearest(wrong: str, near: str) -> None:
    with pytest.raises(UnknownSurfaceError, match=wrong) as caught:
        entry(wrong)
    assert near in caught.value.hint


@pytest.mark.parametrize("wrong", ["", "chmutov", "chmutov-", "chmutov-007", "chmutov--8", "chmutov-²", "x^2", "a\nb"])
def test_no_other_text_is_a_surface(wrong: str) -> None:
    with pytest.raises(UnknownSurfaceError):
        entry(wrong)


@pytest.mark.parametrize("order", [2, 3, 5, 10, 40, 511, 512])
def test_chmutov_exists_in_any_order(order: int) -> None:
    made = entry(f"chmutov-{order}")
    assert made == chmutov(order)
    assert made.degree == order
    assert f"T({order}, z)" in made.formula


@pytest.mark.parametrize("order", [1, 0, -2, 513, 10**12, True, 6.0, "6"])
def test_other_orders_are_refused(order: object) -> None:
    with pytest.raises(UnknownSurfaceError, match="2 to 512"):
        chmutov(order)  # type: ignore[arg-type]


@pytest.mark.parametrize("name", [name for name in names() if name.startswith("chmutov-")])
def test_listed_chmutov_surfaces_follow_the_rule_of_the_others(name: str) -> None:
    listed = entry(name)
    made = chmutov_of_order(listed.degree)
    assert listed == chmutov(listed.degree)
    assert (listed.formula, listed.bounds, listed.title) == (made.formula, made.bounds, made.title)
    assert listed.camera.eye == pytest.approx(made.camera.eye, abs=0.002)
