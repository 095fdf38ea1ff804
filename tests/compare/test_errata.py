"""The errata: each is confirmed, none would be if it were none, and the page says what the checks found."""

from __future__ import annotations

import csv
import dataclasses
import io
import json
from fractions import Fraction
from pathlib import Path

import pytest

from compare.__main__ import main
from compare.show import render
from compare.sources.errata import show
from compare.sources.errata.entries import ENTRIES, ERRATA, NOTICED
from compare.sources.errata.evidence import REPORT, THESIS, near, rounds_to
from compare.sources.errata.listings import CORRECTED, LISTING, undefined
from compare.sources.errata.report_series import (
    BETA,
    BETA_PRINTED,
    PHI_B,
    PHI_B_PRINTED,
    PHI_C,
    PHI_C_PRINTED,
    coefficient,
    plus,
    sine,
    times,
)
from compare.sources.errata.sound import SOUND
from compare.sources.errata.spelled import spelled
from reference.arithmetic.precision import mp
from reference.problems.descent.problem import Descent
from reference.problems.pendulum.problem import Pendulum

ROOT = Path(__file__).parents[2]
each = pytest.mark.parametrize("erratum", ERRATA, ids=lambda one: f"{one.source[:4]}-{one.place}")


@each
def test_the_right_form_passes_and_the_printed_form_fails(erratum):
    printed, right = erratum.forms
    assert erratum.holds(right)
    assert not erratum.holds(printed)
    assert erratum.confirmed()


@each
def test_an_erratum_that_is_none_is_not_confirmed(erratum):
    printed, right = erratum.forms
    for forms in ((right, right), (printed, printed), (right, printed)):
        assert not dataclasses.replace(erratum, forms=forms).confirmed()


@each
def test_a_check_sees_near_misses_of_the_right_form(erratum):
    printed, right = erratum.forms
    assert erratum.slips
    for slip in erratum.slips:
        assert slip not in (printed, right)
        assert not erratum.holds(slip)
        assert not dataclasses.replace(erratum, forms=(printed, slip), slips=(right,)).confirmed()


@each
def test_a_check_that_sees_nothing_confirms_nothing(erratum):
    for verdict in (True, False):
        assert not dataclasses.replace(erratum, holds=lambda _form, verdict=verdict: verdict).confirmed()


@each
def test_a_formula_that_is_shown_is_the_one_that_was_checked(erratum):
    """Where forms are texts, each stands in what is shown: the formulas, the numbers, the units."""
    for form, words in zip(erratum.forms, (erratum.printed, erratum.right), strict=True):
        texts = [one for one in (form if isinstance(form, tuple) else (form,)) if isinstance(one, str)]
        for text in texts:
            assert NOT_SHOWN.get(text, text) in words or erratum.place in BY_REFERENCE


NOT_SHOWN = {
    "0.00": "0",
    "0": "0",
    "-0.0353279": "−0.0353279",
    "-0.0353278": "−0.0353278",
    "1/(1 + (φ_init² + 5 φ_init⁴)/512)": "ω0²/(1 + (φ_init² + 5 φ_init⁴)/512)",
    "1/(1 + φ_init²/8 + 17 φ_init⁴/1536)": "ω0²/(1 + φ_init²/8 + 17 φ_init⁴/1536)",
}
"""How a form is shown that is shown otherwise than spelled."""
BY_REFERENCE = {
    "section 3.3, on table 9",
    "β, after (4.12), and (4.15)",
    "(4.14)",
    "section 3.1, second listing",
    "section 4.5, on figure 14, Z = 0.1",
    "section 4.5, Z = 0.9",
}
"""Entries that name an equation, a program or an angle where the check takes what it is."""


@pytest.mark.parametrize("sound", SOUND, ids=lambda one: f"{one.source[:4]}-{one.place}")
def test_a_formula_that_is_right_passes_and_fails_with_a_slip(sound):
    slip, printed = sound.forms
    assert sound.confirmed()
    assert not dataclasses.replace(sound, forms=(slip, slip)).confirmed()
    assert not dataclasses.replace(sound, forms=(printed, printed)).confirmed()


def test_formulas_are_read_as_they_are_printed():
    assert spelled("1 + y0²/16 + 11 y0⁴/3072", "y0")(Fraction(1)) == Fraction(3275, 3072)
    assert spelled("5/512 ω² φ_init⁵", "ω", "φ_init")(Fraction(2), Fraction(1)) == Fraction(5, 128)
    assert spelled("(g/2a) x", "g", "a", "x")(*map(Fraction, (3, 5, 7))) == Fraction(21, 10)
    assert spelled("½x³/3! − (−x)", "x")(Fraction(2)) == Fraction(8, 12) + 2
    assert spelled("N m² kg⁻²", "N", "m", "kg")(*map(Fraction, (2, 3, 5))) == Fraction(18, 25)
    assert spelled("a = b + c", "a", "b", "c")(1, 2, 3) == -4
    with mp.workdps(30):
        assert near(spelled("cos 3ωt − sin² x/2", "ω", "t", "x")(2, 3, 1), mp.cos(18) - mp.sin(1) ** 2 / 2)
        assert near(
            spelled("sin θ θ'² + √(2g/l) √2 π", "θ", "θ'", "g", "l")(1, 2, 9, 2), 4 * mp.sin(1) + 3 * mp.sqrt(2) * mp.pi
        )


