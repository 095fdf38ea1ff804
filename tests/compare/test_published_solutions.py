"""Solutions that the literature prints: read as printed, held against the proven ones, and the page that lists them."""

from __future__ import annotations

import argparse
import re
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import pytest

from compare.__main__ import main
from compare.show import render
from compare.sources.published import show, solution
from compare.sources.published.entry import Reproduction, _entries, reproduce
from compare.sources.published.number import Exact
from compare.sources.published.options import options
from compare.sources.published.source import solutions
from reference.arithmetic.precision import mp
from reference.problems.detest.family import DETEST
from reference.problems.families import find_family

PAGE = (Path(__file__).parents[2] / "docs" / "solutions.md").read_text(encoding="utf-8")


def solution_table(name):
    return next(table for table in solutions() if table.name == name)


def test_the_rows_of_a_printed_solution_are_components_of_their_problem_in_its_order():
    for table in solutions():
        assert all(column.exactly for column in table.columns)
        named = [tuple(row.split()) for row in table.rows]
        for problem in dict.fromkeys(given[:-1] for given in named):
            found = [given[-1] for given in named if given[:-1] == problem]
            known = find_family(*(problem or (table.parameters["problem"],))).problem().space.components
            assert [name for name in known if name in found] == found


def test_the_end_values_of_detest_are_those_of_all_components_of_all_its_problems():
    table = solution_table("detest")
    assert table.rows == tuple(f"{kind.name} {name}" for kind in DETEST for name in kind.space.components)
    assert len(table.rows) == 160
    (column,) = table.columns
    assert all(len(text.lstrip("-")) == len("1.000000000000000e+00") for text in column.printed)


def cut(name, *rows):
    """A printed solution of these rows alone."""
    table = solution_table(name)
    (column,) = table.columns
    printed = tuple(column.printed[table.rows.index(row)] for row in rows)
    return replace(table, rows=rows, columns=(replace(column, printed=printed),))


def test_end_values_of_detest_are_wrong_in_their_last_digits_or_far_before_them():
    table = cut("detest", "detest-a1 y1", "detest-b2 y2", "detest-e5 y2")
    one = Reproduction(table, tuple(_entries(table)))
    assert {entry.row: (entry.exact, entry.off_by, entry.wrong) for entry in one.entries} == {
        "detest-a1 y1": ("2.061153622438558e-09", 269426023, True),
        "detest-b2 y2": ("1.000000000000000e+00", 0, False),
        "detest-e5 y2": ("2.400000000000000e+00", -2, True),
    }
    assert one.summary == "2 of 3 published entries off in their last digit or before"
    shown = render.render(show.page([one]), "text", 100)
    row = "detest-a1 y1 2.061153353012535e-09! 2.061153[622438558e-09] +269426023"
    assert row in [" ".join(line.split()) for line in shown.splitlines()]
    for form in ("markdown", "latex", "csv", "json"):
        assert "2.061153353012535" in render.render(show.page([one]), form)


@pytest.mark.parametrize(
    ("value", "printed", "rounded"),
    [
        ("0.12345", "0.123", "0.123"),
        ("-12.345", "-1.2e+01", "-1.2e+01"),
        ("0.00012349", "1.234e-04", "1.235e-04"),
        ("0.0099996", "1.000e-02", "1.000e-02"),
        ("0.0009994", "1.000e-03", "0.999e-03"),
    ],
)
def test_a_number_is_rounded_to_the_last_printed_digit_with_the_printed_power_of_ten(value, printed, rounded):
    assert solution.as_printed(Exact(Fraction(value)), printed) == rounded


def test_a_printed_solution_is_shown_beside_the_exact_one_and_not_beside_a_method(capsys, monkeypatch):
    """With values in the place of the proven ones, which take minutes; the first is off by two units."""
    (table,) = (one for one in solutions() if one.name == "pleiades")
    values = dict(zip(table.rows, map(Fraction, table.columns[0].printed), strict=True))
    values["x1"] += Fraction(2, 10**16)
    monkeypatch.setattr(solution, "component", lambda _table, row: Exact(values[row]))
    (found,) = reproduce(["pleiades"])
    assert found.summary == "1 of 28 published entries off in their last digit or before"
    assert [(entry.row, entry.off_by) for entry in found.entries if entry.wrong] == [("x1", 2)]
    assert main(["published", "pleiades"]) == 0
    out = capsys.readouterr().out
    assert "reproduced" not in out.split("Bari test set, problem pleiades", 1)[1].split("of 28 published")[0]
    assert "0.3706139143970502!" in out


