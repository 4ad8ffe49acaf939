"""A fingertip in scenes: longer, heavier, and where the finger touches."""

from __future__ import annotations

import numpy as np
import pytest
from linear_finger import BEND, DESIGN, TURN, arms, linear_law

from bellows_design.design import Design
from bellows_design.design.features.fingertip import Fingertip
from bellows_design.design.scenes.blocked import Blocked
from bellows_design.design.scenes.free import Free
from bellows_design.design.scenes.payload import Payload
from bellows_design.errors import DesignError
from bellows_design.force.chain.finger.weight import GRAVITY
from bellows_design.force.curve import force_curve
from bellows_design.force.scene.solved import chain_of
from bellows_design.force.scene.surroundings import DENSITY, weights_of

SMALL = 1e-4
"""MPa."""

PAD = Fingertip(length=10, width=4, thickness=3, ribs=0)


def with_pad(**scenes: object) -> Design:
    """Prototype 1 with a pad no wider than its tendon, and scenes."""
    return Design.of(DESIGN.model_dump() | {"fingertip": PAD.model_dump(), "scenes": scenes})


def test_the_pad_lengthens_the_chain_and_its_lower_edge_is_the_tip() -> None:
    design, law = with_pad(), linear_law()
    chain = chain_of(design, law)
    assert chain.length == pytest.approx(design.finger_length) == 60
    assert chain.tip_height == PAD.thickness
    free = force_curve(design, Free(), (SMALL,), law).last
    fall = -free.tip_position_mm[1]
    assert fall == pytest.approx(TURN * SMALL * (arms() + PAD.length).sum(), rel=1e-2)
    assert free.shape[-1] == pytest.approx(free.tip_position_mm)


def test_a_longer_tip_pushes_less() -> None:
    reach = arms() + PAD.length
    expected = TURN * SMALL * reach.sum() / (BEND * (reach**2).sum())
    found = force_curve(with_pad(), Blocked(), (SMALL,), linear_law()).last
    assert found.force_n == pytest.approx(expected, rel=1e-3)


def test_the_pad_weighs_at_its_centre() -> None:
    """More than the tendon's end by the pad's volume, whose moments add up."""
    filament = DESIGN.profile().filament
    density = DENSITY if filament is None else filament.density
    with_it, without = weights_of(with_pad()).tip, weights_of(DESIGN).tip
    newtons = density * 1e-6 * GRAVITY * PAD.volume
    assert with_it.newtons == pytest.approx(without.newtons + newtons)
    chain = chain_of(with_pad(), linear_law())
    centre = chain.length - chain.tip_length / 2 + with_it.ahead
    alone = chain_of(DESIGN, linear_law())
    before = alone.length - alone.tip_length / 2 + without.ahead
    moments = without.newtons * before + newtons * (50 + PAD.length / 2)
    assert with_it.newtons * centre == pytest.approx(moments)
    heights = without.newtons * without.height + newtons * PAD.thickness / 2
    assert with_it.newtons * with_it.height == pytest.approx(heights)


def test_a_payload_hangs_on_the_pad_or_at_a_place_on_it() -> None:
    at_tip, on_pad = (
        force_curve(with_pad(), Payload(mass_g=1.0, place=place), (SMALL,), linear_law()).last
        for place in (None, 55.0)
    )
    assert at_tip.tip_position_mm[1] < on_pad.tip_position_mm[1]
    assert with_pad(p={"kind": "payload", "mass_g": 1.0, "place": 60.0}).scenes
    with pytest.raises(DesignError, match="place = 61 mm lies beyond the finger's length of 60"):
        with_pad(p={"kind": "payload", "mass_g": 1.0, "place": 61.0})


def test_a_finger_that_ends_with_its_last_bubble_has_no_weight_beyond_it() -> None:
    flush = DESIGN.bellows.model_copy(update={"length": 49.25})
    design = DESIGN.model_copy(update={"bellows": flush})
    chain = chain_of(design, linear_law())
    assert chain.tip_length < 0 and weights_of(design).tip.newtons == 0
    found = force_curve(design, Free(gravity=(0.0, -1.0)), (SMALL,), linear_law()).last
    assert np.isfinite(found.tip_position_mm).all()
