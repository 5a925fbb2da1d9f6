"""Figures in characters, for terminals."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..model import Array
from .axes import AxisUnit, chosen_unit
from .coarse import parted, spread
from .figure import Curve, Figure, FigureError, Kind, Mark, Panel, keep_largest
from .look import Look
from .picture import cells
from .sources import caption, printable

_MARKS = "*#$%@&="
_RANGE = ":"  # From the lowest to the highest where samples are too rare.
_SHADES = " .:-=+*#%@"  # Of a map, from 0 to the largest value.
_DASHED = 3  # From the character of a solid curve to that of a dashed one.
_ROWS = 24  # Of a figure with one panel.
_MOST_TICKS = 5  # Of y.
_MARGIN = 10  # For the numbers of y.


def text(figure: Figure, columns: int, look: Look = Look()) -> str:
    """The figure in lines of so many columns."""
    keep_largest(figure)
    rows = (_ROWS if len(figure.panels) == 1 else 34) // len(figure.panels)
    lines = [printable(figure.title)[:columns].center(columns).rstrip()] if look.title else []
    for panel in figure.panels:
        lines += (_panel(panel, columns, rows, look, figure.crowd) if panel.kind is Kind.LINES else
                  _rows(panel, columns, rows, look))
    lines += dict.fromkeys(f" {panel.stamp}" for panel in figure.panels if panel.stamp)
    if figure.note:
        lines.append(f" {figure.note}")
    if look.provenance and figure.sources:
        lines += ["", caption(figure.sources)]
    return "\n".join(lines) + "\n"


class _Axis:
    """Where numbers stand between the ends of an axis."""

    def __init__(self, values: Array, unit: AxisUnit, log: bool, cells: int) -> None:
        known = values[~np.isnan(values) & ((values > 0) | (not log))]
        ends = (float(known.min()), float(known.max())) if len(known) else (0.1, 1.0)
        self.unit, self._log, self._cells = unit, log, cells
        self.low, self.high = ends
        if self.low == self.high:
            space = abs(self.low) / 2 or 1.0
            self.low, self.high = (self.low / 10, self.low * 10) if log else (self.low - space,
                                                                              self.high + space)

    def place(self, values: Array) -> Array:
        """The cell of each value; NaN where it has none."""
        low, high = self.low, self.high
        with np.errstate(divide="ignore", invalid="ignore"):
            if self._log:
                part = np.log(np.where(values > 0, values, math.nan) / low) / math.log(high / low)
            else:
                part = (values - low) / (high - low)
        cells: Array = np.round(part * (self._cells - 1))
        return cells

    def number(self, value: float) -> str:
        """How the axis shows a value."""
        nothing = abs(value) < 1e-9 * (self.high - self.low) and not self._log
        return f"{0.0 if nothing else value / self.unit.size:.4g}"

    def ticks(self) -> dict[int, str]:
        """Some round numbers and their cells."""
        if self._log:
            powers = np.arange(math.ceil(math.log10(self.low)), math.log10(self.high) + 1e-9)
            values = 10.0**powers[::max(len(powers) // _MOST_TICKS, 1)]
        else:
            least = (self.high - self.low) / _MOST_TICKS
            decade = 10.0**math.floor(math.log10(least))
            step = next(part * decade for part in (1, 2, 5, 10) if part * decade >= least)
            values = np.arange(math.ceil(self.low / step), self.high / step + 1e-9) * step
        return {int(cell): self.number(value) for cell, value in zip(self.place(values), values)}


def _panel(panel: Panel, columns: int, rows: int, look: Look, crowd: int) -> list[str]:
    curves = [curve for curve in panel.curves if not curve.is_faint]
    width, height = columns - _MARGIN - 2, max(rows - 5, 6)
    axes = []
    for name, label, log, cells in (("x", panel.x_label, panel.log_x, width),
                                    ("y", panel.y_label, panel.log_y, height)):
        values = np.concatenate([getattr(curve, name) for curve in curves])
        largest = np.nanmax(np.abs(values)) if np.isfinite(values).any() else math.nan
        axes.append(_Axis(values, chosen_unit(label, float(largest), log, look.units), log, cells))
    x, y = axes
    canvas = np.full((height, width), " ")
    for each in panel.ranges + spread(panel):
        _shade(canvas, x.place(np.stack([each.start, each.end])), y.place(np.stack([each.low, each.high])))
    parts = [part for curve in curves for part in parted(curve)]
    for curve in sorted(parts, key=lambda curve: curve.is_mark):
        _draw(canvas, x.place(curve.x), y.place(curve.y), curve)
    letter = f"{panel.letter} " if panel.letter else ""
    top = f"+- {letter}{y.unit.label} ".ljust(width + 1, "-") + "+"
    ticks = {height - 1 - cell: number for cell, number in y.ticks().items()}
    ranged = bool(panel.ranges or spread(panel))
    lines = _key(curves, columns, crowd, ranged) + [" " * _MARGIN + top[:width + 2]]
    lines += [f"{ticks.get(i, ''):>{_MARGIN - 1}} |{''.join(row)}|" for i, row in enumerate(canvas)]
    lines.append(" " * _MARGIN + "+" + "-" * width + "+")
    left, right = x.number(x.low), x.number(x.high)
    below = left + x.unit.label.center(width + 2 - len(left) - len(right)) + right
    return [line.rstrip() for line in [*lines, " " * _MARGIN + below]]


def _rows(panel: Panel, columns: int, rows: int, look: Look) -> list[str]:
    """Sizes of many curves, some of them named."""
    if panel.log_y:
        raise FigureError("--log: characters show maps from 0 on")
    width, curves = columns - _MARGIN - 2, panel.curves
    picture = np.abs(cells(panel, width, max(rows - 5, 6)))
    largest = float(picture.max())
    unit = chosen_unit(panel.y_label, largest, False, look.units)
    shades = np.array(list(_SHADES))[
        np.ceil(picture / (largest or 1.0) * (len(_SHADES) - 1)).astype(int)]
    shades = np.repeat(shades, math.ceil(width / shades.shape[1]), axis=1)[:, :width]
    x = _Axis(curves[0].x, chosen_unit(panel.x_label, float(np.abs(curves[0].x).max()), False,
                                       look.units), False, width)
    names = [curves[-(-i * len(curves) // len(shades))].label for i in range(len(shades))]
    left, right = x.number(x.low), x.number(x.high)
    top = f"+- {unit.label} ".ljust(width + 1, "-") + "+"
    ramp = f"'{_SHADES}' from 0 to {largest / unit.size:.4g}"
    lines = [ramp.center(columns), " " * _MARGIN + top[:width + 2]]
    lines += [f"{printable(name)[:_MARGIN - 1]:>{_MARGIN - 1}} |{''.join(row)}|"
              for name, row in zip(names[::-1], shades[::-1])]
    below = left + x.unit.label.center(width + 2 - len(left) - len(right)) + right
    return [line.rstrip() for line in [
        *lines, " " * _MARGIN + "+" + "-" * width + "+", " " * _MARGIN + below]]


def _character(curve: Curve) -> str:
    if curve.mark is Mark.START:
        return "o"
    if curve.mark is Mark.END:
        return "×"
    if curve.mark is Mark.POINTS:
        return "+"
    dashed = curve.mark in (Mark.DASHED, Mark.DOTTED)
    return _MARKS[(curve.colour + (_DASHED if dashed else 0)) % len(_MARKS)]


def _draw(canvas: Any, columns: Array, rows: Array, curve: Curve) -> None:
    """Points, and what joins them."""
    mark, points = _character(curve), (columns, rows)
    if not curve.is_mark and curve.mark not in (Mark.POINTS, Mark.RARE) and len(columns) > 1:
        steps = np.maximum(np.abs(np.diff(columns)), np.abs(np.diff(rows)))
        parts = [np.linspace(0, 1, int(n) + 1) if n > 0 else np.zeros(1)
                 for n in np.nan_to_num(steps)]
        joined = [(columns[i] + p * (columns[i + 1] - columns[i]),
                   rows[i] + p * (rows[i + 1] - rows[i])) for i, p in enumerate(parts)]
        columns = np.concatenate([*(c for c, _ in joined), columns[-1:]])
        rows = np.concatenate([*(r for _, r in joined), rows[-1:]])
    _put(canvas, columns, rows, mark)
    if curve.mark is Mark.LINE_POINTS:
        _put(canvas, *points, "o")


def _shade(canvas: Any, columns: Array, rows: Array) -> None:
    """Boxes from the first to the second of columns and rows, as far as they are on the canvas."""
    for left, right, low, high in np.nan_to_num(np.concatenate([columns, rows]).T).astype(int):
        top = len(canvas) - max(high, 0)
        canvas[max(top - 1, 0):len(canvas) - max(low, 0), max(left, 0):max(right, 0) + 1] = _RANGE


def _put(canvas: Any, columns: Array, rows: Array, mark: str) -> None:
    """The mark at each point that is known."""
    known = ~(np.isnan(columns) | np.isnan(rows))
    places = np.round(rows[known]).astype(int), np.round(columns[known]).astype(int)
    canvas[len(canvas) - 1 - places[0], places[1]] = mark


def _key(curves: list[Curve], columns: int, crowd: int, ranged: bool) -> list[str]:
    """What each character is, as many entries in a line as there is room for."""
    entries = [f"{curve.label} {_character(curve) * 6}" for curve in curves
               if curve.keyed and curve.label]
    if crowd and entries:
        entries.append(f"{crowd} smaller: not shown")
    if ranged:
        entries.append(f"range where samples are too rare {_RANGE * 6}")
    lines = [""]
    for entry in entries:
        line = f"{lines[-1]}   {entry}" if lines[-1] else entry
        if len(line) <= columns or not lines[-1]:
            lines[-1] = line
        else:
            lines.append(entry)
    return [line.center(columns).rstrip() for line in lines if line]
