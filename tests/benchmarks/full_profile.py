"""How long the full profile takes to prove: one block of each row, of the middle problem, times the number of blocks.

    python tests/benchmarks/full_profile.py [GROUP ...]   (default all groups)

Processor time is counted, so that other work on the machine matters little; what is compiled is counted each time.
"""

from __future__ import annotations

import os
import sys
import time
from typing import TYPE_CHECKING

from reference.dataset.blocks import compute
from reference.dataset.catalogue import plan

if TYPE_CHECKING:
    from reference.layout import Group


def seconds(group: Group, row: str) -> float:
    """Processor seconds for the first block of a row of the middle problem."""
    blocks = [block for block in group.blocks() if block.row.name == row and block.start == 0]
    compute(blocks[0]) if len(blocks[0].values) < 2 else None
    start = time.process_time()
    compute(blocks[len(blocks) // 2])
    return time.process_time() - start


def main(paths: list[str]) -> None:
    """Print the estimate of each row, and of all."""
    total = 0.0
    for group in plan("full").groups:
        if paths and group.layout.path not in paths:
            continue
        for row in group.layout.rows:
            count = sum(1 for block in group.blocks() if block.row.name == row.name)
            each = seconds(group, row.name)
            total += count * each
            print(f"{group.layout.path} {row.name}: {count} blocks of {each:.2f} s", flush=True)
    cores = os.cpu_count() or 1
    print(f"{total:.0f} s of one processor, {total / 3600 / cores:.2f} h of {cores}")


if __name__ == "__main__":
    main(sys.argv[1:])
