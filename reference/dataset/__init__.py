"""The dataset as a file: its plan, its blocks, its build and its proof; all that knows HDF5."""

from reference.packages import required

required("numpy", by="a dataset")
required("h5py", by="a dataset")
