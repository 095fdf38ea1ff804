"""The core dataset against a second computation of each of its variables, at three times the precision."""

import random
from fractions import Fraction

import pytest
from independent import correct_limbs
from recomputed import RECOMPUTED
from sampled import BITS, GUARD_BITS, elements, misrounded

from reference.dataset.catalogue import LAYOUTS, plan
from reference.routes.flow import Flow


def test_every_group_of_the_core_dataset_is_computed_again(core):
    known = {group.layout.path.strip("/") for group in plan().groups}
    assert set(core.groups) == known
    assert set(RECOMPUTED) | {name for name in known if name.startswith("flow/")} == known


@pytest.mark.parametrize("name", ["detest_a5", "detest_e5", "duffing", "henon_heiles", "lotka_volterra"])
def test_random_states_of_flows_are_those_of_heyoka_at_three_times_the_precision(core, name):
    layout = next(layout for layout in LAYOUTS if layout.path == f"/flow/{name}")
    problem, rng = layout.problem(), random.Random(name)
    times = core[f"flow/{name}/time"].value.tolist()
    places = sorted(rng.sample(range(len(times) // 4), 6))
    states = Flow(problem, BITS + GUARD_BITS).at([Fraction(times[place]) for place in places])
    for place, state in zip(places, states, strict=True):
        for component, value in zip(problem.state_names, state, strict=True):
            variable = core[f"flow/{name}/{component}"]
            stored = [variable.value[place].item(), *variable.tail[place].tolist()]
            near = abs(value - sum(map(Fraction, stored))) <= Fraction(2) ** -BITS
            assert correct_limbs(value, 3) == stored or near, f"{component} at {times[place]}"


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
