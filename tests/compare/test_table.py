"""Tables: what they say, that they fit, and that a program can read them."""

from __future__ import annotations

import csv
import dataclasses
import io
import json
import math
import pickle
import re

import pytest
from made_study import METHODS, made_case, made_study

from compare.measure.records import Defect, Growth, OwnPeriod, Phase, Study
from compare.show import render, text_table
from compare.show import study as table
from compare.show.study_page import rows
from compare.show.text_table import Column, Grid, Table

STUDY = made_study()
DEFAULT_TABLES = ("error_vs_n", "order", "energy_drift")


def shown(study: Study, form: str = "text", width: int = 100) -> str:
    """The study's page in a format."""
    return render.render(table.page(study), form, width)


def _strict_json(text: str) -> dict:
    def refuse(token: str) -> None:
        raise AssertionError(token)

    return json.loads(text, parse_constant=refuse)


@pytest.mark.parametrize("width", [80, 100, 120])
def test_text_fits_the_width_of_the_terminal(width):
    lines = shown(STUDY, "text", width).splitlines()
    titles = ("Error against", "Order,", "Energy")
    assert max(len(line) for line in lines if not line.startswith(titles)) <= width


def test_every_method_heads_two_columns_of_errors_once():
    named = {one.name: one for one in table.tables(STUDY, 100)}
    errors = named["error-vs-n-theta0-1-0-rad"]
    groups = [column.group for part in errors.grids for column in part.columns if column.group]
    assert sorted(groups) == sorted([*METHODS, *METHODS])


def test_methods_of_one_order_stand_side_by_side():
    grids = next(table.tables(STUDY, 100)).grids
    assert [dict.fromkeys(c.group for c in part.columns if c.group) for part in grids] == [
        dict.fromkeys(["euler", "symplectic_euler", "symplectic_euler_adjoint"]),
        dict.fromkeys(["midpoint", "heun", "verlet", "position_verlet", "implicit_midpoint"]),
        dict.fromkeys(["ruth3", "rk4", "yoshida4", "suzuki4"]),
    ]


def test_text_shows_three_digits_and_the_local_order():
    text = shown(made_study(methods=("verlet",)))
    cell = made_study(methods=("verlet",)).error_vs_n[1]
    assert re.search(rf"^ *256  3\.91e-02  {cell.max_error:.2e} 2\.00$", text, re.MULTILINE)


def test_a_cell_at_the_floor_is_marked_and_the_mark_explained():
    text = shown(made_study(methods=("suzuki4",)))
    assert re.search(r"^1048576 .* \*$", text, re.MULTILINE)
    assert "* means rounding" in text
    assert "*" not in shown(made_study(methods=("euler",))).partition("Error against")[2]


def test_a_method_with_too_few_cells_has_no_fitted_order():
    text = shown(made_study(methods=("suzuki4", "rk4")))
    assert re.search(r"^suzuki4 +4 +- +2  -$", text, re.MULTILINE)
    assert re.search(r"^rk4 +4  3\.9987 ± 0\.0021 +7  256 to 16384$", text, re.MULTILINE)


def test_each_amplitude_has_its_own_tables():
    text = shown(made_study(theta0=(1.0, 2.5)))
    assert text.count("Error against N, theta0 = 2.5 rad") == 1
    assert text.count("Energy drift, theta0 = 1.0 rad") == 1


def test_numbers_that_are_not_finite_print_as_words():
    row = next(line for line in shown(made_study(methods=("euler",))).splitlines() if " 7.81e-02 " in line)
    assert row.split() == ["128", "7.81e-02", "nan", "-"]


def test_the_header_says_problem_reference_and_engine():
    head = shown(STUDY).partition("Error against")[0]
    for fact in ("g = 9.81 m/s^2", "theta0 = 1.0 rad", "balls, mpmath, heyoka", "float64"):
        assert fact in head


def test_json_has_the_promised_keys_and_every_bit():
    found = _strict_json(shown(STUDY, "json"))
    assert list(found) == ["problem", "parameters", "reference", "engine", "tables"]
    assert list(found["tables"]) == ["error_vs_n", "order", "energy_drift"]
    for name in found["tables"]:
        keys = [key if key != "case" else "theta0" for key in table.COLUMNS[name]]
        records = getattr(STUDY, name)
        assert len(found["tables"][name]) == len(records)
        for row, record in zip(found["tables"][name], records, strict=True):
            assert list(row) == keys
            for key, value in row.items():
                expected = getattr(record, key)
                if isinstance(expected, float) and not math.isfinite(expected):
                    assert value is None
                else:
                    assert value == (list(expected) if isinstance(expected, tuple) else expected)


