"""The real studio with its page in a browser: started, moved and read as people do."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
ADDRESS = re.compile(r"http://\S+\?token=\S+")

FIRST_ANSWER_MS = 600_000
"""The first evaluation also compiles."""

MOVE = """
async ({name, values, key}) => {
  // The slider is moved as a hand does it: pressed, some inputs, one a frame, and let go; where
  // frames are slow it rests in between, and all of that is one step to undo. The page's own times.
  const frame = () => new Promise(requestAnimationFrame);
  const angle = document.getElementById("angle");
  const figures = document.getElementById("figures");
  const input = document.querySelector(`[data-parameter="${name}"] input[type=range]`);
  input.scrollIntoView({block: "center"});
  const field = document.querySelector(`[data-parameter="${name}"] input[type=text]`);
  const pointer = (kind) => input.dispatchEvent(new PointerEvent(kind, {bubbles: true}));
  let began = performance.now();
  pointer("pointerdown");
  for (const value of values) {
    const before = field.value;
    input.value = value;
    input.dispatchEvent(new Event("input", {bubbles: true}));
    if (field.value !== before) began = performance.now();
    await frame();
  }
  pointer("pointerup");
  const state = () => figures.dataset.state;
  const shown = () => ["preview", "refined", "invalid", "failed"].includes(state());
  const deadline = began + key.limit_ms;
  while (!shown() && performance.now() < deadline) await frame();
  await frame();  // what is shown has been drawn once the next picture begins
  const seconds = (performance.now() - began) / 1000;
  return {
    seconds, state: shown() ? state() : "stuck",
    angle_deg: Number(angle.dataset.deg), shown: angle.textContent,
    revision: Number(angle.dataset.revision),
    value: field.value,
    problem: document.querySelector(`[data-parameter="${name}"] .problem`).textContent ||
             document.getElementById("problem-summary").textContent,
    how: document.getElementById("how").textContent,
  };
}
"""


@contextmanager
def running_studio(
    design: str, output: Path, environment: Mapping[str, str] | None = None
) -> Iterator[str]:
    """The address of a studio of one's own, which ends with the block."""
    command = [sys.executable, "-m", "bellows_design", "studio", design, "--no-browser"]
    process = subprocess.Popen(
        [*command, "--port", "0", "--output", str(output)],
        cwd=ROOT, env={**os.environ, **(environment or {})}, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
    )  # fmt: skip
    try:
        yield _address(process)
    finally:
        process.terminate()
        process.wait(30)


def _address(process: subprocess.Popen[str]) -> str:
    said = []
    for line in process.stdout or ():
        said.append(line)
        if found := ADDRESS.search(line):
            return found[0]
    raise RuntimeError(f"no address came: {''.join(said)}")


def wait_for_answer(page: Any, state: str = "refined", milliseconds: int = FIRST_ANSWER_MS) -> None:
    """Wait until the figures are those of the design on the sliders."""
    page.locator(f"#figures[data-state={state}]").wait_for(timeout=milliseconds)


def wait_for_any_answer(page: Any, milliseconds: int = FIRST_ANSWER_MS) -> None:
    """Wait for a preview or a refined answer of the design on the sliders."""
    answers = "#figures[data-state=preview], #figures[data-state=refined]"
    page.locator(answers).wait_for(timeout=milliseconds)


def moved(page: Any, name: str, values: list[float], limit_seconds: float) -> dict[str, Any]:
    """Move a slider through ``values``; what the page showed then, and after how many seconds.

    ``state`` is "preview", "refined", "invalid", "failed", or "stuck" after the limit. ``seconds``
    are those from the last move to the figure drawn, in the page's own clock.
    """
    key = {"limit_ms": 1000 * limit_seconds}
    return page.evaluate(MOVE, {"name": name, "values": values, "key": key})


def saved(page: Any) -> str:
    """The design on the sliders as TOML, saved by the page's button."""
    with page.expect_download() as download:
        page.locator("#save").click()
    return Path(download.value.path()).read_text(encoding="utf-8")


def sliders(page: Any) -> dict[str, dict[str, float]]:
    """Of every slider that can be moved: its value, its two ends and its step, by name."""
    return page.evaluate(
        """() => Object.fromEntries([...document.querySelectorAll(".slider-row")]
            .filter((row) => row.offsetParent && !row.querySelector("input[type=range]").disabled)
            .map((row) => { const range = row.querySelector("input[type=range]");
              return [row.dataset.parameter, {value: range.valueAsNumber, low: Number(range.min),
                high: Number(range.max), step: Number(range.dataset.step)}]; }))"""
    )
