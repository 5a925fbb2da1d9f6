"""The units in which axes show their numbers."""

from __future__ import annotations

import dataclasses
import math
from typing import Sequence

from .figure import FigureError, Panel
from .words import WORDS

_PREFIXES: dict[int, str] = {int(power): text for power, text in WORDS["prefixes"].items()}


@dataclasses.dataclass(frozen=True)
class AxisUnit:
    """What an axis shows as 1, in the unit of the values, and what the axis is called."""

    size: float
    label: str


def unit_of(label: str) -> str:
    """`s` of `time [s]`; empty without a unit."""
    return label[label.rindex("[") + 1:-1] if label.endswith("]") and "[" in label else ""


def readable_unit(label: str, largest: float) -> AxisUnit:
    """The unit in which the numbers of an axis, of which `largest` is the largest absolute one, have
    few digits: that of the label with a prefix of SI or, if it takes none, a power of ten. A label
    without a unit stays as it is."""
    unit, plain = unit_of(label), WORDS["plain"]
    if (not unit or not 0 < largest < math.inf or plain["least"] <= largest < plain["most"]):
        return AxisUnit(1.0, label)
    power = 3 * math.floor(math.log10(largest) / 3 + 1e-12)
    prefix = _PREFIXES.get(power, "")
    usual = power < 0 or _first(unit) not in WORDS["never_above_one"]
    if prefix and usual and _takes_prefix(unit):
        return _shown(label, power, prefix + unit)
    if plain["least_without_prefix"] <= largest < plain["most_without_prefix"]:
        return AxisUnit(1.0, label)
    return _shown(label, power, f"10^{power}" + (f" {unit}" if unit != "1" else ""))


def named_unit(label: str, unit: str) -> AxisUnit | None:
    """The axis in the unit that a user names, such as `mm` or `µm`, which may be written um, or `g`;
    None unless it is the unit of the label, with a prefix of SI or without, or one of the same."""
    base = unit_of(label)
    if not base:
        return None
    other = WORDS["other_units"].get(unit)
    if other is not None and other["of"] == base:
        return AxisUnit(other["size"], _renamed(label, unit))
    if unit == base:
        return AxisUnit(1.0, label)
    if not _takes_prefix(base):
        return None
    asked = ("µ" + base if unit == "u" + base else unit).replace("μ", "µ")
    return next((_shown(label, power, asked) for power, prefix in _PREFIXES.items()
                 if asked == prefix + base), None)


def require_units(panels: Sequence[Panel], units: Sequence[str]) -> None:
    """Raises FigureError for a unit that no axis can have."""
    labels = [label for panel in panels for label in (panel.x_label, panel.y_label)]
    for unit in units:
        if all(named_unit(label, unit) is None for label in labels):
            raise FigureError(f"--unit {unit}: no axis of this figure can have it")


def chosen_unit(label: str, largest: float, log: bool, named: Sequence[str]) -> AxisUnit:
    """The first of the named units that the axis can have, else the readable one; on a logarithmic
    axis that of the label, for its decades are powers of ten."""
    asked = [unit for unit in (named_unit(label, name) for name in named) if unit is not None]
    if asked:
        return asked[0]
    return AxisUnit(1.0, label) if log else readable_unit(label, largest)


def _first(unit: str) -> str:
    """The first symbol of a unit: `N` of `N/m`."""
    end = min((unit.find(c) for c in "/^*·" if c in unit), default=len(unit))
    return unit[:end]


def _takes_prefix(unit: str) -> bool:
    """True if a prefix before the unit is one of its first symbol, alone and not a power of it."""
    first = _first(unit)
    return first in WORDS["symbols"] and not unit.startswith(first + "^")


def _shown(label: str, power: int, unit: str) -> AxisUnit:
    return AxisUnit(10.0**power, _renamed(label, unit))


def _renamed(label: str, unit: str) -> str:
    return f"{label[:label.rindex('[')]}[{unit}]"