def test_programs_are_given_these_fields_of_the_records():
    where = "method n h case"
    assert {name: " ".join(fields) for name, fields in table.COLUMNS.items()} == {
        "error_vs_n": f"{where} max_error end_error local_order floor evaluations rms_error max_velocity_error "
        "end_velocity_error rms_velocity_error digits jacobians rounding",
        "order": "method case declared_order fitted_order spread cells_used n_range rounding",
        "energy_drift": f"{where} invariant max_drift_above_rest max_drift_relative slope_per_period slope_interval "
        "rounding",
        "phase": f"{where} max_phase_error end_phase_error max_amplitude_error end_amplitude_error lost phase_rounding "
        "amplitude_rounding",
        "growth": f"{where} quantity exponent interval law windows starts floor",
        "period": f"{where} period relative_error rounding",
        "defects": f"{where} symplecticity reversibility symplecticity_rounding reversibility_rounding",
        "adaptive": "method controller rtol atol case max_error end_error rms_error max_velocity_error digits "
        "evaluations jacobians accepted rejected floor failure rounding",
    }


def test_json_is_empty_lists_where_nothing_was_found():
    empty = dataclasses.replace(STUDY, error_vs_n=(), order=(), energy_drift=())
    assert _strict_json(shown(empty, "json"))["tables"] == {"error_vs_n": [], "order": [], "energy_drift": []}


def test_csv_blocks_each_have_a_header_and_full_precision():
    blocks = shown(STUDY, "csv").split("\n\n")
    assert [block.partition(",")[0] for block in blocks] == ["table"] * 3
    for name, block in zip(DEFAULT_TABLES, blocks, strict=True):
        rows = list(csv.DictReader(io.StringIO(block)))
        assert {row["table"] for row in rows} == {name}
        assert len(rows) == len(getattr(STUDY, name))
    errors = list(csv.DictReader(io.StringIO(blocks[0])))
    assert errors[0]["max_error"] == ""
    assert [float(row["max_error"]) for row in errors[1:]] == [cell.max_error for cell in STUDY.error_vs_n[1:]]
    assert {row["floor"] for row in errors} == {"true", "false"}


def test_csv_files_are_one_a_table_and_the_others_one_in_all():
    assert list(render.files(table.page(STUDY), "csv")) == [f"pendulum-{name}.csv" for name in DEFAULT_TABLES]
    for form, name in (("text", "txt"), ("markdown", "md"), ("latex", "tex"), ("json", "json")):
        assert render.files(table.page(STUDY), form) == {f"pendulum.{name}": shown(STUDY, form).encode()}


def test_markdown_rows_have_as_many_cells_as_their_header():
    tables = re.findall(r"(?:^\|.*\n)+", shown(STUDY, "markdown"), re.MULTILINE)
    assert len(tables) >= 4
    for found in tables:
        counts = {len(re.findall(r"(?<!\\)\|", line)) for line in found.splitlines()}
        assert len(counts) == 1


def test_latex_tabulars_are_balanced_and_escaped():
    source = shown(made_study(theta0=(1.0, 2.0)), "latex")
    body = "\n".join(line for line in source.splitlines() if not line.startswith("%"))
    assert not re.search(r"(?<![\\])_", body)
    assert body.count("$") % 2 == 0
    for name in ("table", "tabular"):
        assert body.count(rf"\begin{{{name}}}") == body.count(rf"\end{{{name}}}")
    labels = re.findall(r"\\label\{(.*?)\}", body)
    assert len(labels) == len(set(labels))
    for spec, body_rows in re.findall(r"\\begin\{tabular\}\{(\w+)\}(.*?)\\end\{tabular\}", body, re.DOTALL):
        data = re.findall(r"^(.*) \\\\$", body_rows.partition(r"\midrule")[2], re.MULTILINE)
        assert data
        assert {row.count("&") + 1 for row in data} == {len(spec)}


def test_latex_sets_powers_of_ten():
    one = Table("a", "t", (Grid((Column("x"),), (("-1.25e-05",), ("nan",))),))
    assert r"$-1.25\times10^{-5}$ \\" in text_table.latex(one)


