"""What stands in a user's own module or file, by its name: ``MODULE:NAME`` or ``FILE.py:NAME``."""

from __future__ import annotations

import hashlib
import importlib
import importlib.util
import secrets
import sys
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

from reference.names import short, unknown

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

__all__ = ["EQUATION", "is_own", "named", "program", "program_at", "with_equations"]

EQUATION = ".toml"
"""How the name of a file with an equation ends."""
FLOW, CONFIG = "flow", "--config"
BEFORE = ("at", "solvers", "--problem", "--problems", "--family")
"""After these words, and as the first one, ``flow`` stands for a problem."""


def is_own(name: str) -> bool:
    """Whether a name is of something of the user's: MODULE:NAME, FILE.py:NAME, or FILE.toml of an equation."""
    return ":" in name or name.endswith(EQUATION)


def with_equations(words: Sequence[str]) -> list[str]:
    """The words of a command line, with FILE.toml in the place of ``flow --config FILE.toml``.

    Raises:
        ValueError: a file is not named, or not as one of an equation.
    """
    found: list[str] = []
    rest = iter(words)
    for word in rest:
        if word != FLOW or (found and found[-1] not in BEFORE):
            found.append(word)
            continue
        option, _, name = next(rest, "").partition("=")
        name = name or next(rest, "")
        if option != CONFIG or not name.endswith(EQUATION):
            raise ValueError(f"flow is an equation of your own; {CONFIG} FILE{EQUATION} behind it tells which.")
        found.append(name)
    return found


def named(name: str, what: str, example: str, fits: Callable[[Any], bool]) -> Any:
    """What ``name`` says: a module that can be imported from here or a file, and what is in it.

    Args:
        name: MODULE:NAME or FILE.py:NAME.
        what: what is looked for, such as "function".
        example: how such a name is spelt, such as "STEP".
        fits: whether something of the module is such a thing.

    Raises:
        ValueError: the name is not of this form, or there is no such thing.
        FileNotFoundError: there is no such file.
        ImportError: the module cannot be imported; the sentence repeats why.
    """
    home, colon, attribute = name.rpartition(":")
    if not (colon and home and attribute):
        raise ValueError(f"'{short(name)}' names no {what}; MODULE:{example} or FILE.py:{example} is accepted.")
    found: Any = _at(home)
    for part in attribute.split("."):
        if not hasattr(found, part):
            known = [one for one, value in vars(found).items() if fits(value) and not one.startswith("_")]
            raise ValueError(unknown(what, part, known))
        found = getattr(found, part)
    if not fits(found):
        raise ValueError(f"{attribute} in {home} is of type {type(found).__name__}; a {what} is accepted.")
    return found


def program_at(name: str) -> tuple[str, str]:
    """What tells the program behind MODULE:NAME or FILE.py:NAME: of the module itself, and of all that is his."""
    home = _at(name.rpartition(":")[0])
    path = Path(vars(home).get("__file__") or "")
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else "", program(home)


def program(home: ModuleType | None) -> str:
    """What tells the program of a module of the user's own from what it was, or will be, when it is changed.

    That is a hash of his modules as far as they are loaded: those of the same package, or beside the same file.  Of
    what stands in no file it is a number that never comes again.
    """
    modules = [one for one in [*sys.modules.values()] if isinstance(one, ModuleType)]
    files = {one.__name__: Path(vars(one).get("__file__") or "") for one in modules}
    if home is None or not files[home.__name__].name:
        return secrets.token_hex()
    package, folder = home.__name__.partition(".")[0], files[home.__name__].parent
    own = {
        path
        for name, path in files.items()
        if path.name and (name.partition(".")[0] == package or path.parent == folder)
    }
    digest = hashlib.sha256()
    for path in sorted(own):
        digest.update(hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()


def _at(home: str) -> ModuleType:
    return _file(Path(home)) if home.endswith(".py") else _module(home)


def _module(name: str) -> ModuleType:
    with _from_here(Path.cwd()), _excuses(name):
        return importlib.import_module(name)


def _file(path: Path) -> ModuleType:
    if not path.is_file():
        raise FileNotFoundError(f"there is no file '{path}'.")
    spec = importlib.util.spec_from_file_location(path.stem, path)
    if spec is None or spec.loader is None:
        raise ImportError(f"'{path}' is no Python file.")
    known = sys.modules.get(spec.name)
    if known is not None and Path(getattr(known, "__file__", None) or "").resolve() == path.resolve():
        return known
    if known is not None or _elsewhere(spec.name, path):
        raise ImportError(
            f"'{path}' has the name of the module {spec.name}, which is another; another name is accepted."
        )
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # where its classes look for themselves
    with _from_here(path.resolve().parent), _excuses(str(path)):
        spec.loader.exec_module(module)
    return module


def _elsewhere(name: str, path: Path) -> bool:
    """Whether a module of this name would be found that is not the file, such as one of Python's own."""
    found = importlib.util.find_spec(name)
    return found is not None and (found.origin is None or Path(found.origin).resolve() != path.resolve())


@contextmanager
def _from_here(folder: Path) -> Iterator[None]:
    """Import what lies in a folder, as Python does for a script there; worker processes then find it too."""
    sys.path.insert(0, str(folder))
    try:
        yield
    finally:
        sys.path.remove(str(folder))
        if str(folder) not in sys.path:
            sys.path.append(str(folder))


@contextmanager
def _excuses(name: str) -> Iterator[None]:
    """Whatever a module raises while it is imported, as one sentence."""
    try:
        yield
    except (Exception, SystemExit) as error:
        told = " ".join(str(error).split()).rstrip(".")
        raise ImportError(f"{name} cannot be imported: {type(error).__name__}{': ' * bool(told)}{told}.") from error
