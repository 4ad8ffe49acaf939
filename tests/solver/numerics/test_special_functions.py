"""Quotients of elementary functions against closed forms of many digits."""

from __future__ import annotations

from decimal import Decimal, getcontext

import pytest

from solver.numerics.special_functions import phi1, phi2, sinhc, x_coth_x

getcontext().prec = 50


@pytest.mark.parametrize("x", ["-3", "-0.5", "-0.49", "-1e-9", "1e-300", "1e-5", "0.3", "0.5", "4"])
def test_helper_functions_hold_full_precision(x: str) -> None:
    exact, number = Decimal(x), float(x)
    if abs(exact) > Decimal("1e-20"):
        e = exact.exp()
        assert phi1(number) == pytest.approx(float((e - 1) / exact), rel=4e-16)
        assert phi2(number) == pytest.approx(float((e - 1 - exact) / exact**2), rel=1e-15)
        assert sinhc(number) == pytest.approx(float((e - 1 / e) / 2 / exact), rel=4e-16)
        coth = (e + 1 / e) / (e - 1 / e)
        assert x_coth_x(number) == pytest.approx(float(exact * coth), rel=4e-16)
    else:
        assert (phi1(number), phi2(number)) == (1.0, 0.5)
        assert (sinhc(number), x_coth_x(number)) == (1.0, 1.0)
