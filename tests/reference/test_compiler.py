"""What is compiled for one use leaves nothing on the user's disk."""

import subprocess
import sys
from pathlib import Path

import pytest

from reference.arithmetic.compiler import hy, not_kept


def test_the_cache_is_as_it_was_after_an_error() -> None:
    kept = hy.llvm_state.get_diskcache_enabled()

    def fail() -> None:
        assert not hy.llvm_state.get_diskcache_enabled()
        raise RuntimeError

    with pytest.raises(RuntimeError), not_kept():
        fail()
    assert hy.llvm_state.get_diskcache_enabled() is kept


def test_the_taylor_route_does_not_grow_the_cache(tmp_path: Path) -> None:
    """In a cache of its own: another program may write to the user's at the same time."""
    code = (
        "from reference.arithmetic.compiler import hy; from reference import LinearPendulum; "
        "size = hy.llvm_state.get_diskcache_size; before = size(); "
        "assert LinearPendulum('0.87654321').period().routes['taylor'] >= 45; assert size() == before; "
        "hy.cfunc([hy.sin(hy.make_vars('x'))], vars=hy.make_vars('x', 'y')[:1]); assert size() > before"
    )
    environment = {"HOME": str(tmp_path), "XDG_CACHE_HOME": str(tmp_path), "PATH": "/usr/bin:/bin"}
    root = Path(__file__).parents[2]
    subprocess.run([sys.executable, "-c", code], cwd=root, env=environment, check=True)


def test_a_cache_that_cannot_be_written_is_not_spoken_of_on_stdout(tmp_path: Path) -> None:
    code = "import compare; from reference import Pendulum; compare.error_vs_n(Pendulum(1.0), methods=['rk4'], n=[128])"
    nowhere = tmp_path / "file"
    nowhere.write_text("")
    found = subprocess.run(
        [sys.executable, "-c", code],
        cwd=Path(__file__).parents[2],
        env={"HOME": str(nowhere), "XDG_CACHE_HOME": str(nowhere), "PATH": "/usr/bin:/bin"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert found.stdout == ""
