"""Integrators scored against the proven reference."""
