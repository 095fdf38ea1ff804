"""The dataset as a file: its plan, its blocks, its build and its proof; all that knows HDF5."""
