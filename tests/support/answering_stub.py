"""In the place of evaluations: answers in no time, and designs that end their worker."""

from __future__ import annotations

import os
import time
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from bellows_design.batch.answer import Answer
from bellows_design.batch.question import Question

CRASHING = 13.0
"""mm. A bubble of this width ends the process that is asked about it."""


@dataclass
class Stub:
    """Answers after ``seconds``; the angle is the bubble's width, the stress its worker's process.

    Each key that is answered is written to ``log``, a line for each time.
    """

    seconds: float = 0.0
    log: Path | None = None

    def answer(self, question: Question) -> Answer:
        """Made up from the design alone."""
        width = question.design.bellows.bubble_width
        if width == CRASHING:
            os.abort()
        time.sleep(self.seconds)
        if self.log is not None:
            with self.log.open("a") as file:
                file.write(f"{question.key}\n")
        return Answer(
            key=question.key,
            digest=question.design.digest,
            bending_angle_deg=width,
            max_von_mises_mpa=float(os.getpid()),
            origin="ordinary",
        )


def stub(seconds: float = 0.0, log: Path | None = None) -> partial[Stub]:
    """What makes a stub in a worker."""
    return partial(Stub, seconds, log)


class Threads:
    """Answers with what tells the libraries of its process how many threads they may have."""

    def answer(self, question: Question) -> Answer:
        """As the reason: values of the environment, and numba's number."""
        import numba

        names = ("OMP_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
        found = [*(os.environ.get(name, "none") for name in names), str(numba.get_num_threads())]
        return Answer(key=question.key, digest="", reason=" ".join(found))


class Faulty:
    """Raises what no evaluation raises."""

    def answer(self, question: Question) -> Answer:
        """Never."""
        raise RuntimeError("no such luck")
