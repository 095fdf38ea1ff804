"""Is an integrator what it says it is?  Order, symplecticity, reversibility and energy, measured."""
