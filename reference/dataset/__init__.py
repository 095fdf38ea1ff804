"""The dataset as a file: the only part of the package that knows HDF5."""

from reference.dataset.errors import DatasetError
from reference.dataset.reader import CORE_NAME, Dataset, Variable, core_path, load

__all__ = ["CORE_NAME", "Dataset", "DatasetError", "Variable", "core_path", "load"]
