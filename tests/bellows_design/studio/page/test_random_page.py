"""Whatever is done on the page, and whatever gets lost: the design on the sliders is answered."""

from __future__ import annotations

import time
from typing import Any

import pytest
from pretended_studio import PretendedStudio, angle_of
from studio_in_browser import moved

from bellows_design.design.overrides import with_overrides
from bellows_design.design.shipped import load_design

pytestmark = pytest.mark.browser

OPERATIONS = """
async ({seed, count}) => {
  // Inputs, valid or not, undo, redo and reset, with pauses from none to longer than a rest.
  let state = seed;
  const chance = () => (state = (state * 1103515245 + 12345) % 2147483648) / 2147483648;
  const pause = (ms) => new Promise((done) => setTimeout(done, ms));
  const moves = {bubble_height: [18, 24], bubble_width: [19, 23], bubble_thickness: [1.2, 9.9]};
  const type = (name, value) => {
    const field = document.querySelector(`[data-parameter="${name}"] input[type=text]`);
    field.value = value.toFixed(2);
    for (const kind of ["input", "change"]) field.dispatchEvent(new Event(kind, {bubbles: true}));
  };
  for (let step = 0; step < count; step += 1) {
    const kind = chance();
    if (kind < 0.15) document.getElementById("undo").click();
    else if (kind < 0.25) document.getElementById("redo").click();
    else if (kind < 0.3) document.getElementById("reset").click();
    else {
      const [name, [low, high]] = Object.entries(moves)[Math.floor(chance() * 3)];
      type(name, low + chance() * (high - low));
    }
    await pause([0, 0, 5, 20, 60, 130, 200][Math.floor(chance() * 7)]);
  }
}
"""

UNDONE_AT_ONCE = """
async () => {
  // Invalid, and undone in the moment in which that is known: often before the slider has rested.
  const field = document.querySelector('[data-parameter="bubble_thickness"] input[type=text]');
  field.value = "9.9";
  for (const kind of ["input", "change"]) field.dispatchEvent(new Event(kind, {bubbles: true}));
  const figures = document.getElementById("figures");
  while (figures.dataset.state !== "invalid") await new Promise((done) => setTimeout(done, 1));
  document.getElementById("undo").click();
}
"""


def _type(page: Any, name: str, text: str) -> None:
    field = page.locator(f'[data-parameter="{name}"] input[type=text]')
    field.fill(text)
    field.press("Enter")


def _expect(page: Any, *changes: str) -> None:
    """The refined answer of that design."""
    page.wait_for_timeout(150)
    page.locator("#figures[data-state=refined]").wait_for()
    angle = float(page.locator("#angle").get_attribute("data-deg"))
    assert angle == pytest.approx(angle_of(with_overrides(load_design("prototype_1"), changes)))


@pytest.mark.parametrize("seed", [1, 2])
def test_after_random_operations_a_valid_design_is_answered(
    page: Any, studio: PretendedStudio, seed: int
) -> None:
    for number, height in enumerate((19, 23, 21)):
        page.evaluate(OPERATIONS, {"seed": 10 * seed + number, "count": 30})
        if number == 1:
            studio.cut()
        valid = {"bubble_height": height, "bubble_width": 20, "bubble_thickness": 1.5}
        for name, value in valid.items():
            _type(page, name, str(value))
        page.locator("#banner").wait_for(state="hidden")
        _expect(page, f"bubble_height={height}")


def test_undo_in_the_moment_of_the_explanation_goes_back_by_one_step(page: Any) -> None:
    for height in ("21", "22"):
        _type(page, "bubble_height", height)
        _expect(page, f"bubble_height={height}")
    for _ in range(5):
        page.evaluate(UNDONE_AT_ONCE)
        _expect(page, "bubble_height=22")


def test_a_slow_drag_that_rests_in_between_is_one_step_to_undo(
    page: Any, studio: PretendedStudio
) -> None:
    page.evaluate(
        """() => { const draw = window.requestAnimationFrame;
            window.requestAnimationFrame = (done) => setTimeout(() => draw(done), 200); }"""
    )
    studio.received.clear()
    moved(page, "bubble_height", [20.5, 21.0, 21.5], 30)
    assert len({each["revision"] for each in studio.received if each["type"] == "rest"}) == 3
    _expect(page, "bubble_height=21.5")
    page.locator("#undo").click()
    _expect(page)


@pytest.mark.slow
def test_an_answer_that_does_not_come_is_asked_for_again(
    page: Any, studio: PretendedStudio
) -> None:
    studio.held, studio.preview_seconds = True, 3.0
    _type(page, "bubble_height", "24")
    page.locator("#how", has_text="asked for it again").wait_for()
    rests = [each["revision"] for each in studio.received if each["type"] == "rest"]
    assert rests == [rests[-1]] * 2
    studio.held = False
    _expect(page, "bubble_height=24")


@pytest.mark.slow
def test_nothing_is_asked_for_again_where_an_answer_or_a_word_came(
    page: Any, studio: PretendedStudio
) -> None:
    _type(page, "bubble_thickness", "9.9")
    page.locator("#figures[data-state=invalid]").wait_for()
    page.wait_for_timeout(7000)
    studio.held = True
    _type(page, "bubble_thickness", "1.6")
    page.wait_for_timeout(300)
    revision = studio.last("rest")["revision"]
    until = time.monotonic() + 8
    while time.monotonic() < until:
        studio.say("working", revision=revision, what="preview", message="", fraction=0.5)
        page.wait_for_timeout(500)
    rests = [each["revision"] for each in studio.received if each["type"] == "rest"]
    assert len(rests) == len(set(rests))


def test_a_design_that_fails_at_once_says_so(page: Any, studio: PretendedStudio) -> None:
    studio.held = True
    _type(page, "bubble_height", "24")
    page.locator("#figures[data-state=computing]").wait_for()
    revision = studio.last("change")["revision"]
    studio.say("failed", revision=revision, what="change", message="the process ended")
    page.locator("#figures[data-state=failed]").wait_for()
    assert page.locator("#how").inner_text() == "the process ended"
