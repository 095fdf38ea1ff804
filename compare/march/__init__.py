"""Many fixed steps at once: the equation in floats, traced and compiled steps, number formats."""
