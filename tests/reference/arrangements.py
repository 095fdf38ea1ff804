"""A program that builds a tiny dataset beside what is not ours, or dies in the middle of it, and tells of it.

``python arrangements.py FOLDER around SEED COUNT``: COUNT times random files, folders, links and locks stand around
the output; nothing of it may change, and a build that is refused changes nothing at all.
``python arrangements.py FOLDER killed FIRST STEP``: the process ends at its FIRST call of the system that changes
something, and every STEP calls after; there is the old file or the new one, and the next build finishes the work.

It prints a JSON object with counts and with the faults in words.  As root it first shuts itself up in FOLDER (chroot)
and becomes nobody.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import itertools
import json
import os
import random
import shutil
import stat
import sys
from pathlib import Path

import reference
from reference.command.marked import LOCK
from reference.command.terminal import run
from reference.dataset import build as building
from reference.dataset.blocks import compute, partial, place_of
from reference.dataset.build import build
from reference.dataset.plan import Plan
from reference.layout import Group
from reference.problems.pendulum import family as groups

PLAN = Plan("core", (Group(groups.DIMENSIONLESS, groups.UNIT, {"amplitude": [0.5], "time": [0.0, 0.25]}),))
OTHER = Plan("core", (Group(groups.DIMENSIONLESS, groups.UNIT, {"amplitude": [0.25], "time": [0.0]}),))
NAMES = ("x.h5", "x[1]*.h5", "a b?.h5", "-x.h5")
NOBODY = 65534
PROVEN = {}
CHANGING = ("open", "unlink", "rename", "replace", "mkdir", "rmdir", "write", "pwrite", "fsync", "link")


def proven(block):
    """What a block comes to, the same object each time."""
    key = f"{block.key} {block.inputs}"
    if key not in PROVEN:
        PROVEN[key] = compute(block)
    return PROVEN[key]


def prepared(folder):
    """Have everything imported and every block proven, and be shut up in the folder as nobody where this is root."""
    for block in (*PLAN.blocks(), *OTHER.blocks()):
        proven(block)
    building.compute_all = lambda blocks: list(map(proven, blocks))
    versions = {tool: building.installed(tool) for tool in building.TOOLS}
    building.installed = versions.__getitem__
    made_in(folder)  # has everything imported
    if os.geteuid() == 0:
        os.chown(folder, NOBODY, NOBODY)
        os.chroot(folder)
        os.chdir("/")
        os.setgroups([])
        os.setgid(NOBODY)
        os.setuid(NOBODY)
        folder = Path("/")
    return folder, made_in(folder)


def made_in(folder):
    """The bytes of the dataset that a build makes there."""
    out = folder / "new.h5"
    build(PLAN, out)
    found = out.read_bytes()
    for path in list(folder.iterdir()):
        path.unlink()
    return found


def snapshot(folder):
    """Everything in a folder as it stands, no link followed."""
    found = {}
    for root, folders, files in os.walk(folder):
        for path in (Path(root, name) for name in (*folders, *files)):
            status = path.lstat()
            kind = stat.S_IFMT(status.st_mode)
            content = None
            if kind == stat.S_IFLNK:
                content = str(path.readlink())
            elif kind == stat.S_IFREG:
                content = path.read_bytes()
            found[str(path.relative_to(folder))] = (kind, status.st_mode, content)
    return found


def built(out):
    """Exit code and stderr of a build in a process of its own."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reading)
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            code = run(lambda _: build(PLAN, out) and 0)
        os.write(writing, said.getvalue().encode())
        os._exit(code)
    os.close(writing)
    with os.fdopen(reading, "rb") as stream:
        said = stream.read().decode()
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), said


def interrupted(target, plan, count):
    """Leave the first blocks of a plan as an interrupted build leaves them."""
    with contextlib.suppress(KeyboardInterrupt), partial(target, plan.identity(reference.__version__)) as finished:
        for block in itertools.islice(plan.blocks(), count):
            finished.put(block.key, proven(block).dumped())
        raise KeyboardInterrupt


def their_folder(path):
    """A folder of the user's, with names in it such as we give."""
    (path / ("a" * 64) / "deep").mkdir(parents=True)
    (path / ("a" * 64) / ("b" * 32 + ".block")).write_text("theirs")
    (path / "notes.txt").write_text("theirs")
    return path


def unfinished(home, plan, count):
    interrupted(home.with_name(home.name.removesuffix(".partial")), plan, count)


IN_PLACE = {
    "nothing": lambda _home, _theirs: None,
    "unfinished": lambda home, _: unfinished(home, PLAN, 1),
    "unfinished of another plan": lambda home, _: unfinished(home, OTHER, 2),
    "a link to a folder": lambda home, theirs: home.symlink_to(theirs, target_is_directory=True),
    "a link to unfinished work": lambda home, theirs: (
        unfinished(theirs / "y.partial", PLAN, 1),
        home.symlink_to(theirs / "y.partial"),
    ),
    "a link to a file": lambda home, theirs: home.symlink_to(theirs / "notes.txt"),
    "a link to nothing": lambda home, _: home.symlink_to("nowhere"),
    "a folder": lambda home, _: their_folder(home),
    "an empty folder": lambda home, _: home.mkdir(),
    "a file": lambda home, _: home.write_text("theirs"),
    "a pipe": lambda home, _: os.mkfifo(home),
}
"""What stands in the place of the work folder, made from its path and a folder of the user's."""
PURE = ("nothing", "unfinished", "unfinished of another plan")


