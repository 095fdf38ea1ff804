"""Rosenbrock methods, each as printed in its source: linear systems with the Jacobian in the place of iterations.

Those of Hairer and Wanner and of Steinebach are published as decimals: the coefficients are the zero of the order
conditions, of the method and of its embedded weights, beside them.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from operator import add
from typing import TYPE_CHECKING, Any

from compare.methods.explicit import line, lines
from compare.methods.kinds.one_step import Embedded
from compare.methods.kinds.rosenbrock import Rosenbrock, Slopes, from_slopes
from compare.methods.order.algebraic import Q, root
from compare.methods.order.refined import refined
from compare.methods.order.rooted_trees import ElementaryWeights, density, trees
from reference.arithmetic.namespaces import BALL

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.methods.order.algebraic import Coefficient

__all__ = ["RODAS3", "RODAS4", "RODAS4P", "RODAS5P", "ROS3P", "ROSENBROCK", "ROSENBROCK23"]

ROOT2, ROOT3 = root(2), root(3)
G: Any = 1 / (2 + ROOT2)
E: Any = 6 + ROOT2

ROSENBROCK23 = from_slopes(
    name="rosenbrock23", order=2, source="Shampine and Reichelt 1997, SIAM J. Sci. Comput. 18, 1",
    alpha=lines("", "1/2", "0 1"),
    gammas=((G,), (-G, G), ((E - 2) * G, -E * G, G)),
    b=line("0 1 0"),
    embedded=(Embedded(3, line("1/6 2/3 1/6")),),
    aliases=("ode23s",),
)  # fmt: skip

G = (3 + ROOT3) / 6

ROS3P = from_slopes(
    name="ros3p", order=3, source="Lang and Verwer 2001, BIT 41, 731",
    alpha=lines("", "1", "1 0"),
    gammas=((G,), (Q(-1), G), (-G, Q(1, 2) - 2 * G, G)),
    b=line("2/3 0 1/3"),
    embedded=(Embedded(2, line("1/3 1/3 1/3")),),
)  # fmt: skip

RODAS3 = Rosenbrock(
    name="rodas3", order=3, source="Sandu, Verwer and others 1997, Atmos. Environ. 31, 3459",
    gamma=Q(1, 2),
    a=lines("", "0", "2 0", "2 0 1"),
    c=lines("", "4", "1 -1", "1 -1 -8/3"),
    m=line("2 0 1 1"),
    embedded=(Embedded(2, line("2 0 1 0")),),
)  # fmt: skip


@dataclass(frozen=True)
class _Decimals:
    """A stiffly accurate method as its code prints it: decimals of a and c, row after row.

    The last ``repeated`` rows of a are the one before with a 1 behind, and so is m of the last; the embedded weights
    are m without its last entry.

    Attributes:
        name, order: of the method; that of the embedded weights is one lower.
        printed: gamma and the entries, by their names.
        repeated: rows of a that are not printed.
        sums: rows whose sums of alpha and of gamma are known, with them.
        estimated: orders whose conditions for the embedded weights do not follow from the sums.
    """

    name: str
    order: int
    printed: dict[str, str]
    repeated: int
    sums: tuple[tuple[int, str, str], ...]
    estimated: range

    def table(self, values: Sequence[Any]) -> tuple[Any, list[list[Any]], list[list[Any]], list[Any]]:
        """gamma, a, c and m in any arithmetic."""
        v = dict(zip(self.printed, values, strict=True))
        stages = max(int(name[1]) for name in v if name[0] == "c")
        a = [[v[f"a{i}{j}"] for j in range(1, i)] for i in range(1, stages + 1 - self.repeated)]
        for _ in range(self.repeated):
            a.append([*a[-1], 1])
        c = [[v[f"c{i}{j}"] for j in range(1, i)] for i in range(1, stages + 1)]
        return v["gamma"], a, c, [*a[-1], 1]

    def conditions(self, values: Sequence[Any]) -> list[Any]:
        """Order and embedded order, and the sums."""
        gamma, a, c, m = self.table(values)
        slopes = Slopes(gamma, a, c)
        weights = ElementaryWeights(slopes.alpha, alone=slopes.beta)
        orders = [(slopes.weights(m), range(1, self.order + 1)), (slopes.weights([*m[:-1], 0]), self.estimated)]
        residuals = [
            weights.weight(b, tree) * density(tree) - 1 for b, some in orders for order in some for tree in trees(order)
        ]
        for row, alpha, own in self.sums:
            inner = reduce(add, slopes.alpha[row - 1])
            residuals += [
                inner - BALL.number(Q(alpha)),
                reduce(add, slopes.beta[row - 1]) - inner - BALL.number(Q(own)),
            ]
        return residuals


def _stiffly_accurate(
    decimals: _Decimals, kept: str, source: str, *, slack: int, aliases: tuple[str, ...] = ()
) -> Rosenbrock:
    """The method whose coefficients are the zero of the conditions, those that are ``kept`` as printed."""
    places = [list(decimals.printed).index(name) for name in ("gamma", *kept.split())]
    values = refined(decimals.name, decimals.conditions, tuple(decimals.printed.values()), places, slack)
    gamma, a, c, m = decimals.table(values)
    return Rosenbrock(
        decimals.name, decimals.order, source, gamma, tuple(map(_exact, a)), tuple(map(_exact, c)), _exact(m),
        embedded=(Embedded(decimals.order - 1, _exact([*m[:-1], 0])),),
        aliases=aliases,
    )  # fmt: skip


def _exact(row: Sequence[Any]) -> tuple[Coefficient, ...]:
    """A row with its integers as fractions."""
    return tuple(Q(value) if isinstance(value, int) else value for value in row)


def _named(gamma: str, a: Sequence[str], c: Sequence[str]) -> dict[str, str]:
    """The decimals of rows from the second on, named a21, a31, a32, ..., c21, ..."""
    found = {"gamma": gamma}
    for letter, rows in (("a", a), ("c", c)):
        for i, row in enumerate(rows, start=2):
            found |= {f"{letter}{i}{j}": text for j, text in enumerate(row.split(), start=1)}
    return found


RODAS4 = _stiffly_accurate(
    _Decimals(
        "rodas4", 4,
        _named(
            "0.25",
            (
                "1.544",
                "0.9466785280815826 0.2557011698983284",
                "3.314825187068521 2.896124015972201 0.9986419139977817",
                "1.221224509226641 6.019134481288629 12.53708332932087 -0.6878860361058950",
            ),
            (
                "-5.6688",
                "-2.430093356833875 -0.2063599157091915",
                "-0.1073529058151375 -9.594562251023355 -20.47028614809616",
                "7.496443313967647 -10.24680431464352 -33.99990352819905 11.70890893206160",
                "8.083246795921522 -7.981132988064893 -31.52159432874371 16.31930543123136 -6.058818238834054",
            ),
        ),
        repeated=1,
        sums=((3, "0.21", "0.1035"), (4, "0.63", "-0.0362"), (5, "1", "0")),
        estimated=range(2, 4),
    ),
    "a21 a43 c21 c32 c41 c42 c61 c62",
    "Hairer and Wanner 1996, Solving Ordinary Differential Equations II, IV.7 and VI.4, RODAS, method 1",
    slack=84,
    aliases=("rodas", "rodas43"),
)  # fmt: skip

RODAS4P = _stiffly_accurate(
    _Decimals(
        "rodas4p", 4,
        _named(
            "0.25",
            (
                "3",
                "1.831036793486759 0.4955183967433795",
                "2.304376582692669 -0.05249275245743001 -1.176798761832782",
                "-7.170454962423024 -4.741636671481785 -16.31002631330971 -1.062004044111401",
            ),
            (
                "-12",
                "-8.791795173947035 -2.207865586973518",
                "10.81793056857153 6.780270611428266 19.53485944642410",
                "34.19095006749676 15.49671153725963 54.74760875964130 14.16005392148534",
                "34.62605830930532 15.30084976114473 56.99955578662667 18.40807009793095 -5.714285714285717",
            ),
        ),
        repeated=1,
        sums=((3, "0.21", "-0.023504"), (4, "0.63", "-0.0362"), (5, "1", "0")),
        estimated=range(2, 4),
    ),
    "a21 a32 a42 a43 a51 a54 c21 c42",
    "Steinebach 1995, TH Darmstadt, preprint 1741, as method 3 of the code RODAS",
    slack=9,
    aliases=("rodasp",),
)  # fmt: skip

RODAS5P = _stiffly_accurate(
    _Decimals(
        "rodas5p", 5,
        _named(
            "0.21193756319429014",
            (
                "3",
                "2.849394379747939 0.45842242204463923",
                "-6.954028509809101 2.489845061869568 -10.358996098473584",
                "2.8029986275628964 0.5072464736228206 -0.3988312541770524 -0.04721187230404641",
                "-7.502846399306121 2.561846144803919 -11.627539656261098 -0.18268767659942256 0.030198172008377946",
            ),
            (
                "-14.155112264123755",
                "-17.97296035885952 -2.859693295451294",
                "147.12150275711716 -1.41221402718213 71.68940251302358",
                "165.43517024871676 -0.4592823456491126 42.90938336958603 -5.961986721573306",
                "24.854864614690072 -3.0009227002832186 47.4931110020768 5.5814197821558125 -0.6610691825249471",
                (
                    "30.91273214028599 -3.1208243349937974 77.79954646070892 34.28646028294783 "
                    "-19.097331116725623 -28.087943162872662"
                ),
                (
                    "37.80277123390563 -3.2571969029072276 112.26918849496327 66.9347231244047 "
                    "-40.06618937091002 -54.66780262877968 -9.48861652309627"
                ),
            ),
        ),
        repeated=2,
        sums=((6, "1", "0"),),
        estimated=range(1, 5),
    ),
    "a32 a51 a53 a54 a63 a64 a65 c51 c52 c61 c62 c64 c72 c75 c76 c82",
    "Steinebach 2023, BIT 63, 27; its decimals are those of a computation in doubles, up to 3e-12 from the zero",
    slack=449,
)  # fmt: skip

ROSENBROCK = (ROSENBROCK23, ROS3P, RODAS3, RODAS4, RODAS4P, RODAS5P)
