"""Methods that keep the energy."""

from compare.methods.explicit import RK4
from compare.methods.kinds.conservative import AverageVectorField, DiscreteGradient, Projected

__all__ = ["AVF", "CONSERVATIVE", "GONZALEZ", "PROJECTED_RK4"]

PROJECTED_RK4 = Projected(
    "projected_rk4", 4, "Hairer, Lubich and Wanner 2006, Geometric Numerical Integration, algorithm IV.4.2",
    base=RK4,
    aliases=("rk4_projected",),
)  # fmt: skip

AVF = AverageVectorField(
    "avf", 2, "Quispel and McLaren 2008, J. Phys. A 41, 045206; LaBudde and Greenspan 1974, J. Comput. Phys. 15, 134",
    aliases=("average_vector_field", "energy_momentum", "labudde_greenspan"),
)  # fmt: skip

GONZALEZ = DiscreteGradient(
    "gonzalez", 2, "Gonzalez 1996, J. Nonlinear Sci. 6, 449; McLachlan, Quispel and Robidoux 1999, "
    "Phil. Trans. R. Soc. A 357, 1021",
    aliases=("discrete_gradient", "midpoint_discrete_gradient"),
)  # fmt: skip

CONSERVATIVE = (PROJECTED_RK4, AVF, GONZALEZ)