def relocked(home, put):
    (home / LOCK).unlink()
    put(home / LOCK)


def plan_folder(home):
    return next(path for path in sorted(home.iterdir()) if path.is_dir())


def swapped(home, to):
    """A link to a copy of the plan's folder in its place."""
    inside = plan_folder(home)
    shutil.move(inside, to / inside.name)
    inside.symlink_to(to / inside.name, target_is_directory=True)


def swapped_block(home, to):
    block = next(iter(sorted(plan_folder(home).glob("*.block"))))
    shutil.move(block, to / block.name)
    block.symlink_to(to / block.name)


SPOILT = {
    "a file in it": lambda home, _: (home / "notes.txt").write_text("theirs"),
    "a file with a name as ours in it": lambda home, _: (home / ("c" * 32 + ".block")).write_text("theirs"),
    "a folder in it": lambda home, _: their_folder(home / "mine"),
    "a file in a plan's folder": lambda home, _: (plan_folder(home) / "notes.block").write_text("theirs"),
    "a folder in a plan's folder": lambda home, _: (plan_folder(home) / ("d" * 32 + ".block")).mkdir(),
    "a plan's folder that is a link": swapped,
    "another plan's folder that is a link": lambda home, theirs: (home / ("e" * 64)).symlink_to(theirs),
    "a block that is a link": swapped_block,
    "a half-written block that is a link": lambda home, theirs: (plan_folder(home) / ("f" * 32 + ".tmp")).symlink_to(
        theirs / "notes.txt"
    ),
    "no lock": lambda home, _: (home / LOCK).unlink(),
    "an empty lock": lambda home, _: relocked(home, lambda lock: lock.touch()),
    "a lock of theirs": lambda home, _: relocked(home, lambda lock: lock.write_text("theirs")),
    "a lock that is a link": lambda home, theirs: (
        shutil.move(home / LOCK, theirs / LOCK),
        (home / LOCK).symlink_to(theirs / LOCK),
    ),
    "a lock that is a folder": lambda home, _: relocked(home, lambda lock: lock.mkdir()),
    "a lock that is a pipe": lambda home, _: relocked(home, os.mkfifo),
}
"""What is wrong with the folder of an interrupted build."""
OUTPUTS = {
    "nothing": lambda _out, _theirs: None,
    "a file": lambda out, _: out.write_text("old"),
    "a link to a file": lambda out, theirs: out.symlink_to(theirs / "notes.txt"),
    "a link to nothing": lambda out, theirs: out.symlink_to(theirs / "new.h5"),
}
LISTS = {
    "nothing": lambda _listing, _theirs, _name: None,
    "lines": lambda listing, _, name: listing.write_bytes(
        b"# mine\r\n" + b"A" * 64 + b" *\xff.bin\n\n" + f"{'0' * 64}  {name}\n{'1' * 64}  z.h5".encode()
    ),
    "a line of no checksum": lambda listing, _, name: listing.write_text(f"{'0' * 64}  {name}\nSHA256 (y) = 1\n"),
    "a link": lambda listing, theirs, _: listing.symlink_to(theirs / "notes.txt"),
    "a folder": lambda listing, _, _name: listing.mkdir(),
    "a pipe": lambda listing, _, _name: os.mkfifo(listing),
}
WRITABLE = ("nothing", "lines")


def beside(folder, target, theirs, rng):
    """Things such as killed runs leave beside an output, of ours and not; the paths of those of ours."""
    own = temporary_name(target)
    (folder / f".{target.name}.abcdefgh.tmp").write_text("theirs")
    (folder / ".xyz.h5.abcdefgh.tmp").write_text("theirs")
    (folder / f"{own}.bak").write_text("theirs")
    (folder / ".horologium-01234567").mkdir()
    (folder / ".horologium-89abcdef").symlink_to(theirs, target_is_directory=True)
    kind = rng.choice(("left", "link", "folder", "none"))
    if kind == "left":
        (folder / own).write_text("ours")
        return {own}
    if kind == "link":
        (folder / own).symlink_to(theirs / "notes.txt")
    if kind == "folder":
        (folder / own).mkdir()
    return set()


def temporary_name(target):
    return f".horologium-{hashlib.sha256(target.name.encode()).hexdigest()[:8]}-abcdefg_.tmp"


