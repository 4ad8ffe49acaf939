"""Records of a printer, of the filament in it, and of the slicer's settings that go with both."""

from printers.profile.filament import Filament
from printers.profile.printer_profile import PrinterProfile
from printers.profile.slicer_advice import SlicerAdvice

__all__ = ["Filament", "PrinterProfile", "SlicerAdvice"]
