"""A solution as a record, and what is read of it."""

from __future__ import annotations

import numpy as np

from bellows_design.force.chain.balance import Unknowns
from bellows_design.force.chain.contact.forces import ContactHistory
from bellows_design.force.chain.equilibrium import Equilibrium
from bellows_design.force.chain.loaded_chain import LoadedChain
from bellows_design.force.chain.stability import stability_margin, tip_stiffness
from bellows_design.force.chain.state import ChainState, ContactPoint
from bellows_design.force.chain.surroundings import LoadPoint
from solver.arrays import Reals


def state_of(loaded: LoadedChain, load: LoadPoint, found: Equilibrium) -> ChainState:
    """The record of an equilibrium under ``load``."""
    at, balance = found.at, found.balance
    margin = stability_margin(balance, found.holding, loaded.chain.softest)
    volume = float(balance.response.volume.sum())
    stored = (at.loads * at.motions).sum() + load.pressure * volume - balance.response.energy.sum()
    x, z, moment = (float(value) for value in at.held)
    return ChainState(
        pressure=load.pressure,
        motions=at.motions,
        loads=at.loads,
        frames=_frames(loaded, found),
        contacts=_contacts(loaded, load, found),
        held_force=(x, z, moment),
        stable=margin > 0,
        stored_energy=float(stored),
        contact_energy=float(balance.contact.energy.sum()),
        iterations=found.iterations,
        volume=volume,
        margin=margin,
        tip_stiffness=tip_stiffness(balance, found.holding),
        load=load,
        history=history_of(loaded, found),
    )


def unknowns_of(state: ChainState) -> Unknowns:
    """Where the next solve starts."""
    return Unknowns(state.motions, state.loads, np.array(state.held_force), state.history.pressing)


def history_of(loaded: LoadedChain, found: Equilibrium) -> ContactHistory:
    """What contact has to know of ``found`` in the next step."""
    contact = found.balance.contact
    pressing = contact.pressing(loaded.pairs)
    stiffness = loaded.surroundings.contact.stiffness * loaded.widths
    return ContactHistory(found.balance.positions, pressing.friction / stiffness, pressing)


def _frames(loaded: LoadedChain, found: Equilibrium) -> Reals:
    """Sections from the root's face to the tip's."""
    balance = found.balance
    return np.concatenate([[loaded.chain.root_frame], balance.configuration.frames, [balance.tip]])


def _contacts(loaded: LoadedChain, load: LoadPoint, found: Equilibrium) -> tuple[ContactPoint, ...]:
    """Points that objects press against, from root to tip."""
    balance, contact = found.balance, found.balance.contact
    places = loaded.contacts.places[contact.points]
    positions = balance.positions[contact.points] + load.object_shift
    return tuple(
        ContactPoint(
            place=float(places[each]),
            position=(float(positions[each, 0]), float(positions[each, 1])),
            force=(float(contact.force[each, 0]), float(contact.force[each, 1])),
            normal_force=float(contact.normal[each]),
            sticks=bool(contact.sticks[each]),
            object_index=int(contact.objects[each]),
        )
        for each in np.argsort(places, kind="stable")
    )
