"""Every method has the order that it declares by slope in extended precision, and what its table proves."""

from __future__ import annotations

import re
from fractions import Fraction
from functools import cache

import pytest

from compare.march.precision import Precision, precision
from compare.measure.errors import score_method
from compare.measure.order_fit import fit_order
from compare.measure.truth import Course
from compare.methods import DEFAULT, METHODS, _plain, find
from compare.methods.explicit import RK4
from compare.methods.extrapolation import extrapolated
from compare.methods.kinds.nystrom import EmbeddedNystrom, RungeKuttaNystrom
from compare.methods.kinds.one_step import Embedded, Method, Splitting, Tableau
from compare.methods.kinds.partitioned import Partitioned
from compare.methods.kinds.rosenbrock import Rosenbrock, from_slopes
from compare.methods.order.algebraic import Q
from compare.methods.symplectic import SUZUKI4, VERLET, YOSHIDA4
from reference import Pendulum

tables = pytest.mark.parametrize(
    "method", [method for method in METHODS if method.family != "multistep"], ids=lambda method: method.name
)
FLOAT128 = precision("float128")
WIDER = {name: precision("mp:256") for name in ("taylor20", "feagin12", "feagin14")}
WIDER |= {"rkn1210": precision("mp:192"), "radau15": precision("mp:160")}
"""The formats of methods that in binary128 come to rounding before their error falls as it does in the end."""
STEPS = {
    "sofroniou_spaletta10": (64, 128, 256, 512),  # in more it reaches the rounding floor of binary128
    "tsitouras54": (1024, 2048, 4096, 8192, 16384),  # its leading error is so small that the next one lasts longer
    "bogacki_shampine54": (1024, 2048, 4096, 8192, 16384),  # the same
    "verner65": (128, 256, 512, 1024, 2048),
    "verner87": (64, 128, 256, 512),
    "verner98": (32, 64, 128, 256, 512),
    "feagin10": (64, 128, 256, 512, 1024),
    "feagin12": (128, 256, 512, 1024),
    "feagin14": (64, 128, 256, 512),
    "taylor12": (32, 64, 128, 256, 512),  # rounding, as above
    "rkn1210": (128, 256, 512, 1024),  # its next error lasts longer than its leading one is above that of binary128
    "processed6": (4096, 8192, 16384),  # its next error lasts longer
    "gauss10": (64, 128, 256, 512),
    "gbs10": (128, 256, 512, 1024),
    "gbs10_bulirsch": (128, 256, 512, 1024),
    "radau15": (32, 64, 128, 256),
}
USUAL_STEPS = (256, 512, 1024, 2048, 4096)
MOTIONS = {
    "verner65": (1.0, Fraction(1, 2)),
    "verner87": (2.5, Fraction(1, 2)),
    "verner98": (0.5, Fraction(2)),
    "feagin12": (2.0, Fraction(1, 2)),
    "feagin14": (2.0, Fraction(1, 4)),
}
"""Amplitude and time where the leading error of a method shows that elsewhere is smaller than the next one."""
USUAL_MOTION = (1.0, Fraction(2))


@cache
def course(n: int, fmt: Precision, amplitude: float, time: Fraction) -> Course:
    return Course(Pendulum(amplitude), n, time, fmt)


@tables
def test_order_by_slope_in_extended_precision_is_the_declared_one(method: Method) -> None:
    fmt = WIDER.get(method.name, FLOAT128)
    motion = MOTIONS.get(method.name, USUAL_MOTION)
    courses = [course(n, fmt, *motion) for n in STEPS.get(method.name, USUAL_STEPS)]
    cells, _ = score_method(method, courses, fmt)
    fitted = fit_order(method, cells)
    assert fitted.cells_used == len(courses)
    assert abs(fitted.fitted_order - method.order) < 0.02


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.name)
def test_a_source_is_an_author_and_a_year(method: Method) -> None:
    author, year = re.fullmatch(r"((?:de )?[^\W\d]\D+) (\d{4}), .+", method.source).groups()
    assert author
    assert 1700 < int(year) < 2030


def test_names_and_aliases_are_unique() -> None:
    names = [name for method in METHODS for name in (method.name, *method.aliases)]
    assert len(names) == len(set(names))
    assert all(re.fullmatch(r"[a-z][a-z0-9_]*", name) for name in names)


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.name)
def test_every_alias_is_the_same_method(method: Method) -> None:
    assert all(find(name) is method for name in (method.name, *method.aliases))


