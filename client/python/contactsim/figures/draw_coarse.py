"""Draws what samples are too rare for: points that no line joins, ranges that the ledger tells, a
stamp."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import matplotlib
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.patches import Patch

from .coarse import spread
from .figure import Curve, Panel
from .look import Look
from .words import WORDS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_INK = WORDS["map"]["failed"]
_HATCH: dict[str, Any] = {"hatch": "////", "facecolor": "none", "edgecolor": WORDS["faint"],
                          "linewidth": 0.0}


def draw_coarse(panel: Panel, ax: Axes, look: Look) -> None:
    """Ranges, each with a thin edge, for most are narrower than a pixel; hatches; and the stamp."""
    for each in panel.ranges + spread(panel):
        corners = [(each.start, each.low), (each.start, each.high), (each.end, each.high),
                   (each.end, each.low)]
        shapes = np.stack([np.column_stack(corner) for corner in corners], axis=1)
        ink = look.line(Curve("", each.colour, np.empty(0), np.empty(0)))["color"]
        ax.add_collection(PolyCollection(list(shapes), facecolors=ink, edgecolors=ink, alpha=0.3,
                                         linewidths=0.5, zorder=1.2), autolim=False)
    if panel.cut:
        spans = [[(start, 0), (start, 1), (end, 1), (end, 0)] for start, end in panel.cut]
        ax.add_collection(PolyCollection(spans, zorder=0.5, transform=ax.get_xaxis_transform(),
                                         **_HATCH), autolim=False)
    draw_stamp(panel, ax)


def draw_stamp(panel: Panel, ax: Axes) -> None:
    """In the figure, so that it goes wherever the figure goes; in print, too."""
    if panel.stamp:
        ax.text(0.99, 0.98, panel.stamp, transform=ax.transAxes, ha="right", va="top", color=_INK,
                fontsize=0.8 * matplotlib.rcParams["font.size"], zorder=5, gid="stamp",
                bbox={"facecolor": "white", "alpha": 0.8, "linewidth": 0, "pad": 1.5})


def keys(panel: Panel) -> list[tuple[Any, str]]:
    """Entries of the key for ranges and hatches."""
    entries: list[tuple[Any, str]] = []
    if panel.ranges:
        entries.append((Patch(facecolor="#808080", alpha=0.3), WORDS["coarse"]["range"]))
    if spread(panel):
        entries.append((Patch(facecolor="#808080", alpha=0.3), WORDS["coarse"]["spread"]))
    if panel.cut:
        entries.append((Patch(**_HATCH), WORDS["coarse"]["cut"]))
    return entries
