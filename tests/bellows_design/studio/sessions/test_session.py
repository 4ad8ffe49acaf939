"""What a page is sent when it moves sliders, rests, opens designs; nothing is computed."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest
from session_page import STUB, Page, in_loop, read

from bellows_design.studio.protocol import Request
from bellows_design.studio.sessions.lanes import Lanes
from bellows_design.studio.sessions.outbox import Outbox
from bellows_design.studio.sessions.session import Session
from bellows_design.studio.workers.lane import Lane


def test_after_opening_all_follows_in_order_without_being_asked(tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        kinds = [each["type"] for each in page.heard if each["type"] != "working"]
        assert kinds == ["start", "problems", "shape", "answer", "answer", "sensitivities"]
        states = [each["state"] for each in page.heard if each["type"] == "answer"]
        assert states == ["preview", "refined"]

    in_loop(tmp_path, check)


def test_shape_is_sent_with_its_revision_and_its_bytes(tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        page.tell("change", 4, values={"length": 55.0})
        shape = await page.until("shape")
        assert shape["revision"] == 4 and shape["payload"] == bytes([0, 1, 2])

    in_loop(tmp_path, check)


def test_moving_alone_solves_nothing_and_rest_solves_the_last_revision(tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        for revision in range(1, 40):
            page.tell("change", revision, values={"length": 50.0 + revision})
        await page.until("problems", revision=39)
        await page.quiet()
        assert not any(page.of("answer", revision) for revision in range(1, 40))
        page.tell("rest", 39)
        answer = await page.until("answer", state="refined")
        assert answer["revision"] == 39 and answer["values"] == {"length": 89.0}

    in_loop(tmp_path, check)


@pytest.mark.thorough
def test_many_quick_rests_leave_the_answer_of_the_last(tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        for revision in range(1, 30):
            page.tell("change", revision, values={"length": float(revision), "stub": "slow"})
            page.tell("rest", revision)
            await asyncio.sleep(0.03)
        page.tell("change", 30, values={"length": 30.0})
        page.tell("rest", 30)
        answer = await page.until("answer", state="refined")
        assert answer["revision"] == 30
        await page.quiet()
        assert not any(page.of("answer", revision) for revision in range(1, 30))

    in_loop(tmp_path, check)


def test_rest_of_an_older_revision_is_ignored(tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        page.tell("change", 1, values={})
        page.tell("change", 2, values={})
        page.tell("rest", 1)
        await page.quiet()
        assert not page.of("answer", 1) and not page.of("answer", 2)

    in_loop(tmp_path, check)


def test_resting_again_at_the_same_design_is_answered_too(tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        page.tell("change", 1, values={})
        for _ in range(3):
            page.tell("rest", 1)
            await asyncio.sleep(0.001)
        await page.until("sensitivities", revision=1)

    in_loop(tmp_path, check)


def test_cells_that_come_after_a_page_has_gone_make_no_shape_for_it(tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        page.tell("change", 1, values={"stub": "follows"})
        await page.until("shape_follows", revision=1)
        await page.quiet()
        page.session.close()
        cell = {"kind": "cell", "base": "", "values": {}, "surfaces": []}
        page.session._heard_of_cells(cell, {})
        quick = page.session._lanes.quick
        jobs = [job for job in (*quick._waiting, quick._running) if job is not None]
        assert page.session.number not in [job.owner for job in jobs]

    in_loop(tmp_path, check)


def test_invalid_values_are_explained_and_nothing_is_solved(tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        page.tell("change", 1, values={"stub": "invalid"})
        page.tell("rest", 1)
        found = await page.until("problems", revision=1)
        assert found["problems"]
        await page.quiet()
        assert not page.of("answer", 1) and not page.of("failed", 1)
        page.tell("change", 2, values={})
        page.tell("rest", 2)
        await page.until("answer", state="refined", revision=2)

    in_loop(tmp_path, check)


@pytest.mark.parametrize("kind", ["crash", "fail"])
def test_the_page_is_told_of_crashes_and_failures_and_goes_on(kind: str, tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        page.tell("change", 1, values={"stub": kind})
        page.tell("rest", 1)
        failed = await page.until("failed", what="refine")
        assert failed["revision"] == 1 and failed["message"]
        page.tell("change", 2, values={})
        page.tell("rest", 2)
        await page.until("answer", state="preview", revision=2)
        await page.until("answer", state="refined", revision=2)

    in_loop(tmp_path, check)


@pytest.mark.thorough
def test_a_solve_that_hangs_does_not_keep_the_next_design_from_its_answer(tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        page.tell("change", 1, values={"stub": "hang"})
        page.tell("rest", 1)
        await page.until("problems", revision=1)
        await asyncio.sleep(0.3)
        page.tell("change", 2, values={})
        page.tell("rest", 2)
        await page.until("answer", state="refined", revision=2)

    in_loop(tmp_path, check)


def test_scenes_are_given_their_keys_and_belong_to_the_design_on_the_sliders(
    tmp_path: Path,
) -> None:
    async def check(page: Page) -> None:
        page.tell("change", 1, values={})
        page.tell("scene", 1, scene="blocked", support="held")
        assert (await page.until("scene", revision=1))["keys"] == {"support": "held"}
        page.tell("scene", 0, scene="blocked")
        await page.quiet()
        assert not page.of("scene", 0)

    in_loop(tmp_path, check)


def test_a_design_that_cannot_be_opened_leaves_the_one_that_is_open(tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        page.tell("open", 1, design="unknown")
        failed = await page.until("failed", what="open")
        assert failed["revision"] == 1
        page.tell("change", 2, values={})
        page.tell("rest", 2)
        await page.until("answer", state="refined", revision=2)

    in_loop(tmp_path, check)


def test_start_says_the_revision_that_asked_for_it(tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        page.tell("open_toml", 7, text="name = 'x'")
        assert (await page.until("start"))["revision"] == 7
        await page.until("answer", state="refined", revision=7)

    in_loop(tmp_path, check)


def test_before_a_design_is_open_nothing_is_asked_for(tmp_path: Path) -> None:
    async def whole() -> None:
        lanes = Lanes(tmp_path, tmp_path, Lane(STUB), Lane(STUB), Lane(STUB))
        session = Session(lanes)
        session.receive(Request("change", 1, {"values": {}}))
        assert read(await session.outbox.get())["what"] == "open"
        assert not any(lane.busy for lane in lanes.all)
        lanes.close()

    asyncio.run(whole())


def test_shapes_that_wait_are_overtaken_and_answers_are_not() -> None:
    async def whole() -> None:
        box = Outbox()
        for number in range(5):
            box.put("shape", str(number))
            box.put("answer", f"a{number}")
        found = [await box.get() for _ in range(6)]
        assert found == ["a0", "a1", "a2", "a3", "4", "a4"]

    asyncio.run(whole())
