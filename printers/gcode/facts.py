"""What slicers say in comments on the whole print: who sliced, settings, filament and time."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

MOST_SETTINGS = 5_000
"""PrusaSlicer writes 300, OrcaSlicer 500."""

_SETTING = re.compile(r"([a-z][a-z0-9_]*)(?: =|:) ?(.*)")
_NAME, _VERSION = r"([\w-]{1,40})(?:\(\w\))?", r"(?:Version )?([\w.+-]{1,40})"
_SLICERS = (
    re.compile(rf"[Gg]enerated (?:by|with) {_NAME} {_VERSION}"),
    re.compile(rf"[Ss]liced (?:by|with) {_NAME} {_VERSION}"),
    re.compile(r"^(BambuStudio|OrcaSlicer) ([\w.+-]{1,40})$"),
)
_TIMES = (
    re.compile(r"^estimated printing time \(normal mode\) = (.+)"),
    re.compile(r"total estimated time: (.+)"),
    re.compile(r"^TIME:(\d+)"),
)
_LENGTHS = (
    (re.compile(r"^filament used \[mm\] = (.+)"), 1.0),
    (re.compile(r"^total filament length \[mm\] : (.+)"), 1.0),
    (re.compile(r"^Filament used: (.+)"), 1000.0),  # Cura, in metres
)
_SECONDS = {"d": 86400.0, "h": 3600.0, "m": 60.0, "s": 1.0}


@dataclass(eq=False)
class Facts:
    """Collected comment by comment; what no comment states is None."""

    slicer: str | None = None
    version: str | None = None
    time: float | None = None
    filament_length: float | None = None
    settings: dict[str, str] = field(default_factory=dict)

    def take(self, comment: bytes) -> None:
        """Take in one comment, without its semicolon."""
        text = comment.decode("utf-8", "replace").strip()
        setting = _SETTING.fullmatch(text)
        if setting is None:
            self._take_sentence(text[:300])
        elif len(self.settings) < MOST_SETTINGS and not setting[1].endswith("_config"):
            self.settings[setting[1]] = setting[2]

    def _take_sentence(self, text: str) -> None:
        if text == "FLAVOR:UltiGCode":
            self.settings["use_volumetric_e"] = "1"  # of Cura: E is a volume
        if self.slicer is None:
            found = next((found for form in _SLICERS if (found := form.search(text))), None)
            if found:
                self.slicer, self.version = found[1], found[2]
        for form in _TIMES:
            if self.time is None and (found := form.search(text)):
                self.time = _duration(found[1])
        for form, unit in _LENGTHS:
            if self.filament_length is None and (found := form.search(text)):
                self.filament_length = _sum(found[1], unit)

    def number(self, setting: str) -> float | None:
        """The first number of the setting, if it states a number."""
        found = re.match(r"\d+(?:\.\d*)?|\.\d+", self.settings.get(setting, ""))
        return float(found[0]) if found else None


def _duration(text: str) -> float | None:
    """Seconds: of `1d 4h 48m 51s`, or a plain number."""
    if text.isdigit():
        return float(text)
    parts = re.findall(r"(\d{1,9})\s*([dhms])", text)
    return sum(int(number) * _SECONDS[unit] for number, unit in parts) if parts else None


def _sum(text: str, unit: float) -> float | None:
    """mm: of one length for each extruder."""
    numbers = re.findall(r"\d{1,12}(?:\.\d+)?", text)
    return unit * sum(float(number) for number in numbers) if numbers else None