@pytest.mark.parametrize(
    ("text", "what"), [("1 + q", "'q'"), ("(1 + x", "a bracket"), ("x )", r"'\)'"), ("+", "'\\+'")]
)
def test_what_is_no_formula_is_refused(text, what):
    with pytest.raises(ValueError, match=what):
        spelled(text, "x")(1)


def test_the_printed_program_lacks_two_names_and_the_corrected_one_runs():
    assert undefined(LISTING) == {"y4", "G"}
    assert undefined(CORRECTED) == frozenset()
    assert undefined("import a.b as c\ndef f(x):\n    return x + c + len(z)\n") == {"z"}


def test_the_corrected_program_arrives_with_the_speed_of_the_fall():
    """Without its first line, which imports a library that it does not use; the text is the project's own file."""
    names = {}
    exec(CORRECTED.replace("import matplotlib.pyplot as plt\n", ""), names)  # noqa: S102
    assert max(names["v"]) == pytest.approx((2 * 9.81 * (1 - mp.cos(3.13))) ** 0.5, rel=1e-3)
    for speed, height in zip(names["v"], names["yp"], strict=True):
        assert speed**2 / 2 + 9.81 * height == pytest.approx(9.81 * (1 - float(mp.cos(3.13))), rel=1e-3)


def test_remarks_have_no_check_and_say_so(capsys):
    assert main(["errata"]) == 0
    out = capsys.readouterr().out
    assert "without a check" in out
    assert f"{len(NOTICED)} remarks" in out
    places = {(one.source, one.place) for one in ENTRIES}
    assert not {(one.source, one.place) for one in NOTICED} & places


def test_latex_says_which_compiler_and_font_it_needs():
    shown = render.render(show.page(show.records(ENTRIES)), "latex")
    assert shown.startswith("% needs \\usepackage{booktabs}")
    assert "XeLaTeX or LuaLaTeX" in shown.split("\\begin{table}")[0]
    assert max(part.count("where &") for part in shown.split("\\end{table}")) == 6


def test_no_place_stands_twice():
    places = [(one.source, one.place) for one in ERRATA]
    assert len(set(places)) == len(places)
    assert {source for source, _ in places} == {REPORT, THESIS}


def test_checks_leave_the_precision_as_it_was():
    before = mp.prec
    assert all(one.confirmed() for one in ENTRIES)
    assert mp.prec == before


def test_series_of_cosines_obey_what_is_known_of_cosines():
    a_cos = {(1, 1): Fraction(1)}
    assert times(a_cos, a_cos) == {(2, 0): Fraction(1, 2), (2, 2): Fraction(1, 2)}
    assert coefficient(times(times(a_cos, a_cos), a_cos), 3) == {1: Fraction(3, 4), 3: Fraction(1, 4)}
    assert plus(a_cos, {(1, 1): Fraction(-1)}) == {}
    with mp.workdps(30):
        found = sum(mp.mpf(c.numerator) / c.denominator / 100**n for (n, _), c in sine(a_cos).items())
        assert abs(found - mp.sin(mp.mpf("0.01"))) < mp.mpf("1e-16")


def test_a_number_rounds_to_a_decimal_within_half_a_unit():
    assert rounds_to(mp.mpf("2.006067"), "2.00607")
    assert not rounds_to(mp.mpf("2.006067"), "2.00606")
    assert near(mp.mpf(1), mp.mpf(1))
    assert not near(mp.mpf(1), mp.mpf("1.001"))


def approximation(t, phi_b, phi_c, beta):
    """(4.14) at the amplitude 1, with g/l = 9.81 and omega as the report rewrites it."""
    omega = mp.sqrt(mp.mpf("9.81") / (1 + mp.mpf(1) / 8 - mp.mpf(beta.numerator) / beta.denominator))
    terms = plus({(1, 1): Fraction(1)}, phi_b, phi_c)
    return sum(mp.mpf(c.numerator) / c.denominator * mp.cos(k * omega * t) for (_, k), c in terms.items())


