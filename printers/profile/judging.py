"""What a result means on a printer: its severity, as the table of rules and the profile say."""

from __future__ import annotations

from dataclasses import replace

from printers.profile.printer_profile import PrinterProfile
from printers.report import RuleResult
from printers.rule_table import RULES


def judged(result: RuleResult, profile: PrinterProfile) -> RuleResult:
    """The result with what the table says of its rule, and the severity that the profile sets.

    A rule may warn of less than what its severity is for; a profile that sets one means both.
    """
    severity = profile.severity(result.rule)
    decided = result.verdict == "fail" or (
        result.verdict == "warn" and result.rule in profile.rules
    )
    return replace(
        result,
        verdict=severity if decided else result.verdict,
        severity=severity,
        source=RULES[result.rule].source,
    )
