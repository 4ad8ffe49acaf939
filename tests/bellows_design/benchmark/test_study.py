"""Speed against error: known answers from made-up numbers, one real study, the command."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Callable
from dataclasses import astuple, replace
from pathlib import Path
from typing import Any

import pytest
from rich.console import Console

from bellows_design import load_design, with_overrides
from bellows_design.analysis.computation import Seconds
from bellows_design.analysis.error_estimate import ErrorEstimate
from bellows_design.analysis.evaluate import evaluate, evaluation_of
from bellows_design.analysis.models import UNIT_CELL
from bellows_design.benchmark import neighbours
from bellows_design.benchmark import study as benchmark
from bellows_design.benchmark.rates import fitted_exponent, observed_orders
from bellows_design.benchmark.reference import Reference, reference_of
from bellows_design.benchmark.series import Level, Series, TrueErrors, Work, finest_of
from bellows_design.benchmark.study import Study, computations
from bellows_design.machine import Machine, machine
from bellows_design.reports.benchmark import benchmark_tables

Bellows = Callable[..., tuple[int, str, str]]

EXACT = Reference(200.0, 5.0, "unit-cell", 100_000, 50_000, "made-up values")


def level(elements: int, angle_error: float, stress_error: float, **others: Any) -> Level:
    """A mesh whose errors are given in percent of ``EXACT``, twice as large by its estimate."""
    unknowns = 6 * elements
    made = Level(
        Work(elements, unknowns, 5, 4, 4 * 1e-6 * unknowns**1.5),
        Seconds(0.0, 0.25, 1.0),
        Seconds(0.5, 0.25, elements / 1000),
        512.0,
        200.0 * (1 - angle_error / 100),
        5.0 * (1 - stress_error / 100),
        ErrorEstimate(2 * angle_error, 2 * stress_error),
    )
    return replace(made, **others)


LEVELS = (level(1000, 4.0, 16.0), level(8000, 0.5, 4.0), level(64_000, 0.25, 1.0))


def series(*levels: Level, model: str = "unit-cell", reference: Reference = EXACT) -> Series:
    return Series(model, "as asked for", True, levels, reference)


def made_study(*found: Series) -> Study:
    described = Machine("a processor", 2, None, 0.5, "none", {"python": "3"})
    return Study(load_design("prototype_1"), found or (series(*LEVELS),), described)


def text_of(study: Study) -> str:
    """The tables as an 80 columns wide terminal shows them."""
    console = Console(width=80, soft_wrap=True, highlight=False, markup=False)
    with console.capture() as capture:
        for line in benchmark_tables(study):
            console.print(line)
    return capture.get()


def test_errors_are_in_percent_of_the_reference() -> None:
    coarse, middle, fine = series(*LEVELS).errors
    assert coarse.bending_angle_percent == pytest.approx(4.0)
    assert middle.max_von_mises_percent == pytest.approx(4.0)
    assert fine == TrueErrors()  # as fine as the reference


def test_the_ratio_is_the_estimate_over_the_error() -> None:
    ratios = series(*LEVELS).ratios
    assert astuple(ratios[0]) == pytest.approx((2.0, 2.0))
    assert astuple(ratios[2]) == (None, None)


def test_a_load_that_was_not_reached_has_no_error() -> None:
    assert series(replace(LEVELS[0], converged=False)).errors == (TrueErrors(),)


def test_orders_are_slopes_over_the_number_of_elements() -> None:
    orders = series(*LEVELS).orders
    # eight times the elements, an eighth of the error
    assert orders.bending_angle == (pytest.approx(1.0), None)
    assert orders.max_von_mises == (pytest.approx(2 / 3), None)
    assert observed_orders([1, 10], [1.0, 10.0]) == (pytest.approx(-1.0),)
    assert observed_orders([1, 10, 10], [1.0, 0.0, 1.0]) == (None, None)
    assert observed_orders([1], [1.0]) == ()


def test_a_halfs_orders_are_those_against_the_finest_half() -> None:
    """The difference between the models must not pass for an error that never shrinks."""
    half = replace(EXACT, model="half", bending_angle_deg=202.0)
    meshes = [level(n, 0, 0, bending_angle_deg=202.0 - 1000 / n) for n in (1000, 2000)]
    found = series(*meshes, model="half", reference=replace(EXACT, finest_half=half))
    assert found.orders.bending_angle == (pytest.approx(1.0),)
    rows = found.to_dict()["meshes"]
    assert rows[1]["error"]["bending_angle_percent"] == pytest.approx(0.75)
    against_half = rows[1]["error_against_finest_half"]["bending_angle_percent"]
    assert against_half == pytest.approx(100 * 0.5 / 202)


def test_the_growth_of_time_is_fitted_to_seconds_per_factorization() -> None:
    assert series(*LEVELS).exponent == pytest.approx(1.5)
    assert fitted_exponent([1.0, 10.0, 100.0], [1.0, 20.0, 100.0]) == pytest.approx(1.0)
    assert series(LEVELS[0]).exponent is None
    assert series(LEVELS[0]).solve_exponent is None
    grown = [replace(level(n, 0, 0), so_far=Seconds(solve=float(n) ** 1.25)) for n in (1000, 3000)]
    power = math.log(3**1.25) / math.log(grown[1].work.unknowns / grown[0].work.unknowns)
    assert series(*grown).solve_exponent == pytest.approx(power)
    assert fitted_exponent([], []) is None


def test_without_a_stored_reference_the_finest_mesh_judges_the_others() -> None:
    found = series(*LEVELS, reference=finest_of("unit-cell", LEVELS))
    assert found.errors[2] == TrueErrors()
    assert found.errors[0].bending_angle_percent == pytest.approx(100 * (1 - 192 / 199.5))
    assert "its own finest mesh, 64000 tetrahedra" in text_of(made_study(found))


def test_an_unfinished_mesh_judges_nothing() -> None:
    stopped = replace(LEVELS[1], converged=False, bending_angle_deg=90.0)
    assert finest_of("half", (LEVELS[0], stopped)).elements == LEVELS[0].work.elements


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"models": ["magic"]}, "model = 'magic' must be one of auto, unit-cell, half, full."),
        ({"meshes": 0}, "meshes = 0 must lie between 1 and 9."),
        ({"meshes": 10}, "meshes = 10 must lie between 1 and 9."),
    ],
)
def test_bad_input_is_refused_before_any_work(
    arguments: dict[str, Any], sentence: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(benchmark, "warm_up", lambda *_: pytest.fail("worked"))
    with pytest.raises(ValueError) as refused:
        benchmark.study(load_design("prototype_1"), **arguments)
    assert str(refused.value) == sentence


ONE_BUBBLE = with_overrides(
    load_design("prototype_1"),
    ["length=11.5", "offset=3", "number_of_bubbles=1", "load.pressure=0.01"],
)


@pytest.mark.thorough
def test_a_real_study_counts_what_each_mesh_takes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(benchmark, "warm_up", lambda *_: None)
    monkeypatch.setattr(benchmark, "neighbour_rows", lambda *_: ())
    nowhere = Path(__file__).parent / "no such file"
    found = benchmark.study(ONE_BUBBLE, ["unit-cell", "unit-cell"], 2, references=nowhere)
    (cell,) = found.series
    first, second = cell.levels
    assert cell.model == "unit-cell" and found.converged and cell.note == ""
    assert second.work.elements > first.work.elements
    assert second.work.unknowns > first.work.unknowns
    assert 0 < second.work.factorizations <= second.work.newton_iterations
    assert first.stages.geometry > 0 and second.stages.geometry == 0
    assert second.so_far.total == pytest.approx(first.stages.total + second.stages.total)
    assert cell.ends is not None
    solving = sum(w.solver_seconds for w in (first.work, second.work))  # the ends beside them
    assert second.so_far.solve >= solving  # besides solving: transfer, events
    assert first.peak_memory_mib is None or first.peak_memory_mib > 50
    assert first.estimate == ErrorEstimate() and second.estimate.bending_angle_percent


@pytest.mark.slow
def test_the_study_goes_the_way_of_an_evaluation() -> None:
    """What is timed is what the product does."""
    evaluation = evaluate(ONE_BUBBLE)
    *_, computed = computations(ONE_BUBBLE, evaluation.model, "", len(evaluation.meshes))
    last = evaluation_of(computed)
    assert len(last.meshes) == len(evaluation.meshes) == 2
    assert last.bending_angle_deg == pytest.approx(evaluation.bending_angle_deg, rel=1e-6)
    assert last.max_von_mises_mpa == pytest.approx(evaluation.max_von_mises_mpa, rel=1e-3)
    assert last.seconds.to_dict().keys() == evaluation.seconds.to_dict().keys()


def test_the_warm_up_solves_two_meshes_and_the_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Any] = []
    monkeypatch.setattr(benchmark, "computations", lambda *given: asked.append(given) or ())
    benchmark.warm_up.__wrapped__()
    (design, model, _, meshes), *_ = asked
    assert design.name == "prototype_1" and model is UNIT_CELL and meshes == 2


def test_the_json_contract() -> None:
    cell = replace(series(*LEVELS), ends=Work(500, 3000, 9, 8, 0.75))
    study = replace(made_study(cell), machine=machine())
    content = json.loads(json.dumps(study.to_dict(), allow_nan=False))
    keys = {"design", "digest", "pressure_mpa", "converged", "models", "neighbours", "machine"}
    assert content.keys() == keys
    model = content["models"][0]
    assert model["reference"]["recipe"] and model["ends"]["factorizations"] > 0
    assert set(model["orders"]) == {"bending_angle", "max_von_mises"}
    assert {
        "elements",
        "unknowns",
        "newton_iterations",
        "factorizations",
        "seconds",
        "seconds_so_far",
        "seconds_per_factorization",
        "peak_memory_mib",
        "bending_angle_deg",
        "max_von_mises_mpa",
        "error",
        "error_estimate",
        "estimate_over_error",
    } <= model["meshes"][0].keys()
    assert {"processor", "cores", "memory_gib", "versions"} <= content["machine"].keys()
    assert content["machine"]["versions"]["python"]


def test_a_sequence_ends_where_meshing_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    from solver.errors import MeshingError

    def one_and_no_more(*_: Any) -> Any:
        yield "computation"
        raise MeshingError("no usable mesh.")

    monkeypatch.setattr(benchmark, "_level", lambda *_: LEVELS[0])
    found, note = benchmark._collected(one_and_no_more())
    assert found == [("computation", LEVELS[0])] and note == "no usable mesh."


def test_the_tables_show_every_mesh_and_fit_a_terminal() -> None:
    half = replace(EXACT, model="half", elements=90_000, largest=60_000, recipe="the finest half")
    reference = replace(EXACT, finest_half=half)
    stopped = replace(
        series(*LEVELS[:2], model="half", reference=reference), converged=False, note="it buckled."
    )
    ends = Work(500, 3000, 9, 8, 0.75)
    cell = replace(series(*LEVELS, reference=reference), ends=ends)
    text = text_of(made_study(cell, stopped))
    tables, _, findings = text.partition("estimate: ")
    assert "…" not in tables and max(map(len, tables.splitlines())) <= 80
    assert tables.count("64000") == 2 and tables.count("8000") >= 4
    for words in (
        "unit-cell: errors are against made-up values.",
        "unit-cell: the first mesh's seconds include the ends: 500 tetrahedra, 8 factorizations",
        "unit-cell: observed orders in 1/tetrahedra: angle 1.00, –; stress 0.67, –.",
        "unit-cell: the seconds per factorization grow as unknowns^1.50.",
        "half: against the finest half: angle 4.00, 0.50 %; stress 16.00, 4.00 %.",
        "half: NOT CONVERGED: it buckled.",
        "a processor, 2 cores; load average before the start 0.5",
    ):
        assert words in findings


@pytest.fixture
def quick_study(monkeypatch: pytest.MonkeyPatch) -> list[tuple[Any, ...]]:
    """Puts a made-up study in the place of the real one; the list tells what it was asked."""
    asked: list[tuple[Any, ...]] = []

    def study(design: Any, models: Any, meshes: Any, progress: Any, budget: Any) -> Study:
        asked.append((design, list(models), meshes))
        return made_study()

    monkeypatch.setattr(benchmark, "study", study)
    return asked


def test_the_command_prints_tables_or_one_object(
    bellows: Bellows, quick_study: list[tuple[Any, ...]], tmp_path: Path
) -> None:
    status, out, _ = bellows("benchmark")
    assert status == 0 and "precision" in out
    file = tmp_path / "work.json"
    arguments = ("--model", "half", "--model", "full", "--meshes", "2", "--output", str(file))
    status, out, _ = bellows("benchmark", "prototype_2", *arguments, "--json")
    assert status == 0 and json.loads(out) == json.loads(file.read_text("utf-8"))
    (first, models, meshes), (second, *given) = quick_study
    assert (first.name, models, meshes) == ("prototype_1", ["unit-cell", "half"], None)
    assert second.name == "prototype_2" and given == [["half", "full"], 2]
    assert [path.name for path in tmp_path.iterdir()] == ["work.json"]


def test_a_load_not_reached_has_status_3(bellows: Bellows, monkeypatch: pytest.MonkeyPatch) -> None:
    stopped = made_study(replace(series(*LEVELS), converged=False, note="it buckled."))
    monkeypatch.setattr(benchmark, "study", lambda *_, **__: stopped)
    status, out, _ = bellows("benchmark")
    assert status == 3 and "it buckled." in out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--plot", "work.pdf"), "must end in .png"),
        (("--output", "work.txt"), "must end in .json"),
        (("--output", "no/where.json"), "there is no folder"),
        (("--set", "bubble_width=nan"), "finite number"),
    ],
)
def test_bad_input_to_the_command_is_one_sentence(
    arguments: tuple[str, ...],
    words: str,
    bellows: Bellows,
    quick_study: list[tuple[Any, ...]],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    status, out, err = bellows("benchmark", *arguments)
    assert status == 2 and words in err and err.count("\n") == 1 and out == ""
    assert not quick_study and not list(tmp_path.iterdir())


def test_an_unknown_model_is_wrong_usage(
    bellows: Bellows, quick_study: list[tuple[Any, ...]]
) -> None:
    status, out, err = bellows("benchmark", "--model", "magic")
    assert status == 2 and out == "" and "magic" in err and not quick_study


def test_a_plot_without_matplotlib_names_the_extra_before_any_work(
    bellows: Bellows,
    quick_study: list[tuple[Any, ...]],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    status, _, err = bellows("benchmark", "--plot", str(tmp_path / "work.png"))
    assert status == 2 and "extra “pictures”" in err and err.count("\n") == 1
    assert not quick_study and not list(tmp_path.iterdir())


def test_the_plot_is_a_picture_and_complete_or_not_there(
    bellows: Bellows,
    quick_study: list[tuple[Any, ...]],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    figure = pytest.importorskip("matplotlib.figure")
    file = tmp_path / "work.png"
    assert bellows("benchmark", "--plot", str(file))[0] == 0
    content = file.read_bytes()
    assert content.startswith(b"\x89PNG") and len(content) > 10_000

    def full(self: Any, target: Path, **_: Any) -> None:
        Path(target).write_bytes(b"half a picture")
        raise OSError(28, "No space left on device", "work.png")

    monkeypatch.setattr(figure.Figure, "savefig", full)
    status, _, err = bellows("benchmark", "--plot", str(file))
    assert status == 2 and "No space left" in err
    assert file.read_bytes() == content and [path.name for path in tmp_path.iterdir()] == [
        file.name
    ]


def test_a_plot_of_a_single_mesh_without_errors_is_drawn_too(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    from bellows_design.reports.benchmark_plot import plot_benchmark

    alone = series(LEVELS[0], reference=finest_of("unit-cell", LEVELS[:1]))
    plot_benchmark(made_study(alone), tmp_path / "alone.png")
    assert (tmp_path / "alone.png").stat().st_size > 10_000


@pytest.mark.slow
def test_neighbours_are_measured_against_the_same_reference(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(neighbours, "SHARES", (0.02,))
    design = load_design("prototype_2")
    reference = reference_of(design)
    assert reference is not None
    (row,) = neighbours.neighbour_rows(design, reference)
    assert row.share == 0.02 and not row.fallback and row.steps == 1
    assert 0 < row.factorizations <= row.newton_iterations
    for error, estimate in zip(astuple(row.errors), astuple(row.estimate), strict=True):
        assert error is not None and estimate is not None
        assert error <= estimate
