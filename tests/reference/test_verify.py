"""Verifying: the proofs hold for a sound file and fail for one wrong bit that every checksum agrees with."""

from __future__ import annotations

import shutil

import h5py
import numpy as np
import pytest
from forgery import marked

from reference.dataset.build import build
from reference.dataset.errors import DatasetError
from reference.dataset.plan import Plan
from reference.dataset.reader import load
from reference.dataset.schema import exact_texts
from reference.dataset.verify import differs, verify
from reference.layout import Group
from reference.problems.pendulum import family as groups
from reference.routes.agreement import DisagreementError

TINY = Plan(
    "core",
    (Group(groups.DIMENSIONLESS, groups.UNIT, {"amplitude": [0.5, 2.0], "time": np.arange(3) / 4}),),
)

EVENTS = Plan(
    "core",
    (Group(groups.LIBRATION, groups.EARTH, {"amplitude": [0.5], "time": [0.0], "event": [0, 1]}),),
)


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    path = tmp_path_factory.mktemp("sound") / "tiny.h5"
    build(TINY, path)
    return path


@pytest.fixture
def built(sound, tmp_path):
    """A copy of the file and its checksum, to forge at will."""
    for name in (sound.name, "SHA256SUMS"):
        shutil.copy(sound.parent / name, tmp_path / name)
    return tmp_path / sound.name


def say(target, name, value):
    """Give an attribute another value, of the type that the schema has for it."""
    if isinstance(value, str):
        target.attrs.create(name, value.encode(), dtype=h5py.string_dtype("utf-8", len(value)))
    else:
        target.attrs.create(name, np.array(value, dtype="<f8" if isinstance(value, float) else "<i4"))


def forge(path, change):
    """Change a file and put every checksum and every spelling of an input right again, as a forger would."""
    with h5py.File(path, "r+", libver=("v110", "v110")) as file:
        change(file)
        for axis in (file["pendulum/dimensionless/amplitude"], file["pendulum/dimensionless/time"]):
            for name, text in exact_texts(axis[...].tolist()).items():
                say(axis, name, text)
        marked(file, signed_zeros=True)
    (path.parent / "SHA256SUMS").unlink()


def test_a_sound_file_is_proven_variable_by_variable(built):
    proofs = verify(built)
    assert [proof.name for proof in proofs] == [
        f"pendulum/dimensionless/{name}" for name in ("theta", "omega", "period")
    ]
    assert [proof.elements for proof in proofs] == [6, 6, 2]
    assert all(proof.holds for proof in proofs)
    assert all(min(proof.digits[route] for route in ("taylor", "quadrature")) >= 45 for proof in proofs)
    assert str(proofs[0]).startswith("proven  pendulum/dimensionless/theta: 6 elements")


@pytest.mark.parametrize(("name", "limb"), [("omega", None), ("omega_tail", 0), ("omega_tail", 1)])
def test_one_unit_in_the_last_place_of_any_limb_is_found(built, name, limb):
    def change(file):
        data = file[f"pendulum/dimensionless/{name}"]
        at = (1, 2) if limb is None else (1, 2, limb)
        data[at] = np.nextafter(data[at], np.inf)

    forge(built, change)
    theta, omega, period = verify(built, jobs=1)
    assert (theta.holds, omega.holds, period.holds) == (True, False, True)
    assert omega.wrong == 1
    assert "(1, 2)" in omega.first
    assert str(omega).startswith("FAILED")


def test_another_input_fails_the_values_that_belong_to_it(built):
    def change(file):
        file["pendulum/dimensionless/amplitude"][0] = np.nextafter(0.5, 1)

    forge(built, change)
    assert [proof.wrong for proof in verify(built)] == [3, 2, 1]


def test_an_input_that_is_no_problem_is_refused(built):
    def change(file):
        file["pendulum/dimensionless/amplitude"][0] = 4.0

    forge(built, change)
    with pytest.raises(DatasetError, match=r"element 0 is no problem: theta0 is 4\.0"):
        verify(built)


def test_a_route_that_disagrees_fails_its_variables(built, monkeypatch):
    from reference.dataset import verify as verifying

    def disagree(block, route):
        raise DisagreementError(f"{block.row.name} differs by {route}.")

    monkeypatch.setattr(verifying, "compare", disagree)
    assert [proof.first for proof in verify(built)] == [
        "state differs by taylor.",
        "state differs by taylor.",
        "period differs by taylor.",
    ]