def test_an_unknown_format_is_refused():
    with pytest.raises(ValueError, match="'yaml' is not one of text, markdown"):
        shown(STUDY, "yaml")


def extra_study(*scores: str, velocity: bool = True) -> Study:
    """A study with every score of two methods at three N."""
    study = made_study(methods=("verlet", "rk4"), n=(128, 512, 2048))
    (case,) = study.cases
    where = [(method, n, 10 / n, case) for method in ("verlet", "rk4") for n in (128, 512, 2048)]
    cells = study.error_vs_n
    if not velocity:
        blank = dict.fromkeys(("max_velocity_error", "rms_velocity_error", "end_velocity_error"), math.nan)
        cells = tuple(dataclasses.replace(cell, **blank) for cell in cells)
    growths = [
        Growth(*at, quantity, 1.0 + i / 10, 0.25, law, 5, 1, floor=law == "t")
        for at in where
        for i, (quantity, law) in enumerate((("place", "t"), ("phase", "t^2"), ("energy", "")))
    ]
    return dataclasses.replace(
        study,
        scores=scores,
        error_vs_n=cells,
        phase=tuple(Phase(*at, 1.25e-3, -1e-3, 2.5e-4, 1e-4, int(at[1] == 128)) for at in where),
        growth=tuple(growths),
        period=tuple(OwnPeriod(*at, 2.0, -3.75e-5) for at in where),
        defects=tuple(Defect(*at, math.nan if at[0] == "rk4" else 4.5e-16, 6.25e-7) for at in where),
    )


@pytest.mark.parametrize("width", [80, 120])
def test_every_score_fits_the_width_of_the_terminal(width):
    study = extra_study("norms", "phase", "growth", "period", "defects")
    for one in table.tables(study, width):
        assert max(len(line) for line in text_table.text(one).splitlines()[1:]) <= width


@pytest.mark.parametrize("form", ["markdown", "latex"])
def test_every_score_has_every_readable_form(form):
    study = extra_study("norms", "phase", "growth", "period", "defects")
    text = shown(study, form)
    mark = "### " if form == "markdown" else r"\caption{"
    assert text.count(mark + "Growth,") >= 3
    assert mark + "Symplecticity defect," in text


def test_only_the_scores_that_are_wanted_are_shown():
    titles = [one.title.partition(",")[0] for one in table.tables(extra_study("drift", "period"))]
    assert titles == ["Energy drift", "Energy trend", "Period"]
    assert [one.title.partition(",")[0] for one in table.tables(extra_study())] == []


def test_norms_are_of_place_and_velocity_with_digits_and_work():
    text = shown(extra_study("norms"), width=120)
    cell = next(cell for cell in extra_study().error_vs_n if (cell.method, cell.n) == ("rk4", 512))
    numbers = (cell.max_error, cell.rms_error, cell.end_error, cell.max_velocity_error)
    for number in numbers:
        assert f"{number:.2e}" in text
    assert f"{cell.digits:.1f}" in text
    assert "max v" in text
    assert "max v" not in shown(extra_study("norms", velocity=False), width=120)


def test_phase_and_amplitude_are_marked_where_states_were_lost():
    text = shown(extra_study("phase"))
    assert re.search(r"^ *128 .* 1\.25e-03! +1\.25e-03!$", text, re.MULTILINE)
    assert re.search(r"^ *512 .* 1\.25e-03 +1\.25e-03$", text, re.MULTILINE)
    assert "! means that some states are on no orbit" in text
    assert "2.50e-04" in text.partition("Amplitude")[2]


def test_growth_has_a_law_an_exponent_and_a_mark_for_rounding():
    text = shown(extra_study("growth"))
    assert re.search(r"^verlet +t +1\.00 ± 0\.25\*", text, re.MULTILINE)
    assert re.search(r"^rk4 +t\^2 +1\.10 ± 0\.25 ", text, re.MULTILINE)
    assert re.search(r"^rk4 +- +1\.20 ± 0\.25", text, re.MULTILINE)


def blank(growth):
    return dataclasses.replace(growth, exponent=math.nan, interval=math.nan, law="", windows=0)


