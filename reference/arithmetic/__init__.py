"""The numbers: exact inputs, balls, series, duals, formulas, limbs and their rounding."""