def test_methods_of_many_names_are_one() -> None:
    assert find("velocity_verlet") is find("pseudo_leapfrog") is find("lobatto_iiia_iiib2") is VERLET
    assert find("forest_ruth") is find("candy_rozmus4") is YOSHIDA4


def test_two_tables_are_never_the_same_method() -> None:
    kinds = (Tableau, Splitting, Partitioned, RungeKuttaNystrom, Rosenbrock)
    one_step = [method for method in METHODS if isinstance(method, kinds)]

    def coefficients_of(method: Method) -> object:
        if isinstance(method, Splitting):
            return method.flows
        if isinstance(method, Rosenbrock):
            return method.gamma, method.a, method.c, method.m
        return method.matrix, method.b, getattr(method, "hat", ())

    coefficients = [*map(coefficients_of, one_step)]
    for i, table in enumerate(coefficients):
        assert table not in coefficients[:i], one_step[i].name


def test_the_default_methods_are_known_ones() -> None:
    assert len(DEFAULT) == 12
    assert all(find(method.name) is method for method in DEFAULT)


def test_an_unknown_method_names_the_nearest() -> None:
    with pytest.raises(ValueError, match="method 'yoshida' is unknown, perhaps yoshida"):
        find("yoshida")
    with pytest.raises(ValueError, match="method '###' is unknown; accepted are euler, midpoint"):
        find("###")


def test_the_families_of_the_list_are_there() -> None:
    names = {name for method in METHODS for name in (method.name, *method.aliases)}
    assert names >= {
        "euler", "midpoint", "heun", "ralston", "kutta3", "ssprk3", "rk4", "three_eighths", "butcher6", "dopri5",
        "dop853", "rk4_misprinted", "bogacki_shampine32", "fehlberg45", "cash_karp54", "tsit5", "symplectic_euler",
        "symplectic_euler_adjoint", "verlet", "position_verlet", "pseudo_leapfrog", "mclachlan_atela2",
        "mclachlan_atela3", "mclachlan_atela4", "ruth3", "candy_rozmus4", "forest_ruth", "yoshida4", "suzuki4",
        "calvo_sanz_serna4", "pefrl", "blanes_moan4", "blanes_moan6", "yoshida6", "yoshida8", "kahan_li6", "kahan_li8",
        "sofroniou_spaletta10", "blanes_moan_srkn6b", "blanes_moan_srkn11b", "blanes_moan_srkn14a", "implicit_euler",
        "trapezoid", "implicit_midpoint", "gauss4", "gauss6", "radau3", "radau5", "lobatto_pair4",
        "ralston3", "ralston4", "ssprk54", "ssprk104", "bogacki_shampine54", "verner65", "verner76", "verner87",
        "verner98", "rk8713m", "fehlberg78", "feagin10", "feagin12", "feagin14", "calvo_montijano_randez65",
        "taylor4", "taylor8", "taylor12", "taylor20", "rkn43", "rkn64", "rkn86", "rkn1210", "mclachlan4", "mclachlan6",
        "aba864", "aba1064", "saba4", "sbab4", "sabac4", "sbabc4", "chin4a", "vefrl", "omf4", "omelyan6_gp5",
        "processed4", "processed6", "processed764", "gauss8", "gauss10", "gauss_radau15", "ias15", "alexander2",
        "alexander3", "crouzeix3", "crouzeix4", "sdirk4", "tr_bdf2", "kvaerno3", "kvaerno4", "kvaerno5", "kencarp3",
        "kencarp4", "kencarp5", "ros3p", "rodas", "rodas3", "rodas4", "rodas4p", "rodas5p", "ode23s", "gbs4", "gbs6",
        "gbs8", "gbs10", "bulirsch_stoer10",
    }  # fmt: skip


def test_a_composition_of_symmetric_steps_merges_its_kicks() -> None:
    assert [kind for kind, _ in YOSHIDA4.flows] == ["drift", "kick"] * 3 + ["drift"]
    assert YOSHIDA4.evaluations(0) == (3, 0)
    assert SUZUKI4.evaluations(0) == (5, 1)


def test_nodes_are_derived_from_the_rows_unless_others_are_printed() -> None:
    assert RK4.c == (0, Q(1, 2), Q(1, 2), 1)
    assert find("rk4_misprinted").c == (0, Q(1, 2), Q(1, 2), 1)
    assert [sum(row) for row in find("rk4_misprinted").matrix] == [0, 1, 1, 1]
    assert RK4.explicit
    assert not find("implicit_midpoint").explicit


