"""The version of the program, which is part of what a dataset says of its origin."""

__all__ = ["__version__"]

__version__ = "0.1.0"
