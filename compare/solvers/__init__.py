"""Adaptive solvers as people call them, asked and scored."""
