"""A report of work and precision: methods and solvers over problems and amplitudes, resumable, on any executor."""
