"""A store of files that others damage, remove and fill at the same time."""

from __future__ import annotations

import os
import pickle
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from threading import Event

import numpy as np
import pytest
from kept import key, small

from bellows_design.analysis.evaluation import Evaluation
from bellows_design.files.errors import CannotWrite
from bellows_design.store import Key, NoPlace, Store, cache_folder
from bellows_design.store.files import content_of, read, write

DESIGN = small()
KEY = key(DESIGN)


@pytest.fixture
def kept(store: Store, evaluation: Evaluation) -> Path:
    """The file of an evaluation."""
    assert store.keep(KEY, evaluation)
    (file,) = store.folder.rglob("*.npz")
    return file


def numbered(number: int) -> Key:
    return key(DESIGN, further_meshes=number)


def test_values_and_arrays_come_back_from_a_file(tmp_path: Path) -> None:
    values = {"number": 0.1 + 0.2, "nothing": None, "text": "µ", "limit": float("inf")}
    arrays = {"a": np.arange(6, dtype=np.int32).reshape(2, 3), "b": np.array([np.nan, -0.0])}
    write(tmp_path / "new" / "file.npz", content_of(values, arrays))
    found, found_arrays = read(tmp_path / "new" / "file.npz")
    assert found == values
    assert found_arrays.keys() == arrays.keys()
    assert all(found_arrays[name].tobytes() == arrays[name].tobytes() for name in arrays)


def test_an_empty_store_finds_nothing_and_makes_no_folder(store: Store) -> None:
    assert store.find(KEY, DESIGN) is None
    assert store.holdings().results == 0
    assert not store.folder.exists()


@pytest.mark.parametrize("part", np.linspace(0, 1, 24, endpoint=False))
def test_a_damaged_file_is_never_a_wrong_result(
    part: float, store: Store, kept: Path, evaluation: Evaluation
) -> None:
    """A changed byte is noticed, or stands where nothing is read; what is damaged goes."""
    content = bytearray(kept.read_bytes())
    content[int(part * len(content))] ^= 0x55
    kept.write_bytes(content)
    found = store.find(KEY, DESIGN)
    if found is None:
        assert not kept.exists()
    else:
        assert found == evaluation
        pairs = zip(found.computation.solutions, evaluation.computation.solutions, strict=True)
        assert all(np.array_equal(a.displacement, b.displacement) for a, b in pairs)


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"not a zip",
        b"PK\x05\x06" + bytes(18),
        pickle.dumps({"a": 1}),
        content_of({}, {}),
        content_of({"asked": KEY.asked}, {}),
        content_of({"asked": KEY.asked, "problems": [], "evaluation": {"model": "half"}}, {}),
        content_of({"asked": numbered(1).asked}, {}),
    ],
)
def test_a_foreign_file_is_no_result_and_goes(content: bytes, store: Store, kept: Path) -> None:
    kept.write_bytes(content)
    assert store.find(KEY, DESIGN) is None
    assert not kept.exists()


def test_a_file_cut_short_is_no_result(store: Store, kept: Path) -> None:
    whole = kept.read_bytes()
    for share in (0.1, 0.5, 0.99):
        kept.write_bytes(whole[: int(share * len(whole))])
        assert store.find(KEY, DESIGN) is None


def test_objects_that_run_code_are_not_loaded(store: Store, kept: Path) -> None:
    class Bomb:
        def __reduce__(self) -> tuple[object, ...]:
            return os.mkdir, (str(store.folder / "ran"),)

    np.savez(kept, values=np.array([Bomb()], dtype=object))
    assert store.find(KEY, DESIGN) is None
    assert not (store.folder / "ran").exists()


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes on this system")
def test_folders_and_pipes_in_a_file_s_place_are_no_results(store: Store, kept: Path) -> None:
    kept.unlink()
    kept.mkdir()
    assert store.find(KEY, DESIGN) is None
    assert store.holdings().results == 0
    kept.rmdir()
    os.mkfifo(kept)
    assert store.find(KEY, DESIGN) is None


def test_the_least_recently_used_goes_first(store: Store, evaluation: Evaluation) -> None:
    assert store.keep(numbered(0), evaluation)
    size = store.holdings().size
    small_store = replace(store, limit=int(3.5 * size))
    for number in (1, 2):
        assert small_store.keep(numbered(number), evaluation)
    for age, number in enumerate((2, 1, 0)):  # 0 is the oldest, but used last
        os.utime(small_store._path(numbered(number)), (1000 + age, 1000 + age))
    assert small_store.find(numbered(0), DESIGN)
    assert small_store.keep(numbered(3), evaluation)
    there = [bool(store.find(numbered(number), DESIGN)) for number in range(4)]
    assert there == [True, True, False, True]
    assert small_store.holdings().size <= small_store.limit


def test_what_is_larger_than_the_store_is_not_kept(store: Store, evaluation: Evaluation) -> None:
    assert not replace(store, limit=1000).keep(KEY, evaluation)
    assert store.holdings().results == 0


