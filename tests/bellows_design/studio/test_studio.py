"""The whole studio, its processes included: what a page is shown is what evaluate finds."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

import pytest

from bellows_design.design.design import Design
from bellows_design.design.shipped import load_design
from bellows_design.evaluation import evaluate
from bellows_design.studio.protocol import request_of
from bellows_design.studio.sessions.lanes import Lanes
from bellows_design.studio.sessions.session import Session

pytestmark = pytest.mark.slow

LONGEST = 600.0


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Evaluations of all tests here: the first design is the same."""
    return tmp_path_factory.mktemp("store")


class Page:
    """A page without a browser: what it heard, by kind, of the last revision."""

    def __init__(self, lanes: Lanes, folder: Path) -> None:
        self.session = Session(lanes)
        self.folder = folder
        self.revision = 0
        self.heard: list[dict[str, Any]] = []

    def change(self, values: dict[str, Any], rest: bool = True) -> None:
        self.revision += 1
        self.tell("change", values=values)
        if rest:
            self.tell("rest")

    def tell(self, kind: str, **content: Any) -> None:
        message = {"type": kind, "revision": self.revision, **content}
        self.session.receive(request_of(json.dumps(message)))

    async def until(self, kind: str, **content: Any) -> dict[str, Any]:
        wanted = {"type": kind, "revision": self.revision, **content}
        while True:
            message = await asyncio.wait_for(self.session.outbox.get(), LONGEST)
            if isinstance(message, bytes):
                message = message[4 : 4 + int.from_bytes(message[:4], "little")].decode()
            found = json.loads(message)
            self.heard.append(found)
            if wanted.items() <= found.items():
                return dict(found)

    async def saved(self) -> Design:
        return Design.from_toml((await self.session.toml(self.revision))["text"])


def in_loop(store: Path, folder: Path, check: Callable[[Page], Awaitable[None]]) -> None:
    async def whole() -> None:
        lanes = Lanes(store, folder / "exports")
        lanes.start()
        page = Page(lanes, folder)
        page.session.open("prototype_1", None, 0)
        try:
            await page.until("sensitivities")
            await check(page)
        finally:
            page.session.close()
            lanes.close()

    asyncio.run(whole())


def agree(answer: dict[str, Any], design: Design) -> None:
    """Angle and stress within the sum of both estimates."""
    found = evaluate(design)
    errors = found.error_estimate
    for shown, error, value, other in (
        ("bending_angle_deg", "angle_error_percent", found.bending_angle_deg,
         errors.bending_angle_percent),
        ("max_von_mises_mpa", "stress_error_percent", found.max_von_mises_mpa,
         errors.max_von_mises_percent),
    ):  # fmt: skip
        assert other is not None
        allowed = (abs(answer[shown]) * answer[error] + abs(value) * other) / 100
        assert abs(answer[shown] - value) <= allowed


def test_previews_and_refined_answers_are_those_of_evaluate_on_the_saved_design(
    store: Path, tmp_path: Path
) -> None:
    async def check(page: Page) -> None:
        for values in (
            {"bubble_width": 20.5},
            {"bubble_width": 20.5, "length": 60.0},
            {"bubble_width": 20.5, "length": 60.0, "tendon_height": 5.4},
        ):
            page.change(values)
            preview = await page.until("answer", state="preview")
            assert preview["how"].startswith("continued")
            agree(preview, await page.saved())
        refined = await page.until("answer", state="refined")
        found = evaluate(await page.saved())
        assert refined["bending_angle_deg"] == pytest.approx(found.bending_angle_deg, rel=1e-9)
        assert refined["max_von_mises_mpa"] == pytest.approx(found.max_von_mises_mpa, rel=1e-9)

    in_loop(store, tmp_path, check)


def test_all_kinds_of_messages_come_and_belong_to_the_design(store: Path, tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        kinds = {each["type"] for each in page.heard}
        assert kinds >= {
            "start", "problems", "lights", "shape", "answer", "deformed", "sensitivities",
        }  # fmt: skip
        measured = [each for each in page.heard if each.get("source") == "measured"]
        assert {light["rule"] for light in measured[0]["lights"]} >= {"airtightness", "watertight"}
        shapes = [each["source"] for each in page.heard if each["type"] == "shape"]
        assert "morph" in shapes and "cad" in shapes
        rows = {each["parameter"]: each for each in page.heard[-1]["sensitivities"]}
        assert rows["bubble_width"]["angle_per_unit"] > 0 > rows["tendon_width"]["angle_per_unit"]

    in_loop(store, tmp_path, check)


def test_other_faces_are_solved_by_themselves_and_shown(store: Path, tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        page.change({"inner_fillet": 1.0})  # a full round
        await page.until("shape_follows")
        preview = await page.until("answer", state="preview")
        assert preview["how"].startswith("the unit cell on a coarse mesh")
        await page.until("shape", source="morph")
        agree(preview, await page.saved())

    in_loop(store, tmp_path, check)


def test_many_quick_changes_leave_the_answer_of_the_last(store: Path, tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        for step in range(30):
            page.change({"bubble_width": 20.0 + 0.05 * step})
            await asyncio.sleep(0.05)
        answer = await page.until("answer", state="preview")
        agree(answer, await page.saved())
        assert (await page.saved()).bellows.bubble_width == pytest.approx(21.45)

    in_loop(store, tmp_path, check)


def test_a_preview_whose_process_was_killed_comes_from_another(store: Path, tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        import psutil

        lanes = page.session._lanes
        (former,) = lanes.preview.numbers
        psutil.Process(former).kill()
        page.change({"bubble_width": 20.5})
        await page.until("answer", state="refined")
        assert lanes.preview.numbers != (former,)
        page.change({"bubble_width": 20.6})
        answer = await page.until("answer", state="preview")
        assert answer["how"].startswith("continued")

    in_loop(store, tmp_path, check)


def test_blocked_scene_has_figures_and_a_picture(store: Path, tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        page.tell("scene", scene="blocked", support="held")
        found = await page.until("scene")
        figures = {each["label"]: each["value"] for each in found["figures"]}
        assert figures["Force"] > 0 and figures["Pressure"] == pytest.approx(0.1)
        assert found["svg"].startswith("<svg") and "style=" not in found["svg"]

    in_loop(store, tmp_path, check)


def test_run_writes_into_the_folder_of_exports_only(store: Path, tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        page.session.open("finger", None, page.revision)
        await page.until("start", name="finger")
        page.tell("run")
        ran = await page.until("ran")
        assert ran["approved"] and {"finger.stl", "finger_report.html", "manifest.json"} <= {
            each["name"] for each in ran["files"]
        }
        assert (tmp_path / "exports" / "finger" / "finger.stl").is_file()
        assert page.session.files["finger/finger.stl"][1] == "finger.stl"

    in_loop(store, tmp_path, check)


def test_first_design_of_the_page_is_that_of_the_command_line() -> None:
    design = load_design("prototype_2_indent")
    assert Design.from_toml(design.to_toml()).digest == design.digest
