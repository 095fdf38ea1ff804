"""The command line: `python -m compare pendulum` prints a study's tables; `python -m compare list` the methods.

The tables go to stdout, whatever the other options are, so that they can be piped.
`--out DIR` writes the same tables into a folder as well, `--plots` the figures; what was written is said on stderr.
`published figures --out DIR` writes the figures of two sources, drawn from the reference.
Exit codes: 0, 1 where a claim fails or no solver could be scored, 2 for a mistake of the user's or a disk that cannot
be written, 3 where no claim fails and one is not established, 130 when interrupted.
"""

from __future__ import annotations

import contextlib
import shutil
import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any

from compare.arguments import Request, parse
from reference.command.terminal import run
from reference.named import with_equations

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from compare.solvers.records import SolverStudy

__all__ = ["main"]

DEFAULT_FOLDER = "horologium-{problem}"
WORTH_PROCESSES = 1 << 18
"""Steps in all from which starting a process a core takes less time than it saves."""


def main(words: Sequence[str] | None = None) -> int:
    """Run one command line and return its exit code."""
    return run(_command, words)


def _command(words: Sequence[str] | None = None) -> int:
    request = parse(with_equations(sys.argv[1:] if words is None else words))
    if request.command == "check":
        return _check(request)
    if request.command == "errata":
        return _errata(request)
    if request.command == "score":
        _score(request)
        return 0
    if request.command == "list":
        _print(_listing(request.form))
    elif request.command == "show":
        _print(_method(request.options["method"], request.form))
    elif request.command == "report":
        _print(_report(request))
    elif request.command == "published":
        _print(_published(request))
    elif request.command == "solvers":
        return _solvers(request)
    else:
        _print(_shown(request, _study, "compare.show.study", "compare.show.plot"))
    return 0


def _shown(request: Request, run_study: Callable[..., Any], table: str, plot: str) -> str:
    """Run a study, write what is to be written, and return the tables, by the modules of its tables and its plots."""
    from compare.show import render

    out = request.out
    if out is None and request.plots:
        out = DEFAULT_FOLDER.format(problem=request.command)
    width = _width()
    with contextlib.ExitStack() as stack:
        results = None
        if out is not None:
            from compare.show.output import folder

            results = stack.enter_context(folder(out))
        with _progress(request.quiet) as progress:
            study = run_study(request, progress)
            page = import_module(table).page(study)
            if results is not None:
                results.write(render.files(page, request.form, width))
            if results is not None and request.plots:
                if progress is not None:
                    progress("drawing")
                results.write(import_module(plot).files(study))
    if results is not None and not request.quiet:
        print(f"wrote {', '.join(results.names)} into {results.target}", file=sys.stderr)
    return render.render(page, request.form, width)


def _check(request: Request) -> int:
    """Check an integrator in a process of its own; what it prints goes to stderr: stdout has the answer alone."""
    from compare.claims.contained import contained

    found = contained(request.options, request.form)
    _print(found.text)
    return found.code


def _errata(request: Request) -> int:
    """Print the errata, their checks run now; one that is not confirmed is a failure."""
    from compare.show import render
    from compare.sources.errata import entries, show

    found = show.records(entries.ENTRIES)
    _print(render.render(show.page(found), request.form, _width()))
    return 0 if all(record["confirmed"] for record in found) else 1


def _score(request: Request) -> None:
    """Judge a file, and print what is found as it is found."""
    from compare.files.score import Submission, judged

    with _progress(request.quiet) as progress:
        for piece in judged(Submission(**request.options), progress):
            _print(piece)


def _study(request: Request, progress: Callable[[str], None] | None) -> Any:
    """The study of a family, on a process pool where that is worth it."""
    from reference.command.executors import other_cores, processes

    home, others = "compare.study", other_cores()
    options = {**request.options, "family": request.family, "traces": request.plots, "progress": progress}
    if not others or sum(options.get("n", [WORTH_PROCESSES])) < WORTH_PROCESSES:
        return import_module(home).study(**options)
    with processes(others) as executor:
        for _ in range(others):
            executor.submit(import_module, home)  # they import while this process does, and computes the truth
        return import_module(home).study(**options, executor=executor)


def _solvers(request: Request) -> int:
    """Print a study of solvers; where none of them could be scored, that is a failure, of which the tables say why."""
    studies: list[SolverStudy] = []

    def kept(request: Request, progress: Callable[[str], None] | None) -> SolverStudy | list[SolverStudy]:
        studies.extend(_solver_studies(request, progress))
        return studies if "several" in request.options else studies[0]

    table = "compare.solvers.several" if "several" in request.options else "compare.solvers.table"
    _print(_shown(request, kept, table, "compare.solvers.plot"))
    if any(study.scored for study in studies):
        return 0
    print("error: none of these solvers could be scored; the tables say why.", file=sys.stderr)
    return 1


def _solver_studies(request: Request, progress: Callable[[str], None] | None) -> list[SolverStudy]:
    """The studies, on a process pool where there is a core for it; a pool begins when the first task comes to it."""
    from compare.solvers import several
    from reference.command.executors import other_cores, processes

    others = other_cores()
    with processes(others) if others else contextlib.nullcontext() as executor:
        return several.studies(request.options.get("several", [request.options]), progress, executor)


def _report(request: Request) -> str:
    """Write a report, or go on with one that was interrupted, and return its tables."""
    from compare.report import table
    from compare.report.run import plan, run
    from compare.show import render
    from reference.command.terminal import progress_bar

    wanted, out = plan(**request.options["plan"]), request.out or ""
    with progress_bar("measuring", quiet=request.quiet) as progress:
        found = run(wanted, out, jobs=request.options["jobs"], executor=request.options["executor"], progress=progress)
    if not request.quiet:
        print(f"wrote report.md and what goes with it into {out}", file=sys.stderr)
    return render.render(table.page(found), request.form, _width())


def _published(request: Request) -> str:
    """The tables that are named, or all; where figures are named, they are written."""
    from compare.show import render
    from compare.sources.published import show
    from compare.sources.published.entry import reproduce

    names, target = request.options["names"], request.options["figures"]
    found = reproduce(names) if names or target is None else []
    if target is not None:
        _draw_published(request, target)
    return render.render(show.page(found), request.form, _width()) if found else ""


def _draw_published(request: Request, target: str) -> None:
    from compare.show.output import folder
    from compare.sources.figures.show import files

    with folder(target) as results:
        results.write(files(request.options["drawn"]))
    if not request.quiet:
        print(f"wrote {', '.join(results.names)} into {results.target}", file=sys.stderr)


def _listing(form: str) -> str:
    from compare.methods import METHODS
    from compare.show import listing, render

    return render.render(listing.page(METHODS), form)


def _method(name: str, form: str) -> str:
    from compare.methods import find
    from compare.show import method_text, render
    from compare.show.method import describe

    return render.render(method_text.page(describe(find(name))), form)


def _width() -> int:
    """The width of the terminal, within what a table can use."""
    return min(max(shutil.get_terminal_size((100, 24)).columns, 80), 120)


@contextlib.contextmanager
def _progress(quiet: bool) -> Iterator[Callable[[str], None] | None]:
    """A line on the terminal that says what is being done, or nothing where there is no terminal."""
    if quiet or not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console

    with Console(stderr=True).status("starting") as status:
        yield status.update


def _print(text: str) -> None:
    """Print the tables, in UTF-8 or in what the terminal can show."""
    encoding = sys.stdout.encoding or "utf-8"
    sys.stdout.write(text.encode(encoding, "replace").decode(encoding))


if __name__ == "__main__":
    sys.exit(main())