def test_a_table_that_is_no_method_is_refused() -> None:
    with pytest.raises(ValueError, match="the weights b sum to 1/2"):
        Tableau("bad", 1, "none", ((),), (Q(1, 2),))
    with pytest.raises(ValueError, match="a has 2 rows and b 1"):
        Tableau("bad", 1, "none", ((), (Q(1),)), (Q(1),))
    with pytest.raises(ValueError, match="2 embedded weights; 1 are accepted"):
        Tableau("bad", 1, "none", ((),), (Q(1),), embedded=(Embedded(1, (Q(1), Q(0))),))
    with pytest.raises(ValueError, match="the weights b sum to 2"):
        Tableau("bad", 1, "none", ((),), (Q(1),), embedded=(Embedded(1, (Q(2),)),))
    with pytest.raises(ValueError, match="kicks sum to 2"):
        Splitting("bad", 1, "none", (("kick", Q(2)), ("drift", Q(1))))
    with pytest.raises(ValueError, match="neighbouring flows are of one kind"):
        Splitting("bad", 1, "none", (("kick", Q(1)), ("drift", Q(1, 2)), ("drift", Q(1, 2))))
    with pytest.raises(ValueError, match="a gradient is of Nystrom's kind alone; nystrom=True is accepted"):
        Splitting("bad", 1, "none", (("kick", Q(1)), ("gradient", Q(1)), ("drift", Q(1))))
    with pytest.raises(ValueError, match="a is not strictly lower of 1 rows; such is accepted"):
        RungeKuttaNystrom("bad", 1, "none", (Q(0),), ((Q(1),),), (Q(1, 2),), (Q(1),))
    with pytest.raises(ValueError, match="the weights sum to 1 and 1; 1/2 and 1 are accepted"):
        RungeKuttaNystrom("bad", 1, "none", (Q(0),), ((),), (Q(1),), (Q(1),))
    few = EmbeddedNystrom(1, (Q(1, 2), Q(0)), (Q(1),))
    with pytest.raises(ValueError, match="2 and 1 weights; 1 of each are accepted"):
        RungeKuttaNystrom("bad", 1, "none", (Q(0),), ((),), (Q(1, 2),), (Q(1),), (few,))
    with pytest.raises(ValueError, match="a matrix is not of 1 rows and columns"):
        Partitioned("bad", 1, "none", ((Q(1),),), ((Q(1), Q(0)),), (Q(1),))
    with pytest.raises(ValueError, match="the weights b sum to 3"):
        Partitioned("bad", 1, "none", ((Q(1),),), ((Q(1),),), (Q(3),))
    with pytest.raises(ValueError, match="iteration 'Newton' is unknown, perhaps Newton's method"):
        Tableau("bad", 1, "none", ((Q(1),),), (Q(1),), solved_by="Newton")
    with pytest.raises(ValueError, match=r"rows of \[0, 0\] entries; 0 to 1 are accepted"):
        Rosenbrock("bad", 1, "none", Q(1), ((), ()), ((), (Q(1),)), (Q(1), Q(1)))
    with pytest.raises(ValueError, match="1 embedded weights; 2 are accepted"):
        Rosenbrock("bad", 1, "none", Q(1), ((), (Q(1),)), ((), (Q(1),)), (Q(1), Q(1)), embedded=(Embedded(1, (Q(1),)),))
    with pytest.raises(ValueError, match="the diagonal of gamma has several numbers"):
        from_slopes("bad", 1, "none", ((), (Q(1),)), ((Q(1),), (Q(1), Q(2))), (Q(1), Q(1)))
    with pytest.raises(ValueError, match=r"the numbers of steps are \(2, 3\); even ones that rise are accepted"):
        extrapolated("bad", (2, 3), "none")


@pytest.mark.parametrize(
    ("written", "name"),
    [("Störmer-Verlet", "verlet"), ("yoshida-6", "yoshida6"), ("Kahan-Li 8", "kahan_li8"), ("RK 4", "rk4")],
)
def test_a_method_is_found_however_its_name_is_written(written: str, name: str) -> None:
    assert find(written).name == name


def test_no_two_methods_share_a_spelling() -> None:
    spellings = [_plain(known) for method in METHODS for known in {method.name, *method.aliases}]
    assert len(spellings) == len(set(spellings))