def test_what_time_had_a_part_in_is_not_kept(store: Store, evaluation: Evaluation) -> None:
    computation = evaluation.computation
    late = replace(computation, out_of_time=True)
    cut = replace(computation.finest, stopped_by="budget", converged=False)
    stopped = replace(computation, solved=(replace(computation.solved[0], solution=cut),))
    for each in (late, stopped):
        assert not store.keep(KEY, replace(evaluation, computation=each))
    assert store.find(KEY, DESIGN) is None


def test_a_folder_that_cannot_be_written_is_said(evaluation: Evaluation, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("no folder")
    store = Store(tmp_path / "file")
    assert store.find(KEY, DESIGN) is None
    with pytest.raises(OSError, match="file"):
        store.keep(KEY, evaluation)
    assert store.clear() == 0


def test_clearing_removes_results_and_nothing_else(
    store: Store, kept: Path, evaluation: Evaluation
) -> None:
    others = [store.folder / "mine.txt", kept.parent / "notes.npz", kept.with_suffix(".txt")]
    for other in others:
        other.write_text("another's")
    assert store.clear() == 0
    assert not kept.exists() and all(other.exists() for other in others)
    assert store.holdings().results == 0
    for other in others[1:]:
        other.unlink()
    store.clear()
    assert [path.name for path in store.folder.iterdir()] == ["mine.txt"]


def test_results_of_other_surroundings_are_counted_but_not_found(
    store: Store, evaluation: Evaluation
) -> None:
    assert store.keep(replace(KEY, surroundings="0" * 20), evaluation)
    assert store.find(KEY, DESIGN) is None
    holdings = store.holdings()
    assert (holdings.results, holdings.usable) == (1, 0)


def test_another_kind_of_result_is_not_found_among_evaluations(
    store: Store, evaluation: Evaluation
) -> None:
    other = replace(store, kind="neighbours")
    assert other.keep(KEY, evaluation)
    assert store.find(KEY, DESIGN) is None
    assert other.find(KEY, DESIGN) is not None


def test_a_folder_that_others_remove_whenever_it_is_empty_takes_every_file(tmp_path: Path) -> None:
    """As ``clear`` and ``keep`` of other processes do with the last result of some surroundings."""
    file = tmp_path / "kind" / "surroundings" / "result.npz"
    finished = Event()

    def remove_empty_folders() -> None:
        while not finished.wait(1e-4):
            for folder in (file.parent, file.parent.parent):
                with suppress(OSError):
                    folder.rmdir()

    with ThreadPoolExecutor(1) as pool:
        removing = pool.submit(remove_empty_folders)
        try:
            for turn in range(300):
                write(file, str(turn).encode())
                assert file.read_bytes() == str(turn).encode()
                file.unlink()
        finally:
            finished.set()
        removing.result()


def test_readers_beside_writers_and_removers_see_whole_results(
    store: Store, evaluation: Evaluation
) -> None:
    tight = replace(store, limit=2_000_000)

    def work(worker: int) -> bool:
        for turn in range(6):
            if worker == 0:
                tight.clear()
            if worker < 3:
                tight.keep(numbered(turn % 2), evaluation)
            found = tight.find(numbered(turn % 2), DESIGN)
            if found is not None and found != evaluation:
                return False
        return True

    with ThreadPoolExecutor(4) as pool:
        assert all(pool.map(work, range(4)))


def test_the_cache_is_where_the_variable_says(
    own_cache: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    assert cache_folder() == Store.usual().folder == own_cache
    monkeypatch.delenv("BELLOWS_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    usual = cache_folder()
    assert "bellows-design" in usual.parts
    monkeypatch.setenv("BELLOWS_CACHE", "")
    assert cache_folder() == usual


def test_a_home_folder_that_nobody_knows_is_said_in_a_sentence(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """In a container the user often is not listed, and ``~`` would be a folder of that name."""
    monkeypatch.setenv("BELLOWS_CACHE", "~nobody-of-this-name/results")
    with pytest.raises(NoPlace, match="is “~nobody-of-this-name/results”, but"):
        cache_folder()
    monkeypatch.setenv("BELLOWS_CACHE", "")
    for older in (True, False):

        def unresolved(*_: object, older: bool = older, **__: object) -> Path:
            if older:
                return Path("~/.cache/bellows-design")
            raise RuntimeError("could not determine the home directory")

        monkeypatch.setattr("platformdirs.user_cache_path", unresolved)
        with pytest.raises(NoPlace, match="the user's home folder is not known; set BELLOWS_CACHE"):
            cache_folder()


def test_a_full_disk_is_an_error_of_the_kind_that_names_the_file(
    store: Store, evaluation: Evaluation, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.replace", full)
    with pytest.raises(CannotWrite, match="No space left"):
        store.keep(KEY, evaluation)
    assert store.holdings().results == 0
