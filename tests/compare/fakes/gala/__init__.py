"""A package whose integrators are in its modules."""
