"""The core dataset against a second computation of each of its variables, at three times the precision."""

import random

import pytest
from recomputed import RECOMPUTED
from sampled import elements, misrounded

import reference
from reference.dataset.catalogue import LAYOUTS


@pytest.fixture(scope="module")
def core():
    return reference.load()


def test_every_group_of_the_core_dataset_is_computed_again(core):
    assert set(core.groups) == set(RECOMPUTED) == {layout.path.strip("/") for layout in LAYOUTS}


@pytest.mark.parametrize("group", sorted(RECOMPUTED))
def test_random_elements_of_every_variable_are_the_one_correct_rounding(core, group):
    chosen = [found for found in elements(core, 4, random.Random(group)) if found[0].name.startswith(f"{group}/")]
    names = {variable.name for variable, _ in chosen}
    assert names == {name for name in core if name.startswith(f"{group}/") and not core[name].is_input}
    assert [fault for fault in (misrounded(core, *found) for found in chosen) if fault] == []


def test_a_limb_that_is_off_by_one_place_is_found(core):
    class Forged:
        name, dims = "pendulum/libration/period", core["pendulum/libration/period"].dims
        value, tail = core[name].value, core[name].tail.copy()

    Forged.tail[3, 1] *= 1 + 2**-52
    assert misrounded(core, core["pendulum/libration/period"], (3,)) == ""
    assert "pendulum/libration/period[3] is stored as" in misrounded(core, Forged, (3,))
