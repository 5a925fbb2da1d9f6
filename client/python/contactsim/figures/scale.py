"""What stands at axes: names with raised exponents, and numbers in readable units."""

from __future__ import annotations

import math
import re
from typing import Any, Sequence

import numpy as np
from matplotlib.ticker import (FuncFormatter, LogFormatterSciNotation, LogLocator, NullLocator,
                               ScalarFormatter)

from .axes import AxisUnit

_RAISED = str.maketrans("0123456789+-n/.", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻ⁿᐟ·")


def typeset(label: str) -> str:
    """With raised exponents and lowered indices, for matplotlib."""
    raised = re.sub(r"\^(?:\(([-+n0-9./]+)\)|(-?[0-9n.]+))",
                    lambda found: (found[1] or found[2]).translate(_RAISED), label)
    return re.sub(r"\b([A-Z])_([a-z])\b", r"\1$_\\mathrm{\2}$", raised.replace("$", r"\$"))


class _Scaled(ScalarFormatter):  # type: ignore[misc]  # matplotlib has no types.
    """Numbers in a unit of so many units of the data."""

    def __init__(self, size: float) -> None:
        super().__init__(useOffset=False)
        self.set_scientific(False)
        self.size = size

    def set_locs(self, locs: Any) -> None:
        super().set_locs(np.asarray(locs) / self.size)

    def __call__(self, x: float, pos: int | None = None) -> str:
        text: str = super().__call__(x / self.size, pos)
        return text


def scale_axis(axis: Any, unit: AxisUnit) -> None:
    """Shows a linear axis in a unit."""
    axis.set_label_text(typeset(unit.label))
    axis.set_major_formatter(_Scaled(unit.size))


def scale_log_axis(axis: Any, unit: AxisUnit) -> None:
    """Shows the decades of a logarithmic axis."""
    axis.set_label_text(typeset(unit.label))
    axis.set_major_locator(LogLocator(numticks=9))
    if unit.size == 1:
        axis.set_major_formatter(LogFormatterSciNotation())
    else:
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value / unit.size:g}"))
    axis.set_minor_locator(NullLocator())


def place_ticks(axis: Any, texts: Sequence[str], most: int = 20) -> None:
    """Texts at 0, 1, 2 and so on: every n-th of them, n round, where there is no room for all."""
    least = math.ceil(len(texts) / max(most, 1))
    step = next(part * 10**power for power in range(9) for part in (1, 2, 5)
                if part * 10**power >= least)
    axis.set_ticks(range(0, len(texts), step), texts[::step])
    axis.set_tick_params(direction="out", top=False, right=False)
