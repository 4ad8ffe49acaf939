"""JSON: what numbers become, and files that are complete or not there."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from bellows_design.files.json_files import json_text, write_json


def test_json_has_no_nan_and_knows_numpy() -> None:
    content = {"a": float("nan"), "b": np.float64(2.5), "c": (1, None, True), "d": Path("x")}
    expected = {"a": None, "b": 2.5, "c": [1, None, True], "d": "x"}
    assert json.loads(json_text(content)) == expected


def test_a_failed_write_leaves_the_old_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "it.json"
    write_json({"a": 1}, path)
    monkeypatch.setattr(Path, "write_text", lambda *_: (_ for _ in ()).throw(OSError(28, "full")))
    with pytest.raises(OSError, match="full"):
        write_json({"a": 2}, path)
    assert json.loads(path.read_bytes()) == {"a": 1} and list(tmp_path.iterdir()) == [path]
