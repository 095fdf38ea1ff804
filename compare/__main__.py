"""The command line: `python -m compare pendulum` prints a study's tables; `python -m compare list` the methods.

The tables go to stdout, whatever the other options are, so that they can be piped.
`--out DIR` writes the same tables into a folder as well, `--plots` the figures; what was written is said on stderr.
`published figures --out DIR` writes the figures of two sources, drawn from the reference.
Exit codes: 0, 1 where a claim fails, a limit does not hold, an answer is worse than its baseline or no solver could be
scored, 2 for a mistake of the user's or a disk that cannot be written, 3 where no claim fails and one is not
established, 130 when interrupted.
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

    from compare.baseline import Baseline, Comparison, Gate
    from compare.show.page import Page
    from compare.solvers.records import SolverStudy

__all__ = ["main"]

DEFAULT_FOLDER = "horologium-{problem}"
READABLE = frozenset({"text", "markdown", "latex"})
"""Forms of an answer at the end of which stands what a gate finds; of others it is said on stderr."""
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
        return _score(request)
    if request.command == "report":
        return _report(request)
    if request.command == "list":
        _print(_listing(request.form))
    elif request.command == "show":
        _print(_method(request.options["method"], request.form))
    elif request.command == "published":
        _print(_published(request))
    elif request.command == "solvers":
        return _solvers(request)
    else:
        _print(_shown(request, _study, "compare.show.study", "compare.show.plot"))
    return 0


def _shown(
    request: Request,
    run_study: Callable[..., Any],
    table: str,
    plot: str,
    judged: Callable[[Page], Page] = lambda page: page,
) -> str:
    """Run a study, write what is to be written, and return the tables, by the modules of its tables and its plots.

    What is returned is the page that ``judged`` makes of that of the tables.
    """
    from compare.show import render

    out = _out(request)
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
    return render.render(judged(page), request.form, width)


def _out(request: Request) -> str | None:
    """The folder that is written, if one is."""
    if request.out is None and request.plots:
        return DEFAULT_FOLDER.format(problem=request.command)
    return request.out


class _Gated:
    """An answer that is held against a baseline, where one is given.

    Attributes:
        baseline: the earlier answer, or None.
        code: 1 where this one is worse.
    """

    def __init__(self, request: Request, gate: Gate) -> None:
        from compare.baseline import opened

        self._request = request
        self.baseline: Baseline | None = None
        if request.baseline is not None:
            self.baseline = opened(request.baseline, gate, request.margin, _out(request))
        self.code = 0

    def judged(self, page: Page) -> Page:
        """The page with what is worse and better at its end."""
        from compare.baseline import document_of, with_comparison

        if self.baseline is None:
            return page
        found = self.baseline.against(document_of(page))
        self.code = 0 if found.holds else 1
        _tell_changes(self._request, found)
        return with_comparison(page, found)


def _tell_changes(request: Request, found: Comparison) -> None:
    """Say on stderr what is worse and better, where the form of the answer is not for readers."""
    if request.form not in READABLE:
        told = [f"worse: {one}" for one in found.worse] if request.quiet else found.lines
        print(*told, sep="\n", end="\n" if told else "", file=sys.stderr)


def _check(request: Request) -> int:
    """Check an integrator in a process of its own; what it prints goes to stderr: stdout has the answer alone."""
    from compare.claims.contained import contained

    if request.baseline is not None:
        return _check_against(request.baseline, request)
    found = contained(request.options, request.form)
    _print(found.text)
    return found.code


def _check_against(file: str, request: Request) -> int:
    """Check an integrator, and hold what is found against the baseline in a file."""
    from compare.baseline import noted, opened
    from compare.claims.contained import contained
    from compare.claims.exchange import WRITERS
    from compare.claims.regression import GATE, exit_code
    from compare.show.page import in_lines
    from compare.show.render import json_text, written

    baseline = opened(file, GATE)
    found = contained(request.options, request.form)
    changes = baseline.against(found.document)
    _tell_changes(request, changes)
    text = found.text
    if request.form == "json":
        text = json_text(noted(in_lines(found.document), changes))
    elif request.form == "text":
        text += "\n" + written(changes.table, "text")
    elif request.form in WRITERS:
        text = WRITERS[request.form](found.document, found.place, changes)
    _print(text)
    return exit_code(found.document, changes)


def _errata(request: Request) -> int:
    """Print the errata, their checks run now; one that is not confirmed is a failure."""
    from compare.show import render
    from compare.sources.errata import entries, show

    found = show.records(entries.ENTRIES)
    _print(render.render(show.page(found), request.form, _width()))
    return 0 if all(record["confirmed"] for record in found) else 1


def _score(request: Request) -> int:
    """Judge a file, print what is found, as CSV while it is found; where limits do not hold that is a failure."""
    from compare.files import html_page, regression, show
    from compare.files.limits import NONE
    from compare.files.score import Submission, judged, problem_of
    from compare.show.render import render

    gated, asked = _Gated(request, regression.GATE), Submission(**request.options)
    with _progress(request.quiet) as progress:
        score = judged(asked, _print, progress)
    page = gated.judged(show.page(score, asked.limits))
    if request.form == "html":
        _print(html_page.page(score, html_page.exact_states(problem_of(asked), score), asked.file, asked.limits))
    elif request.form != "csv":
        _print(render(page, request.form))
    if asked.limits == NONE or asked.limits.holds(score):
        return gated.code
    if request.form not in READABLE:
        print(asked.limits.sentence(score), file=sys.stderr)
    return 1


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
    from compare.solvers import regression

    gated = _Gated(request, regression.SEVERAL if "several" in request.options else regression.GATE)
    studies: list[SolverStudy] = []

    def kept(request: Request, progress: Callable[[str], None] | None) -> SolverStudy | list[SolverStudy]:
        studies.extend(_solver_studies(request, progress))
        return studies if "several" in request.options else studies[0]

    table = "compare.solvers.several" if "several" in request.options else "compare.solvers.table"
    _print(_shown(request, kept, table, "compare.solvers.plot", gated.judged))
    if any(study.scored for study in studies):
        return gated.code
    print("error: none of these solvers could be scored; the tables say why.", file=sys.stderr)
    return 1


def _solver_studies(request: Request, progress: Callable[[str], None] | None) -> list[SolverStudy]:
    """The studies, on a process pool where there is a core for it; a pool begins when the first task comes to it."""
    from compare.solvers import several
    from reference.command.executors import other_cores, processes

    others = other_cores()
    with processes(others) if others else contextlib.nullcontext() as executor:
        return several.studies(request.options.get("several", [request.options]), progress, executor)


def _report(request: Request) -> int:
    """Write a report, or go on with one that was interrupted, and print its tables."""
    from compare.report import regression, table
    from compare.report.run import plan, run
    from compare.show import render
    from compare.show.page import plain
    from reference.command.terminal import progress_bar

    gated = _Gated(request, regression.GATE)
    wanted, out = plan(**request.options["plan"]), request.out or ""
    if gated.baseline is not None:
        gated.baseline.refuse_another(plain(wanted.parameters))
    with progress_bar("measuring", quiet=request.quiet) as progress:
        found = run(wanted, out, jobs=request.options["jobs"], executor=request.options["executor"], progress=progress)
    if not request.quiet:
        print(f"wrote report.md and what goes with it into {out}", file=sys.stderr)
    _print(render.render(gated.judged(table.page(found)), request.form, _width()))
    return gated.code


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
