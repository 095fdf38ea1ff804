"""The brachistochrone against other curves between the same points: the straight line, and a family of neighbours.

The neighbours keep z(psi) and turn aside, phi + epsilon eta(psi), with

    eta = (1 - z0) sin^3(psi/2) sin((psi_end - psi)/2),     eta' = (1 - z0) sin^2(psi/2) h(psi),

which vanishes at both ends.  With b = sqrt(kappa) eta', whose integral is zero, and c^2 = (z^2/v^2 - kappa) eta'^2
Bouguer's law turns the difference of the times into the integral of

    epsilon^2 c^2/(sqrt((tau' + epsilon b)^2 + epsilon^2 c^2) + tau' + epsilon b),

in which nothing cancels and nothing is negative: z^2/v^2 >= kappa all along the extremal.  For any other eta the same
holds; for every curve that stays above z0 the time is at least the integral of cos(alpha) |dz|/v + sqrt(kappa) dphi,
with alpha the extremal's own direction at that height, and that integral is the extremal's time.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from reference.problems.polar.equations import Field

__all__ = ["chord_geometry", "chord_time", "neighbour_excess", "neighbour_rates"]

ZERO = Fraction(0)


def chord_geometry(m: Any, radius: Any, drop: Any, angle: Any) -> tuple[Any, Any, Any]:
    """The length of the straight line from (1, 0) to (radius, angle), and sine and cosine of its angle with the radius.

    ``drop`` is 1 - radius, given so that nothing cancels.
    """
    aside = radius * m.sin(angle / 2) ** 2
    length = m.sqrt(drop * drop + 4 * aside)
    return length, radius * m.sin(angle) / length, (drop + 2 * aside) / length


def chord_time(m: Any, field: Field, radius: Any, drop: Any, angle: Any) -> Any:
    """The time of the straight line from (1, 0) to (radius, angle), released at rest.

    On the circle over the whole chord to z = 1 the point at the angle chi lies above the body: the way is
    cos(beta) (1 - cos(chi)), z^2 = sin^2(beta) sin^2(chi) + cos^2(chi), and the time is the integral of
    sqrt(1 - z^2)/v over 0 <= chi <= 2 atan2(length, sqrt(1 - radius^2)).
    """
    length, sine, _ = chord_geometry(m, radius, drop, angle)

    def slowness(m: Any, chi: Any) -> Any:
        return field.slowness(m, m.sqrt((sine * m.sin(chi)) ** 2 + m.cos(chi) ** 2))

    return m.integral(slowness, m.number(ZERO), 2 * m.atan2(length, m.sqrt(drop * (1 + radius))))


def neighbour_rates(m: Any, field: Field, z0: Any, psi_end: Any, epsilon: Any, psi: Any) -> tuple[Any, Any]:
    """dtau/dpsi of a neighbour along the extremal's direction, and squared across it."""
    sine, cosine, rest = m.sin(psi / 2), m.cos(psi / 2), (psi_end - psi) / 2
    turn = (1 - z0) * sine * (3 * cosine * m.sin(rest) - sine * m.cos(rest)) / 2
    squares = sine * sine, cosine * cosine
    _, rate = field.rates(m, z0, *squares)
    along = rate + epsilon * m.sqrt(field.kappa(z0)) * sine * turn
    return along, (epsilon * turn) ** 2 * field.excess(m, z0, *squares)


def neighbour_excess(field: Field, z0: Any, psi_end: Any, epsilon: Any) -> Callable[[Any, Any], Any]:
    """By how much dtau/dpsi of the neighbour exceeds the extremal's, less what integrates to zero: (m, psi) -> number.

    Its integral over 0 <= psi <= psi_end is the time that the neighbour takes longer; with psi_end = 2 pi it is
    periodic.
    """

    def excess(m: Any, psi: Any) -> Any:
        along, across = neighbour_rates(m, field, z0, psi_end, epsilon, psi)
        return across / (m.sqrt(along * along + across) + along)

    return excess
