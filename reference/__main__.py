"""``python -m reference``: build, verify, show, at, cite, datasheet."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reference.command.terminal import Parser, one_of, progress_bar, run
from reference.named import is_own, with_equations
from reference.names import short

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.dataset.plan import Plan

FORMATS = ("text", "json")
CITATIONS = ("bibtex", "text")
GIVEN = "given_"
"""Before the names of a family's inputs, which are its own to choose."""


def command(arguments: Sequence[str] | None = None) -> int:
    """Parse the arguments, run the command they name, return its exit code."""
    words = with_equations(sys.argv[1:] if arguments is None else arguments)
    asked = _parser(words).parse_args(words)
    return int(asked.run(asked))


def main(arguments: Sequence[str] | None = None) -> int:
    """The command line; exit code 0, 1 where a proof failed, 2 where the user must change something."""
    return run(command, arguments)


def _parser(words: Sequence[str]) -> Parser:
    parser = Parser(prog="python -m reference", description="Reference values, proven correctly rounded.")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True, parser_class=Parser)
    build = commands.add_parser("build", help="prove the values of a profile and write them as a dataset")
    build.add_argument("--out", metavar="FILE", help="the file to write (default: the core dataset's place)")
    numbers = build.add_mutually_exclusive_group()
    numbers.add_argument("--profile", default="core", help="core or full")
    numbers.add_argument("--config", metavar="FILE.toml", help="groups, parameters and numbers of your own")
    _add_families(build, "the groups of this family alone, or in FILE.toml also its groups")
    _add_workers(build)
    build.set_defaults(run=_build)
    verify = commands.add_parser("verify", help="check a dataset and prove its values again")
    verify.add_argument("file", metavar="FILE")
    _add_families(verify)
    _add_workers(verify)
    verify.set_defaults(run=_verify)
    show = commands.add_parser("show", help="print a dataset's tree, or one variable with its values")
    show.add_argument("file", metavar="FILE")
    show.add_argument("path", metavar="PATH", nargs="?", help="a group or variable, such as pendulum/libration/period")
    show.add_argument("--format", type=one_of("format", FORMATS), default="text", help="text or json")
    _add_families(show)
    show.set_defaults(run=_show)
    _add_at(commands, words)
    cite = commands.add_parser("cite", help="print how to cite the dataset, with version and fingerprint")
    cite.add_argument("file", metavar="FILE", nargs="?", help="default: the core dataset")
    cite.add_argument("--format", type=one_of("format", CITATIONS), default="bibtex", help="bibtex or text")
    _add_families(cite)
    cite.set_defaults(run=_cite)
    datasheet = commands.add_parser("datasheet", help="print the datasheet of a dataset, in Markdown")
    datasheet.add_argument("file", metavar="FILE", nargs="?", help="default: the core dataset")
    datasheet.add_argument("group", metavar="GROUP", nargs="?", help="one group's page, such as pendulum/libration")
    _add_families(datasheet)
    datasheet.set_defaults(run=_datasheet)
    return parser


def _jobs(text: str) -> int:
    if not (text.isascii() and text.isdigit() and 1 <= int(text) <= 4096):
        raise argparse.ArgumentTypeError(f"jobs is '{short(text)}'; an integer from 1 to 4096 is accepted.")
    return int(text)


