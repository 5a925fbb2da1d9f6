"""Draws many curves over the same x: as a map with a row of colours for each, and as a waterfall."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import matplotlib
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import LogNorm, Normalize, SymLogNorm

from ..model import Array
from .axes import chosen_unit
from .figure import Kind, Panel
from .look import BY_PLACE, Look
from .picture import cells
from .scale import place_ticks, scale_axis, typeset

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_MOST = 1000  # Of columns and of rows: more are no more than pixels.
_MOST_LINES = 60  # Of a waterfall: more would be grey.
_HEIGHT = 2.0  # Of the largest value of a waterfall, in rows.


def draw_rows(panel: Panel, ax: Axes, look: Look) -> None:
    """Draws a panel that is a map or a waterfall."""
    if panel.kind is Kind.MAP:
        _draw_map(panel, ax, look)
    else:
        _draw_waterfall(panel, ax, look)
    span = float(np.abs(panel.curves[0].x).max())
    scale_axis(ax.xaxis, chosen_unit(panel.x_label, span, False, look.units))
    ax.set_xlim(panel.curves[0].x[0], panel.curves[0].x[-1])
    ax.grid(False)


def _draw_map(panel: Panel, ax: Axes, look: Look) -> None:
    picture = cells(panel, _MOST, _MOST)
    x, count = panel.curves[0].x, len(panel.curves)
    norm, colours = _scale_of(picture, panel.log_y)
    ax.set_ylabel(panel.row_label)
    image = ax.imshow(picture, norm=norm, cmap=colours, aspect="auto", origin="lower",
                      interpolation="nearest", extent=(x[0], x[-1], -0.5, count - 0.5))
    bar = ax.figure.colorbar(image, ax=ax)
    unit = chosen_unit(panel.y_label, float(np.abs(picture).max()), panel.log_y, look.units)
    bar.set_label(typeset(unit.label))
    if not panel.log_y:
        scale_axis(bar.ax.yaxis, unit)
    place_ticks(ax.yaxis, [curve.label for curve in panel.curves])


def _scale_of(picture: Array, log: bool) -> tuple[Any, str]:
    """From 0 to the largest value, or to both sides of 0 where some are below."""
    largest = float(np.abs(picture).max()) or 1.0
    both = bool((picture < 0).any())
    if log:
        least = float(np.abs(picture[picture != 0]).min()) if picture.any() else largest / 10
        least = max(least, 1e-6 * largest)
        if both:
            return SymLogNorm(least, vmin=-largest, vmax=largest, base=10), "RdBu_r"
        return LogNorm(min(least, 0.999 * largest), largest, clip=True), "viridis"
    return Normalize(-largest if both else 0.0, largest), "RdBu_r" if both else "viridis"


def _draw_waterfall(panel: Panel, ax: Axes, look: Look) -> None:
    """Lines of equal distance, coloured by their place; of many curves every n-th one."""
    step = math.ceil(len(panel.curves) / _MOST_LINES)
    places = range(0, len(panel.curves), step)
    largest = max(float(np.abs(panel.curves[i].y).max()) for i in places) or 1.0
    lines = [np.column_stack([panel.curves[i].x, i + _HEIGHT * step / largest * panel.curves[i].y])
             for i in places]
    shades = matplotlib.colormaps[BY_PLACE](np.linspace(0, 0.9, len(lines)))
    # From the top down, so that a line lies over the one behind it.
    ax.add_collection(LineCollection(lines[::-1], colors=shades[::-1], linewidths=0.9))
    low, high = (pick(float(line[:, 1].min() if pick is min else line[:, 1].max())
                      for line in lines) for pick in (min, max))
    ax.set_ylim(min(low, -0.5 * step) - 0.2 * step, high + 0.3 * step)
    unit = chosen_unit(panel.y_label, largest, False, look.units)
    name, _, end = unit.label.rpartition(" [")
    height = f"{largest / unit.size / _HEIGHT:.3g} {end.rstrip(']')}"
    ax.set_ylabel(f"{name}; a row is {typeset(height)}")
    place_ticks(ax.yaxis, [curve.label for curve in panel.curves])