def test_printed_solutions_are_not_among_all_the_tables():
    known = argparse.Namespace(names=["all"], out=None, format="text")
    assert not set(options(known)["names"]) & {table.name for table in solutions()}


def on_the_page(table):
    """The rows of a table on the page: the component, then published, exact and off by."""
    _, _, section = PAGE.partition(f"### {table.cited}: {table.title}\n")
    rows = [line.strip("| ").split(" | ") for line in section.partition("\n#")[0].splitlines() if line.startswith("| ")]
    return rows[2:]


def plain(cell):
    return re.sub(r"[\[\]!\\\\]", "", cell)


@pytest.mark.parametrize("table", solutions(), ids=lambda table: table.name)
def test_the_page_has_every_printed_number_and_what_it_is_off_by(table):
    (column,) = table.columns
    found = on_the_page(table)
    assert [row[0] for row in found] == list(table.rows)
    assert [plain(row[1]) for row in found] == list(column.printed)
    for _, published, exact, off_by in found:
        last = Decimal(1).scaleb(int(Decimal(plain(published)).as_tuple().exponent))
        assert (Decimal(plain(exact)) - Decimal(plain(published))) / last == int(off_by)
        assert published.endswith("!") == (column.claims_exact and off_by != "0")
    off = sum(row[3] != "0" for row in found)
    assert f"{off} of {len(found)} published entries off in their last digit or before." in PAGE


def test_what_the_page_says_is_exact_is_what_is_proven():
    rows = ("detest-a1 y1", "detest-a5 y1", "detest-b2 y1", "detest-c1 y1", "detest-e1 y1", "detest-e5 y2")
    known = {row[0]: plain(row[2]) for row in on_the_page(solution_table("detest"))}
    assert {entry.row: entry.exact for entry in _entries(cut("detest", *rows))} == {row: known[row] for row in rows}


def by_keplers_equation(eccentricity, t):
    """Position and velocity from the pericentre, with 40 digits."""
    with mp.workdps(40):
        e = mp.mpf(eccentricity)
        u = mp.findroot(lambda u: u - e * mp.sin(u) - t, t)
        slow, root = 1 - e * mp.cos(u), mp.sqrt(1 - e * e)
        return mp.cos(u) - e, root * mp.sin(u), -mp.sin(u) / slow, root * mp.cos(u) / slow


@pytest.mark.parametrize(
    ("name", "eccentricity"),
    [("detest-d1", "0.1"), ("detest-d2", "0.3"), ("detest-d3", "0.5"), ("detest-d4", "0.7"), ("detest-d5", "0.9")],
)
def test_orbits_on_the_page_are_what_keplers_equation_gives(name, eccentricity):
    shown = [row[2] for row in on_the_page(solution_table("detest")) if row[0].startswith(name)]
    shown += [row[2] for row in on_the_page(solution_table("rksuite"))] if name == "detest-d5" else []
    exact = by_keplers_equation(eccentricity, 20)
    assert len(shown) in {4, 8}
    for text, value in zip(map(plain, shown), (exact * 2)[: len(shown)], strict=True):
        last = mp.mpf(10) ** int(Decimal(text).as_tuple().exponent)
        with mp.workdps(40):
            assert abs(mp.mpf(text) - value) <= last / 2


def test_tolerances_on_the_page_are_missed_by_as_much_as_it_says():
    lines = PAGE.partition("## What a tight tolerance misses")[2].splitlines()
    rows = [line.strip("| ").split(" | ") for line in lines if line.startswith("| ")][2:]
    assert len(rows) == 20
    for problem, _, _, rtol, largest, at_end, _, multiple, _ in rows:
        assert float(multiple) == pytest.approx(float(largest) / float(rtol), rel=0.1)
        assert float(at_end) <= float(largest)
        assert float(multiple) > 1000 or problem != "lorenz"