@pytest.mark.parametrize(("place", "found_by"), [(-1, "verify"), (-5, "load"), (3, "load")])
def test_a_wrong_digit_of_a_published_decimal_is_found(built, place, found_by):
    """The limbs carry 48 digits: what they cannot see is proven again."""

    def change(file):
        period = file["pendulum/dimensionless/period"]
        text = period.attrs["decimal"].decode()
        at = len(text) + place if place < 0 else place
        say(period, "decimal", text[:at] + str((int(text[at]) + 1) % 10) + text[at + 1 :])

    forge(built, change)
    if found_by == "load":
        with pytest.raises(DatasetError, match=r"'decimal' says (6\.3|8\.3)\d+ of element [01], which is stored as"):
            verify(built)
        return
    period = verify(built)[2]
    assert not period.holds
    assert period.wrong == 0
    assert "'decimal' says 8.3497" in period.first
    assert "of element 1, which is proven to be 8.3497" in period.first


def test_an_argument_that_a_row_does_not_take_is_refused(tmp_path):
    path = tmp_path / "events.h5"
    build(EVENTS, path)

    def change(file):
        file["pendulum/libration/event"][1] = -3
        marked(file, signed_zeros=False)

    with h5py.File(path, "r+", libver=("v110", "v110")) as file:
        change(file)
    (path.parent / "SHA256SUMS").unlink()
    with pytest.raises(DatasetError, match=r"at element 0 has no zero_crossing: index is -3; an integer from 0"):
        verify(path)


@pytest.mark.parametrize(
    ("variable", "name", "value"),
    [
        ("period", "decimal", "6.38279"),
        ("period", "decimal", "6.38279 8.3497"),
        ("period", "decimal", "1e999999999 8.3497"),
        ("period", "decimal", None),
        ("theta", "decimal", "0.5 2.0"),
        ("theta_tail", "decimal", "0.5 2.0"),
        ("theta", "taylor_digits", 44.9),
        ("theta", "taylor_digits", 999.0),
        ("theta", "taylor_digits", float("nan")),
        ("theta", "taylor_digits", float("inf")),
        ("theta", "taylor_digits", 60),
        ("theta", "taylor_digits", None),
        ("theta", "taylor_reason", "the taylor route does not reach these arguments"),
        ("theta", "quadrature_checked_elements", 0),
        ("theta", "quadrature_checked_elements", 7),
        ("theta", "quadrature_checked_elements", -1),
        ("theta", "quadrature_checked_elements", None),
        ("theta", "checked_elements", 5),
    ],
)
def test_what_the_file_says_of_its_proofs_must_be_possible(built, variable, name, value):
    def change(file):
        target = file[f"pendulum/dimensionless/{variable}"]
        if value is None:
            del target.attrs[name]
        else:
            say(target, name, value)

    forge(built, change)
    with pytest.raises(DatasetError, match=rf"pendulum/dimensionless/{variable} .*'{name.partition('_')[0]}"):
        load(built)


@pytest.mark.parametrize(("name", "at"), [("omega", (0, 0)), ("omega_tail", (0, 0, 1)), ("time", (0,))])
def test_a_zero_has_no_sign_in_the_newest_schema(built, name, at):
    """At t = 0 the angular velocity is exactly 0."""

    def change(file):
        assert file[f"pendulum/dimensionless/{name}"][at] == 0
        file[f"pendulum/dimensionless/{name}"][at] = -0.0

    forge(built, change)
    for use in (load, verify):
        with pytest.raises(DatasetError, match=rf"dimensionless/{name} has an element -0\.0; zero has no sign there"):
            use(built)


def test_proving_compares_every_bit_but_for_zeros_signs_that_older_files_may_have():
    stored, proven = np.array([0.0, -0.0, 1.0, 2.0]), np.array([-0.0, -0.0, 1.0, np.nextafter(2.0, 3.0)])
    assert differs(stored, proven, signed_zeros=False).tolist() == [True, False, False, True]
    assert differs(stored, proven, signed_zeros=True).tolist() == [False, False, False, True]


def test_a_route_that_is_said_not_to_serve_must_not_serve(built):
    def change(file):
        target = file["pendulum/dimensionless/theta"]
        del target.attrs["taylor_digits"]
        say(target, "taylor_checked_elements", 0)
        say(target, "taylor_reason", "the taylor route does not reach these arguments")

    forge(built, change)
    assert [proof.holds for proof in verify(built)] == [False, True, True]
