"""Tensors that are NumPy's arrays, and functions that take tensors alone."""

import numpy as np


class Tensor(np.ndarray):
    def unbind(self, axis):
        return tuple(np.moveaxis(self, axis, 0))

    def numpy(self):
        return np.asarray(self)


def as_tensor(values):
    return np.asarray(values).view(Tensor)


def zeros_like(tensor):
    return as_tensor(np.zeros_like(tensor))


def stack(tensors, dim):
    assert all(isinstance(one, Tensor) for one in tensors)
    return as_tensor(np.stack(tensors, axis=dim))


def sin(tensor):
    assert isinstance(tensor, Tensor)
    return as_tensor(np.sin(tensor))
