"""A compiler that compiles nothing: a function's address is the function."""

from types import SimpleNamespace


def cfunc(signature):
    assert signature == "signature"
    return lambda function: SimpleNamespace(address=function)
