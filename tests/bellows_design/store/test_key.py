"""What has a part in a result has a part in its key, and nothing else."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from kept import key, small

from bellows_design.analysis.evaluate import evaluation_of
from bellows_design.analysis.mesh_sequence import started
from bellows_design.analysis.models import HALF, UNIT_CELL
from bellows_design.budget import DEFAULT, LONGEST, Budget
from bellows_design.design import Design
from bellows_design.store.key import digest
from bellows_design.store.surroundings import settings, sources_hash, surroundings

ROOT = Path(__file__).parents[3]
USUAL = key(small())


@pytest.mark.parametrize(
    "other",
    [
        key(small("bubble_width=13.9")),
        key(small("load.pressure=0.021")),
        key(small("material.valid_strain=[-0.1, 0.2]")),
        key(small("material.elongation_at_break=500")),
        key(small(), "half"),
        key(small(), accuracy=3.0),
        key(small(), pressures=(0.01,)),
        key(small(), budget=replace(DEFAULT, memory=0.9)),
        key(small(), budget=replace(DEFAULT, seconds=10.0)),
        key(small(), budget=replace(DEFAULT, mesh_seconds=10.0)),
        key(small(), further_meshes=1),
    ],
    ids=str,
)
def test_another_question_has_another_key(other: object) -> None:
    assert other != USUAL
    assert getattr(other, "text", None) != USUAL.text


def test_labels_and_the_order_of_pressures_decide_nothing() -> None:
    assert key(small("name=another", "description=words")) == USUAL
    assert key(small("material.source=somewhere")) == USUAL
    assert key(small(), pressures=(0.01, 0.02)) == key(small(), pressures=(0.02, 0.01))


CHANGED = {
    "name": "name=another",
    "description": "description=words",
    "bellows": "outer_fillet=0.3",
    "indent": "indent={shape='arc', depth=0.4, width=2}",
    "port": "port.wall=2",
    "fingertip": "fingertip={length=5, width=8, thickness=4}",
    "material": "material.mu=[0.9, 0.4]",
    "load": "load.pressure=0.021",
}
"""One change for each table of a design."""

UNREAD = {"mount", "printer", "limits", "scenes"}


class Watched(Design):
    """A design that refuses to tell what no evaluation shall read."""

    def __getattribute__(self, name: str) -> object:
        assert name not in UNREAD, f"an evaluation reads {name}"
        return super().__getattribute__(name)


def test_what_no_evaluation_reads_decides_no_key() -> None:
    for other in (
        "limits.max_von_mises=2", "limits.cross_section_width=25", "limits.leak_test=off",
        "printer=prusa_mk4", "mount={kind='flange'}", "scenes={a={kind='free'}}",
    ):  # fmt: skip
        assert key(small(other)) == USUAL
    required = small("scenes={a={kind='free'}}", 'limits.scenes=["a"]')
    assert key(required) == USUAL and required.digest != small().digest


@pytest.mark.slow
@pytest.mark.parametrize("model", ["cell", "half"])
def test_no_evaluation_reads_what_is_left_out_of_its_key(model: str) -> None:
    """Of one mesh, and its ends."""
    whole = small()
    watched = Watched.model_construct(
        **{name: getattr(whole, name) for name in Design.model_fields}
    )
    body = {"cell": UNIT_CELL, "half": HALF}[model]
    unhurried = Budget(seconds=LONGEST)
    found = evaluation_of(started(watched, body, "as asked for", (), budget=unhurried))
    assert found.converged


@pytest.mark.parametrize("field", sorted(set(Design.model_fields) - UNREAD))
def test_every_other_field_is_in_the_key_unless_it_is_a_label(field: str) -> None:
    other = CHANGED[field]
    assert (key(small(other)) == USUAL) == (field in {"name", "description"})


def test_the_same_number_of_any_type_is_the_same_question() -> None:
    """Studies take their numbers from arrays."""
    whole, single = Budget(2, 100, 200), Budget(np.float32(2), np.int64(100), np.float64(200))
    assert key(small(), budget=whole) == key(small(), budget=single)
    assert key(small(), accuracy=5) == key(small(), accuracy=np.float32(5))
    assert key(small(), pressures=np.array([0.01])) == key(small(), pressures=(0.01,))


def test_a_changed_module_of_ours_is_noticed(tmp_path: Path) -> None:
    for name in ("bellows_design/a.py", "solver/kernels/b.py", "printers/c.py"):
        (tmp_path / name).parent.mkdir(parents=True)
        (tmp_path / name).write_text("x = 1\n")
    before = sources_hash(tmp_path)
    (tmp_path / "printers/c.py").write_text("x = 2\n")
    assert sources_hash(tmp_path) == before
    (tmp_path / "solver/kernels/b.py").write_text("x = 2\n")
    changed = sources_hash(tmp_path)
    assert changed != before
    (tmp_path / "solver/kernels/b.py").rename(tmp_path / "solver/kernels/d.py")
    assert sources_hash(tmp_path) not in (before, changed)


@pytest.mark.thorough
def test_the_key_is_the_same_before_and_after_an_evaluation() -> None:
    """Nothing that the solver or its libraries set when they are loaded has a part in it."""
    script = (
        "from bellows_design.store.surroundings import surroundings; before = surroundings();"
        "import bellows_design.evaluation, bellows_design.pipeline, solver.kernels.assembly;"
        "from solver import solve, peak_von_mises; assert surroundings() == before"
    )
    subprocess.run([sys.executable, "-c", script], check=True, cwd=ROOT)


def test_settings_of_libraries_count_but_not_where_their_files_are() -> None:
    there = {"MKL_CBWR": "AVX2", "NUMBA_CACHE_DIR": "/somewhere", "HOME": "/root"}
    assert settings(there) == {"MKL_CBWR": "AVX2"}


def test_surroundings_name_sources_versions_solver_and_processor(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    here = surroundings()
    assert {"bellows-design", "numpy", "numba", "gmsh", "cadquery"} <= here["versions"].keys()
    assert here["linear_solvers"] and here["processor"] and len(here["sources"]) == 64
    monkeypatch.setenv("MKL_NUM_THREADS", "7")
    assert digest(surroundings()) != digest(here)
