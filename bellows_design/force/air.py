"""The air of a stroke: how much a compressor gives for it, and how long a valve takes."""

from __future__ import annotations

from dataclasses import dataclass

from bellows_design.design.conditions import ATMOSPHERE

FREE_PRESSURE = 0.1
"""MPa absolute, 1 bar: the pressure at which free air is counted."""

FLOW = 10.0
"""L/min of free air: an assumed small valve, as none is known."""

CUBIC_MM = 1e6
"""mm³ in a litre."""


@dataclass(frozen=True)
class Air:
    """The air that one stroke takes, from rest to a pressure.

    Attributes:
        volume_at_rest_mm3: Inside the unloaded finger.
        volume_mm3: Inside the finger under pressure and load.
        free_litres: Air that enters, at 1 bar absolute and the temperature in the finger; negative
            where a vacuum takes it out.
        flow_litres_per_minute: Constant flow of free air through the valve.
    """

    volume_at_rest_mm3: float
    volume_mm3: float
    free_litres: float
    flow_litres_per_minute: float

    @property
    def volume_change_mm3(self) -> float:
        """Growth of the cavity."""
        return self.volume_mm3 - self.volume_at_rest_mm3

    @property
    def seconds(self) -> float:
        """Time that the valve takes at its constant flow, s."""
        return 60 * abs(self.free_litres) / self.flow_litres_per_minute

    def to_dict(self) -> dict[str, float]:
        """Plain values for JSON."""
        return {
            "volume_at_rest_mm3": self.volume_at_rest_mm3,
            "volume_mm3": self.volume_mm3,
            "volume_change_mm3": self.volume_change_mm3,
            "free_litres": self.free_litres,
            "flow_litres_per_minute": self.flow_litres_per_minute,
            "fill_seconds": self.seconds,
        }


def air_of_stroke(at_rest: float, volume: float, pressure: float, flow: float = FLOW) -> Air:
    """The air of one stroke, as an ideal gas at constant temperature.

    Args:
        at_rest: Air inside the unloaded finger, which is at the standard atmosphere, mm³.
        volume: Air inside under pressure, mm³.
        pressure: Over the atmosphere, MPa; negative for a vacuum.
        flow: Of free air through the valve, L/min.
    """
    inside = volume * (ATMOSPHERE + pressure) - at_rest * ATMOSPHERE
    return Air(at_rest, volume, inside / FREE_PRESSURE / CUBIC_MM, flow)
