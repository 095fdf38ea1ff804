"""A method shown: its tableau or flows, in every format, and the facts that follow from them."""

from __future__ import annotations

import json
import re
from fractions import Fraction

import pytest
from flint import arb

from compare.__main__ import main
from compare.methods import METHODS, find
from compare.methods.order.algebraic import Q, enclose, root
from compare.show.method import closed_form, decimal_form, describe, latex_form
from compare.show.method_text import FORMATS, page
from compare.show.render import render
from reference.arithmetic.precision import ctx

RK4 = """\
  0 |
1/2 | 1/2
1/2 |   0  1/2
  1 |   0    0    1
----+-------------------
  b | 1/6  1/3  1/3  1/6
"""


def shown(name: str, form: str = "text") -> str:
    return render(page(describe(find(name))), form)


def test_a_tableau_is_printed_as_books_print_it(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", "classical_rk4"]) == 0
    assert capsys.readouterr().out.endswith("\n\n" + RK4)


def test_the_facts_stand_before_the_tableau() -> None:
    facts = dict(re.findall(r"^(\S.*?)  +(\S.*)$", shown("gauss6").split("\n\n")[1], re.MULTILINE))
    assert facts == {
        "family": "implicit",
        "order": "6",
        "proven order": "6",
        "stages": "3",
        "evaluations with one iteration": "4",
        "evaluations per further iteration": "3",
        "stages solved by": "Newton's method",
        "symplectic": "yes",
        "symmetric": "yes",
        "FSAL": "no",
        "A-stable": "yes",
        "L-stable": "no",
        "needs": "the Jacobian of f",
        "aliases": "gauss_legendre_6, kuntzmann_butcher6",
        "source": "Butcher 1964, Math. Comp. 18, 50",
    }
    assert "5/36 - sqrt(15)/30" in shown("gauss6")


def test_a_tableau_too_wide_for_a_line_is_printed_entry_by_entry() -> None:
    text = shown("dop853")
    assert "    a[6,4] = 4/27 + sqrt(6)/108\n" in text
    assert max(map(len, text.splitlines())) <= 100
    assert "proven embedded orders  5, 3\n" in text


def test_a_splitting_is_printed_as_its_flows_with_closed_forms_and_decimals() -> None:
    lines = shown("yoshida4").splitlines()
    assert "drift  1/3 + 2^(1/3)/6 + 2^(2/3)/12    0.6756035959798288170238439" in lines
    assert sum(line.startswith(("kick", "drift")) for line in lines) == 7


def test_flows_without_closed_forms_have_25_digits() -> None:
    text = shown("kahan_li8")
    weights = [line.split()[1] for line in text.splitlines() if line.startswith(("kick", "drift"))]
    assert len(weights) == 35
    assert all(len(weight.lstrip("-").lstrip("0.").replace(".", "")) >= 24 for weight in weights)


def test_what_a_root_is_stands_with_the_facts() -> None:
    assert "0.9196615230173998570508976, where 12*r^4 - 24*r^2 + 16*r - 3 = 0" in shown("mclachlan_atela3")


def test_a_method_of_nystroms_kind_says_what_it_needs() -> None:
    text = shown("mclachlan_atela4")
    assert re.search(r"needs +positions apart from momenta, and velocities linear in\n +the momenta", text)
    assert re.search(r"proven order where velocities are not linear +3\n", text)


def test_a_method_without_a_table_says_what_a_step_does() -> None:
    text = " ".join(shown("taylor8").split())
    assert "step y + h (y[1] + h (y[2] + ... + h y[8])), where (k+1) y[k+1] = [f(y)][k] is the coefficient" in text
    found = json.loads(shown("taylor20", "json"))
    assert found["step"].startswith("y + h (y[1] + h (y[2] + ... + h y[20]))")
    assert (found["proven_order"], found["evaluations_per_step"], found["tables"]) == (20, 20, [])


def test_latex_has_the_array_in_mathematics() -> None:
    text = shown("gauss4", "latex")
    assert r"\frac{1}{2} - \frac{\sqrt{3}}{6} & \frac{1}{4} & \frac{1}{4} - \frac{\sqrt{3}}{6} \\" in text
    assert text.count(r"\begin{array}{c|cc}") == text.count(r"\end{array}") == 1
    assert r"\text{drift} & \frac{1}{3} + \frac{2^{1/3}}{6} + \frac{2^{2/3}}{12} \\" in shown("yoshida4", "latex")


def test_markdown_has_a_row_for_each_stage_and_each_row_of_weights() -> None:
    lines = shown("bogacki_shampine32", "markdown").splitlines()
    assert "| 3/4 | 0 | 3/4 |  |  |" in lines
    assert "| b, order 2 | 7/24 | 1/4 | 1/3 | 1/8 |" in lines


def test_json_has_every_number_exactly_and_as_a_decimal() -> None:
    found = json.loads(shown("dopri5", "json"))
    assert (found["name"], found["proven_order"], found["proven_embedded_orders"]) == ("dormand_prince54", 5, [4])
    assert (found["fsal"], found["evaluations_per_step"], found["aliases"]) == (True, 6, ["dopri5", "rk45", "dp5"])
    (table,) = found["tables"]
    assert table["a"][2][1] == {"exact": "9/40", "decimal": "0.225"}
    assert sum(Fraction(entry["exact"]) for entry in table["b_order_4"]) == 1
    flows = json.loads(shown("yoshida8", "json"))["tables"][0]["rows"]
    assert flows[0]["flow"] == "drift"
    assert flows[0]["weight"] == {"exact": None, "decimal": flows[-1]["weight"]["decimal"]}
    assert flows[0]["weight"]["decimal"].startswith("0.45742212311489578")


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.name)
def test_every_method_can_be_shown_in_every_format(method: object) -> None:
    description = describe(method)
    assert method.source[:20] in " ".join(render(page(description)).split())
    for form in FORMATS:
        assert method.name in render(page(description), form).replace("\\_", "_")


def test_decimals_are_correctly_rounded() -> None:
    value = root(2) / 3
    with ctx.workprec(200):
        exact = enclose(value)
        found = arb(decimal_form(value))
        assert abs(found - exact) < arb(10) ** -25 / 2
    assert decimal_form(Q(1, 8)) == "0.125"
    assert decimal_form(root(2) * root(2)) == "2"


def test_closed_forms_are_short_where_a_number_is() -> None:
    assert closed_form(Q(-3, 7)) == "-3/7"
    assert closed_form(Q("0.33259913678935943859974864")) == "0.33259913678935943859974864"
    assert closed_form(Q(1, 10**5 + 3)) == "1/100003"
    assert latex_form(Q(-3, 7)) == r"-\frac{3}{7}"
    assert latex_form((12 - 2 * root(6)) / 135) == r"\frac{4}{45} - \frac{2\sqrt{6}}{135}"
