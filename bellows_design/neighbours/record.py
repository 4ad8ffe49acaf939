"""What was found for a neighbouring design, as plain values."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

from bellows_design.analysis.evaluation import Evaluation, LoadedState, MeshSize, SolverEffort

if TYPE_CHECKING:
    from bellows_design.analysis.computation import Seconds
    from bellows_design.design.design import Design
    from bellows_design.neighbours.neighbourhood import Neighbourhood
    from solver import Solution


@dataclass(frozen=True, kw_only=True)
class NeighbourEvaluation(LoadedState):
    """The actuator under its design pressure, reached from a neighbouring design.

    The mesh is the neighbour's, moved; its equilibrium is where Newton's method started. What the
    ends add and the error of the mesh are carried along (``neighbours.carried``). It serves studies
    and previews: no verdict is decided by it.

    Attributes:
        design: The design evaluated.
        anchor: The ordinary evaluation that the mesh and what is carried along come from.
        distance: Of both designs, see ``neighbours.distance``.
        steps: Solves on the way; more than one where designs in between were needed.
        fallback: Why the design was evaluated ordinarily instead; empty if it was not. ``anchor``
            is that evaluation then.
        mesh: Size of the mesh.
        solver: Iterations and factorizations of all steps.
        seconds: Time spent, s.
        solution: Equilibrium of the model's body.
        neighbourhood: Where the next neighbour starts from; None after a ``fallback``, which begins
            a new one.

    Examples:
        >>> from bellows_design import evaluate, load_design, varied
        >>> design = load_design("prototype_1")
        >>> found = evaluate(varied(design, {"bubble_width": 20.2}), near=evaluate(design))
        >>> print(found.fallback == "", f"distance {found.distance:.2f}")
        True distance 0.01
    """

    ordinary: ClassVar[bool] = False

    design: Design
    anchor: Evaluation
    distance: float
    steps: int
    fallback: str
    mesh: MeshSize
    solver: SolverEffort
    seconds: Seconds
    solution: Solution = field(repr=False, compare=False)
    neighbourhood: Neighbourhood | None = field(default=None, repr=False, compare=False)

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON; docs/json.md says what they mean."""
        from bellows_design.versions import versions

        return {
            "design": self.design.name,
            "digest": self.design.digest,
            "model": self.anchor.model.name,
            **self.state_dict(),
            "neighbour": {
                "of": self.anchor.design.digest,
                "distance": self.distance,
                "steps": self.steps,
                "fallback": self.fallback,
            },
            "mesh": asdict(self.mesh),
            "solver": asdict(self.solver),
            "seconds": self.seconds.to_dict(),
            "versions": versions(),
        }
