"""A package whose solvers are in its modules."""
