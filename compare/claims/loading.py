"""A user's function by name: MODULE:STEP, or FILE.py:STEP."""

from __future__ import annotations

import functools
import importlib
import importlib.util
import sys
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reference.names import short, unknown

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import ModuleType

__all__ = ["loaded"]


def loaded(name: str) -> Callable[..., Any]:
    """The function that ``name`` says: a module that can be imported from here or a file, and what is in it.

    Raises:
        ValueError: the name is not of this form, or there is no such function.
        FileNotFoundError: there is no such file.
        ImportError: the module cannot be imported; the sentence repeats why.
    """
    home, colon, attribute = name.rpartition(":")
    if not (colon and home and attribute):
        raise ValueError(f"'{short(name)}' names no function; MODULE:STEP or FILE.py:STEP is accepted.")
    found: Any = _file(Path(home)) if home.endswith(".py") else _module(home)
    for part in attribute.split("."):
        if not hasattr(found, part):
            functions = [known for known, value in vars(found).items() if callable(value) and not known.startswith("_")]
            raise ValueError(unknown("function", part, functions))
        found = getattr(found, part)
    if not callable(found):
        raise ValueError(f"{attribute} in {home} is of type {type(found).__name__}; a function is accepted.")  # noqa: TRY004 - of words
    return _named(attribute, found)


def _named(name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    """The function under the name by which it was asked for; its own may be that of a closure or a lambda."""

    def called(*arguments: Any) -> Any:
        return function(*arguments)

    functools.update_wrapper(called, function, assigned=(), updated=())  # the arguments are still those of the function
    called.__name__ = name
    return called


def _module(name: str) -> ModuleType:
    with _from_here(Path.cwd()), _excuses(name):
        return importlib.import_module(name)


def _file(path: Path) -> ModuleType:
    if not path.is_file():
        raise FileNotFoundError(f"there is no file '{path}'.")
    spec = importlib.util.spec_from_file_location(path.stem, path)
    if spec is None or spec.loader is None:
        raise ImportError(f"'{path}' is no Python file.")
    module = importlib.util.module_from_spec(spec)
    with _from_here(path.resolve().parent), _excuses(str(path)):
        spec.loader.exec_module(module)
    return module


@contextmanager
def _from_here(folder: Path) -> Iterator[None]:
    """Import what lies in a folder, as Python does for a script there."""
    sys.path.insert(0, str(folder))
    try:
        yield
    finally:
        sys.path.remove(str(folder))


@contextmanager
def _excuses(name: str) -> Iterator[None]:
    """Whatever a module raises while it is imported, as one sentence."""
    try:
        yield
    except (Exception, SystemExit) as error:
        told = " ".join(str(error).split()).rstrip(".")
        raise ImportError(f"{name} cannot be imported: {type(error).__name__}{': ' * bool(told)}{told}.") from error