@pytest.mark.parametrize("form", ["text", "markdown"])
def test_where_no_growth_is_known_one_sentence_says_what_it_takes(form):
    study = extra_study("growth")
    text = shown(dataclasses.replace(study, growth=tuple(map(blank, study.growth))), form)
    assert text.count("Growth,") == 1
    assert "no law can be told; one takes at least 32 periods (a later end of the march: --t-end), 128 steps" in text
    assert "nan" not in text


def test_one_growth_that_is_known_is_shown_among_others_that_are_not():
    study = extra_study("growth")
    first, *others = study.growth
    text = shown(dataclasses.replace(study, growth=(first, *map(blank, others))))
    assert text.count("Growth,") == 3
    assert "nan means fewer than 32 periods" in text


def test_a_law_takes_no_periods_where_there_are_none():
    study = extra_study("growth")
    case = dataclasses.replace(study.cases[0], cycle="s")
    growth = tuple(dataclasses.replace(blank(growth), case=case) for growth in study.growth)
    (one,) = table.tables(dataclasses.replace(study, cases=(case,), growth=growth))
    assert one.title.endswith("no law can be told; one takes at least 128 steps, and errors that are numbers")


def test_a_defect_that_no_method_has_is_no_column():
    symplecticity, reversibility = table.tables(extra_study("defects"))
    assert [column.label for column in symplecticity.grids[0].columns] == ["N", "h [s]", "verlet"]
    assert [column.label for column in reversibility.grids[0].columns] == ["N", "h [s]", "verlet", "rk4"]


def test_machine_forms_hold_all_that_was_scored_whatever_is_shown():
    study = extra_study("error")
    found = _strict_json(shown(study, "json"))["tables"]
    assert list(found) == [name for name in table.COLUMNS if name != "adaptive"]
    assert found["phase"][0] == {
        "method": "verlet", "n": 128, "h": 0.078125, "theta0": 1.0, "max_phase_error": 1.25e-3,
        "end_phase_error": -1e-3, "max_amplitude_error": 2.5e-4, "end_amplitude_error": 1e-4, "lost": 1,
            "phase_rounding": 0.0, "amplitude_rounding": 0.0,
    }  # fmt: skip
    assert found["defects"][-1]["symplecticity"] is None
    assert list(render.files(table.page(study), "csv")) == [f"pendulum-{name}.csv" for name in found]


def test_cases_of_several_forms_share_their_columns_in_machine_forms():
    one, other = (
        dataclasses.replace(made_case(1.0), inputs=inputs, label=label)
        for inputs, label in (((("form", "z"), ("z0", 0.5)), "z"), ((("form", "arc"), ("arc", 2.0)), "arc"))
    )
    study = made_study(methods=("rk4",), n=(128,))
    cells = tuple(dataclasses.replace(study.error_vs_n[0], case=case) for case in (one, other))
    found = rows(dataclasses.replace(study, cases=(one, other), error_vs_n=cells), "error_vs_n", table.COLUMNS)
    assert [(row["form"], row["z0"], row["arc"]) for row in found] == [("z", 0.5, None), ("arc", None, 2.0)]


def test_an_input_of_its_case_is_read_off_a_record_and_nothing_else():
    cell = STUDY.error_vs_n[1]
    assert cell.theta0 == 1.0
    with pytest.raises(AttributeError, match="Cell has no attribute 'z0'"):
        _ = cell.z0
    assert pickle.loads(pickle.dumps(cell)) == cell  # noqa: S301 - made here


def test_a_case_without_a_conserved_quantity_has_no_drift():
    case = dataclasses.replace(made_case(1.0), invariants=())
    study = made_study(methods=("rk4",), n=(128,))
    cells = tuple(dataclasses.replace(cell, case=case) for cell in study.error_vs_n)
    bare = dataclasses.replace(study, cases=(case,), error_vs_n=cells, order=(), energy_drift=())
    assert [one.title.partition(",")[0] for one in table.tables(bare)] == ["Error against N"]


def test_a_line_of_a_latex_heading_is_not_read_as_an_option() -> None:
    r"""`\\[s]` would ask for a vertical space of "s"."""
    columns = (text_table.Column("t [s]"), text_table.Column("error order", "[one]"), text_table.Column("*two x"))
    text = text_table.latex(text_table.Table("name", "title", (text_table.Grid(columns, (("1", "2", "3"),)),)))
    assert r"\shortstack{t\\{[s]}}" in text
    assert r"\\[" not in text
    assert r"\\*" not in text
