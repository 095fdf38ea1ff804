"""Taylor's method in some orders: two that many methods have, and two for wide formats; heyoka takes 20 in doubles."""

from compare.methods.kinds.taylor import Taylor

__all__ = ["TAYLOR", "TAYLOR4", "TAYLOR8", "TAYLOR12", "TAYLOR20"]

SOURCE = "Moore 1966, Interval Analysis; Jorba and Zou 2005, Exp. Math. 14, 99"

TAYLOR4 = Taylor("taylor4", 4, SOURCE)
TAYLOR8 = Taylor("taylor8", 8, SOURCE)
TAYLOR12 = Taylor("taylor12", 12, SOURCE)
TAYLOR20 = Taylor("taylor20", 20, SOURCE)

TAYLOR = (TAYLOR4, TAYLOR8, TAYLOR12, TAYLOR20)
