"""A sweep with stubs for evaluations, as a program that can be killed.

python stub_sweep.py FILE DESIGNS WORKERS SECONDS LOG [SCHEDULER]
"""

from __future__ import annotations

import sys
from functools import partial
from pathlib import Path

from answering_stub import stub

from bellows_design.batch.cluster import Cluster
from bellows_design.batch.places import Elsewhere, ThisMachine
from bellows_design.batch.results import opened
from bellows_design.design.shipped import load_design
from bellows_design.errors import ClusterError
from bellows_design.study.sweep.plan import Plan, Space, planned
from bellows_design.study.sweep.run import run
from bellows_design.study.sweep.sampling import Sampling
from bellows_design.study.sweep.space import axes


def plan_of(designs: int) -> Plan:
    """A sample of two widths around ``finger``."""
    base = load_design("finger")
    ranges = axes(["bubble_width=18:20", "tendon_width=5:6"], base)
    return planned(Space(base, ranges, Sampling.RANDOM, designs, seed=1))


def main(file: str, designs: str, workers: str, seconds: str, log: str, scheduler: str = "") -> int:
    """Go on with the sweep until it is done; 3 where the scheduler is gone."""
    plan = plan_of(int(designs))
    place = Elsewhere(scheduler) if scheduler else ThisMachine(int(workers))
    make = partial(Cluster, stub(float(seconds), Path(log)), place)
    try:
        with opened(Path(file), plan.study) as results:
            run(plan, results, make)
    except ClusterError as error:
        print(error, file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