def test_the_slips_of_section_4_cost_table_12_what_the_page_says():
    times_shown = [Fraction(1, 100) + Fraction(n, 2) for n in range(20)]
    exact = Pendulum("1", g="9.81", length=1).state(times_shown)[:, 0]
    largest = [
        max(abs(approximation(float(t), *series) - truth) for t, truth in zip(times_shown, exact, strict=True))
        for series in ((PHI_B_PRINTED, PHI_C_PRINTED, BETA_PRINTED), (PHI_B, PHI_C, BETA))
    ]
    assert [round(float(error), 4) for error in largest] == [0.0351, 0.0116]
    page = render.render(show.page(show.records(ENTRIES)), "markdown")
    assert "0.0351" in page
    assert "0.0116" in page
    assert round(float(approximation(8.01, PHI_B_PRINTED, PHI_C_PRINTED, BETA_PRINTED)), 7) == -0.0104871


def test_one_sign_gives_all_that_section_4_prints_after_it():
    """(4.12), beta and (4.13), and from them what (4.16) would be, follow from (4.8) as it is printed."""
    a_cos = {(1, 1): Fraction(1)}
    phi = plus(a_cos, PHI_B_PRINTED)
    stiffness = {(0, 0): Fraction(1), (2, 0): Fraction(1, 8)}
    forcing = {k: -c for k, c in coefficient(times(stiffness, sine(phi)), 5).items()}
    assert forcing == {1: Fraction(5, 512), 3: Fraction(1, 384), 5: Fraction(1, 7680)}
    forced = {(5, k): c / (1 - k * k) for k, c in forcing.items() if k > 1}
    assert plus(forced, {(5, 1): -sum(forced.values())}) == PHI_C_PRINTED
    assert Fraction(5, 512) / 2 - Fraction(1, 8) ** 2 / 8 == Fraction(3, 1024)  # of sqrt(1 + a^2/8 + 5 a^4/512)


def test_the_misprinted_polar_form_would_sweep_what_the_page_says():
    z0 = mp.mpf("0.2")

    def slope(psi):
        z = (1 + z0) / 2 + (1 - z0) / 2 * mp.cos(psi)
        return z0 ** mp.mpf("1.5") * (1 - z) / (z * mp.sqrt((1 - z0) * z * z + z0 * (1 - z0) + z0 * z0))

    with mp.workdps(15):
        whole = mp.degrees(2 * mp.quad(slope, mp.linspace(0, mp.pi, 5)))
        assert rounds_to(whole, "74.87")
    assert "74.87°" in render.render(show.page(show.records(ENTRIES)), "markdown")


def test_the_times_of_the_race_are_what_the_page_says():
    page = render.render(show.page(show.records(ENTRIES)), "markdown")
    for curve in ("cycloid", "quarter_ellipse", "circular_arc", "quartic", "line"):
        assert f"{Descent(curve, g='9.81').values('descent_time', [None], 1).item():.4f} s" in page


def test_the_page_is_what_the_command_prints(capsys):
    assert main(["errata", "--format", "markdown"]) == 0
    assert (ROOT / "docs" / "errata.md").read_text(encoding="utf-8") == capsys.readouterr().out


@pytest.mark.parametrize("form", ["text", "markdown", "latex"])
def test_every_erratum_stands_in_what_people_read(form):
    shown = render.render(show.page(show.records(ENTRIES)), form)
    for one in ENTRIES:
        assert one.place.split(",")[0] in shown
    assert f"{sum(one.source == THESIS for one in ERRATA)} of" in shown


def test_text_fits_a_narrow_terminal():
    lines = render.render(show.page(show.records(ENTRIES)), "text", 80).splitlines()
    assert (
        max(len(line) for line in lines if not line.startswith(("Errata:", "Held and found right:", "Noticed in")))
        <= 80
    )


def test_programs_read_the_same_records():
    found = show.records(ENTRIES)
    read = json.loads(render.render(show.page(found), "json"))
    assert read["entries"] == found
    assert [one["place"] for one in read["noticed"]] == [one.place for one in NOTICED]
    rows = list(csv.DictReader(io.StringIO(render.render(show.page(found), "csv"))))
    assert [row["place"] for row in rows] == [one.place for one in (*ENTRIES, *NOTICED)]
    assert {(row["kind"], row["confirmed"]) for row in rows} == {("erratum", "yes"), ("right", "yes"), ("noticed", "")}


def test_what_is_not_confirmed_is_said_and_is_a_failure(monkeypatch, capsys):
    none = dataclasses.replace(ERRATA[0], forms=(ERRATA[0].forms[1],) * 2)
    monkeypatch.setattr("compare.sources.errata.entries.ENTRIES", (none, *ENTRIES[1:]))
    assert main(["errata"]) == 1
    own = sum(one.source == REPORT for one in ERRATA)
    assert f"{own - 1} of {own} entries are confirmed" in capsys.readouterr().out