def around(folder, seed, count):
    """Build beside random things; how often it was refused and done, and the faults."""
    rng, told = random.Random(seed), {"arrangements": 0, "refused": 0, "built": 0, "faults": []}
    for number in range(count):
        scratch = folder / f"{number}"
        theirs = their_folder(scratch / "theirs")
        out = scratch / rng.choice(NAMES)
        how = {"output": rng.choice(list(OUTPUTS)), "place": rng.choice([*IN_PLACE, *PURE * 4]), "spoilt": ""}
        how["list"] = rng.choice([*LISTS, *WRITABLE * 3])
        OUTPUTS[how["output"]](out, theirs)
        target = Path(os.path.realpath(out))
        home = place_of(target)
        IN_PLACE[how["place"]](home, theirs)
        if how["place"].startswith("unfinished") and rng.random() < 0.5:
            how["spoilt"] = rng.choice(list(SPOILT))
            SPOILT[how["spoilt"]](home, theirs)
        ours = beside(target.parent, target, theirs, rng)
        LISTS[how["list"]](target.parent / "SHA256SUMS", theirs, target.name)
        before = snapshot(scratch)
        code, said = built(out)
        wanted = 0 if how["place"] in PURE and not how["spoilt"] and how["list"] in WRITABLE else 2
        faults = list(changes(scratch, before, snapshot(scratch), target, ours, built_it=code == 0))
        if code != wanted:
            faults.append(f"exit code {code}")
        if wanted == 2 and (said.count("\n") != 1 or not said.startswith("error: ") or not said.endswith(".\n")):
            faults.append(f"no sentence: {said!r}")
        told["arrangements"] += 1
        told["refused" if code else "built"] += 1
        told["faults"] += [f"{seed}/{number} {how}: {fault} ({said.strip()})" for fault in faults]
        shutil.rmtree(scratch)
    return told


def changes(scratch, before, after, target, ours, *, built_it):
    """What changed that should not have."""
    name, home, listing = (
        str(path.relative_to(scratch)) for path in (target, place_of(target), target.parent / "SHA256SUMS")
    )
    mine = {name, listing} | {str((target.parent / left).relative_to(scratch)) for left in ours}
    for path in sorted(before.keys() | after.keys()):
        inside = path == home or path.startswith(home + "/")
        if before.get(path) != after.get(path) and not (built_it and (path in mine or inside)):
            yield f"{path} was {before.get(path)} and is {after.get(path)}"
    if built_it:
        if any(path == home or path.startswith(home + "/") for path in after):
            yield "the folder of the work was left"
        others = [line for line in lines(before, listing) if target.name.encode() not in line]
        if [line for line in lines(after, listing) if target.name.encode() not in line] != others:
            yield "lines of others are gone"


def lines(found, listing):
    content = found.get(listing, (0, 0, b""))[2]
    return [line for line in (content or b"").split(b"\n") if line]


def killed(folder, first, step, new):
    """Build, and end at one call of the system after another; how many calls there are, and the faults."""
    told = {"kills": 0, "calls": 0, "faults": []}
    for call in itertools.count(first, step):
        scratch = folder / f"{call}"
        scratch.mkdir()
        out = scratch / "x.h5"
        out.write_text("old")
        old = hashlib.sha256(b"old").hexdigest()
        (scratch / "SHA256SUMS").write_text(f"{'1' * 64}  a\n{old}  x.h5\n{'2' * 64}  z\n")
        code = dying(out, call)
        if code == 0:
            told["calls"] = call
            shutil.rmtree(scratch)
            return told
        told["kills"] += 1
        content, noted = out.read_bytes(), (scratch / "SHA256SUMS").read_text().splitlines()
        if content not in {b"old", new}:
            told["faults"].append(f"call {call}: neither the old file nor the new one")
        if [line[66:] for line in noted if line[66:] != "x.h5"] != ["a", "z"]:
            told["faults"].append(f"call {call}: lines of others are gone: {noted}")
        if not {line[:64] for line in noted if line[66:] == "x.h5"} <= {hashlib.sha256(content).hexdigest()}:
            told["faults"].append(f"call {call}: a wrong checksum: {noted}")
        again = built(out)
        if again != (0, "") or out.read_bytes() != new:
            told["faults"].append(f"call {call}: the next build: {again}")
        left = sorted(path.name for path in scratch.iterdir() if path.name not in {"SHA256SUMS", "x.h5"})
        if [name for name in left if not is_begun(scratch / name)]:
            told["faults"].append(f"call {call}: left behind: {left}")
        shutil.rmtree(scratch)
    raise AssertionError


def is_begun(path):
    """A hidden folder of ours into which the mark had not been written yet, which nobody can tell from another's."""
    return path.is_dir() and all(file.name == LOCK and not file.stat().st_size for file in path.iterdir())


def dying(out, call):
    """Exit code of a build that ends in the middle of everything at its n-th changing call; 0 where it has fewer."""
    child = os.fork()
    if child == 0:
        left = itertools.count(call - 1, -1)
        for name in CHANGING:
            setattr(os, name, mortal(getattr(os, name), left))
        os._exit(run(lambda _: build(PLAN, out) and 0))
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def mortal(function, left):
    def called(*args, **kwargs):
        if next(left) == 0:
            os._exit(9)
        return function(*args, **kwargs)

    return called


def main(folder, what, first, second):
    place, new = prepared(Path(folder))
    numbers = int(first), int(second)
    told = around(place, *numbers) if what == "around" else killed(place, *numbers, new)
    sys.stdout.write(json.dumps(told))


if __name__ == "__main__":
    main(*sys.argv[1:])