def _add_workers(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--jobs", type=_jobs, default=os.cpu_count() or 1, metavar="N", help="processes (default: all)")
    parser.add_argument("--executor", default="process", metavar="NAME", help="process, dask:ADDRESS or mpi")
    parser.add_argument("--quiet", action="store_true", help="no progress bar, no summary")


def _add_families(parser: argparse.ArgumentParser, told: str = "a family of your own that it has groups of") -> None:
    where = "MODULE:NAME or FILE.py:NAME; may repeat"
    parser.add_argument("--family", action="append", default=[], metavar="NAME", help=f"{told}: {where}")


def _add_at(commands: argparse._SubParsersAction[Parser], words: Sequence[str]) -> None:
    from reference.command.at import METAVARS
    from reference.problems.families import FAMILIES, find_family

    own = next((word for word in words[1:2] if words[0] == "at" and is_own(word)), None)
    known = {family.name: family for family in FAMILIES} if own is None else {own: find_family(own)}
    told = "print proven values at one time, now"
    flows = [name for name, family in known.items() if not family.has_closed_form]
    described = f"{told}: of a family, or of a flow: {', '.join(flows)}, or flow --config FILE.toml"
    at = commands.add_parser("at", help=told, description=described)
    families = at.add_subparsers(dest="family", metavar="FAMILY", required=True, parser_class=Parser)
    for name, family in known.items():
        listed: dict[str, Any] = {"help": family.help} if family.has_closed_form else {}
        parser = families.add_parser(name, **listed, description=family.help)
        if name not in words[1:2]:
            continue
        for asked in family.inputs:
            default = "" if asked.default is None else f" (default: {asked.default})"
            units = f", in {asked.units}" if asked.units not in {"", "1"} else ""
            parser.add_argument(
                f"--{asked.name}",
                dest=GIVEN + asked.name,
                required=asked.default is None and not asked.optional,
                default=asked.default,
                metavar=METAVARS[asked.kind],
                help=f"{asked.help}{units}{default}".replace("%", "%%"),
            )
        parser.add_argument("--digits", default="50", metavar="N", help="significant digits (default: 50)")
        parser.add_argument("--exact", action="store_true", help="take decimals and fractions as written")
        parser.add_argument("--routes", action="store_true", help="hold the other routes against each value")
        parser.add_argument("--format", type=one_of("format", FORMATS), default="text", help="text or json")
        parser.set_defaults(run=_at, known_as=family)


def _at(asked: argparse.Namespace) -> int:
    from reference.command import at

    family = asked.known_as
    digits = at.digits_count(asked.digits)
    given = {wanted: getattr(asked, GIVEN + wanted.name) for wanted in family.inputs}
    inputs = {
        wanted.name: at.read(wanted, text, as_written=asked.exact) for wanted, text in given.items() if text is not None
    }
    found = at.quantities(family, inputs)
    if asked.format == "json":
        print(at.as_json(found, digits, routes=asked.routes))
    else:
        print(at.as_text(family, inputs, found, digits, routes=asked.routes))
    return 0


def _build(asked: argparse.Namespace) -> int:
    from reference.dataset.build import build
    from reference.dataset.catalogue import plan
    from reference.dataset.grids import plan_from

    wanted = plan(asked.profile, asked.family) if asked.config is None else plan_from(asked.config, asked.family)
    out = _default_out(wanted) if asked.out is None else asked.out
    if asked.config is not None and os.path.realpath(asked.config) == os.path.realpath(out):
        raise ValueError(f"the output '{out}' is the grid file itself; choose another output path.")
    with progress_bar("proving", quiet=asked.quiet) as progress:
        fingerprint = build(wanted, out, jobs=asked.jobs, executor=asked.executor, progress=progress)
    if not asked.quiet:
        print(f"{out}: {Path(out).stat().st_size} bytes, fingerprint sha256:{fingerprint}")
    return 0


def _default_out(plan: Plan) -> Path:
    """The place of the shipped file for the core profile in a checkout, else the working folder."""
    from reference.dataset.reader import core_path

    checkout = Path(__file__).resolve().parents[1]
    if (
        plan.profile == "core"
        and not plan.families
        and (checkout / "pyproject.toml").exists()
        and (checkout / "data").is_dir()
    ):
        return core_path()
    own = () if plan.profile.endswith(".toml") else plan.families
    families = "".join(f"-{family.rpartition(':')[2].lower()}" for family in own)
    return Path(f"horologium-{plan.profile.removesuffix('.toml')}{families}.h5")


def _verify(asked: argparse.Namespace) -> int:
    from reference.dataset.verify import verify

    with progress_bar("proving again", quiet=asked.quiet) as progress:
        proofs = verify(asked.file, families=asked.family, jobs=asked.jobs, executor=asked.executor, progress=progress)
    for proof in proofs:
        if not (asked.quiet and proof.holds):
            print(proof)
    failed = sum(not proof.holds for proof in proofs)
    if not asked.quiet:
        print(f"{len(proofs) - failed} of {len(proofs)} variables proven.")
    return 1 if failed else 0


def _show(asked: argparse.Namespace) -> int:
    from reference.dataset.reader import load
    from reference.dataset.show import show

    for line in show(load(asked.file, asked.family), asked.path, asked.format):
        print(line)
    return 0


def _cite(asked: argparse.Namespace) -> int:
    from reference.dataset.cite import cite
    from reference.dataset.reader import load

    print(cite(load(asked.file, asked.family), asked.format))
    return 0


def _datasheet(asked: argparse.Namespace) -> int:
    from reference.dataset.datasheet import datasheet
    from reference.dataset.reader import load

    print(datasheet(load(asked.file, asked.family), asked.group), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
