"""Functions are compiled also where no cache can be kept, or what is kept is damaged."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from numba import config

from printers import compilation as printers_compilation
from solver import compilation

ROOT = Path(__file__).parents[2]
BOTH = pytest.mark.parametrize("own", [compilation, printers_compilation])

DOUBLED = """
from {package}.compilation import njit

@njit(cache=True)
def doubled(x):
    return 2 * x
"""


def double(x: float) -> float:
    return 2 * x


def test_both_packages_which_know_nobody_do_the_same() -> None:
    texts = [
        Path(module.__file__).read_text("utf-8") for module in (compilation, printers_compilation)
    ]
    assert texts[0].replace("solver", "printers") == texts[1]


@BOTH
def test_where_no_folder_may_be_written_to_nothing_is_kept(
    own: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    def no_locator(function: object) -> None:
        raise RuntimeError("cannot cache function 'double': no locator available for file")

    monkeypatch.setattr(own, "_Cache", no_locator)
    doubled = own.njit(cache=True)(double)  # type: ignore[attr-defined]
    assert doubled(2.0) == 4.0


@BOTH
def test_a_disk_that_is_full_stops_no_computation(
    own: object, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(config, "CACHE_DIR", str(tmp_path))
    monkeypatch.setattr("numba.core.caching.IndexDataCacheFile._save_data", full)
    doubled = own.njit(cache=True)(double)  # type: ignore[attr-defined]
    assert doubled(2.0) == 4.0


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".nbi", ".nbc"])
@pytest.mark.parametrize("damage", [b"", b"\x80\x04nonsense"])
def test_a_damaged_cache_is_compiled_anew(suffix: str, damage: bytes, tmp_path: Path) -> None:
    def ask() -> str:
        code = "import sys; sys.path.insert(0, sys.argv[1]); from mine import doubled; "
        code += "print(doubled(2.0), sum(doubled.stats.cache_hits.values()))"
        done = subprocess.run(
            [sys.executable, "-c", code, str(tmp_path)],
            cwd=ROOT,
            env={"PYTHONPATH": str(ROOT), "NUMBA_CACHE_DIR": str(tmp_path / "cache")},
            capture_output=True,
            encoding="utf-8",
        )
        return done.stdout.strip() or done.stderr

    (tmp_path / "mine.py").write_text(DOUBLED.format(package="solver"))
    assert (ask(), ask()) == ("4.0 0", "4.0 1")
    (kept,) = (tmp_path / "cache").rglob(f"*{suffix}")
    kept.write_bytes(damage)
    assert ask() == "4.0 0"
