"""Whatever a page does before it rests on a valid design, that design is answered."""

from __future__ import annotations

import asyncio
import random
from pathlib import Path
from typing import Any

import pytest
from session_page import Page, in_loop

from bellows_design.studio.workers import lane as lanes

SLOW = pytest.mark.slow

KINDS = ("", "", "", "follows", "follows", "invalid", "slow", "deaf", "fail", "crash")
"""What a design does; ``follows``: its shape waits for a cell, which its previews send."""

PAUSES = (0.0, 0.0, 0.001, 0.005, 0.02, 0.05, 0.15)
"""s. Between two messages; so short that most of what was begun becomes stale under way."""


@pytest.mark.parametrize(
    ("seed", "moves"), [(0, 30), *(pytest.param(seed, 250, marks=SLOW) for seed in range(1, 4))]
)
@pytest.mark.thorough
def test_every_last_rest_on_a_valid_design_is_answered(
    seed: int, moves: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lanes, "PATIENCE", 0.1)
    chance = random.Random(seed)

    async def check(page: Page) -> None:
        before: list[dict[str, Any]] = [{}]
        for revision in range(1, moves + 1):
            await _moved(page, revision, chance, before)
            if revision % 10 == 0:
                await _rested(page, revision, chance)

    in_loop(tmp_path, check, 300)


async def _moved(
    page: Page, revision: int, chance: random.Random, before: list[dict[str, Any]]
) -> None:
    """A change, one of four an undo; most of them rest, some rest twice, some ask for a scene."""
    if chance.random() < 0.25 and len(before) > 1:
        before.pop()
        values = before[-1]
    else:
        values = {"stub": chance.choice(KINDS), "length": float(revision)}
        before.append(values)
    page.tell("change", revision, values=values)
    if chance.random() < 0.1:
        page.tell("scene", revision, scene="blocked")
    for _ in range(chance.choice((0, 1, 1, 2))):
        await asyncio.sleep(chance.choice(PAUSES))
        page.tell("rest", revision)
    await asyncio.sleep(chance.choice(PAUSES))


async def _rested(page: Page, revision: int, chance: random.Random) -> None:
    """A valid design at last: preview and refined answer, both its own, and no later ones."""
    values = {"stub": chance.choice(("", "follows")), "length": 1000.0 + revision}
    page.tell("change", revision, values=values)
    page.tell("rest", revision)
    for state in ("preview", "refined"):
        answer = await page.until("answer", state=state, values=values)
        assert answer["revision"] == revision


def test_a_cell_that_comes_while_the_change_still_waits_does_not_drop_the_answer(
    tmp_path: Path,
) -> None:
    async def check(page: Page) -> None:
        page.tell("change", 1, values={"stub": "follows"})
        await page.until("shape_follows", revision=1)
        lanes = page.session._lanes
        busy = lanes.take_cell({"base": "", "values": {"seconds": 0.3}, "surfaces": []}, {})
        page.tell("change", 2, values={"stub": "follows"})
        page.tell("rest", 2)
        await asyncio.sleep(0.05)  # what follows the rest now waits for the change
        assert not busy.outcome.done()
        cell = {"kind": "cell", "base": "", "values": {}, "surfaces": []}
        page.session._heard_of_cells(cell, {})
        await page.until("answer", revision=2, state="preview")
        await page.until("answer", revision=2, state="refined")

    in_loop(tmp_path, check)


def test_a_rest_that_is_asked_for_again_does_not_begin_anew(tmp_path: Path) -> None:
    async def check(page: Page) -> None:
        page.tell("change", 1, values={"stub": "slow"})
        page.tell("rest", 1)
        await page.until("working", revision=1, what="preview")
        chain = page.session._chain
        page.tell("rest", 1)
        assert page.session._chain is chain
        page.tell("change", 2, values={})
        page.tell("rest", 2)
        await page.until("answer", revision=2, state="refined")
        before = len(page.of("answer", 2))
        await page.until("sensitivities", revision=2)
        await page.quiet(0.2)
        page.tell("rest", 2)  # whoever missed the answer has it again
        await page.until("answer", revision=2, state="refined")
        assert len(page.of("answer", 2)) == 2 * before

    in_loop(tmp_path, check)
