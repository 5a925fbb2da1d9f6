"""Draws heat maps with matplotlib."""

from __future__ import annotations

import math
import pathlib
from typing import TYPE_CHECKING, Any

import matplotlib.figure
import numpy as np
from matplotlib.colors import LogNorm, Normalize
from matplotlib.patches import Patch, Rectangle
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator

from .draw import add_notes, add_title
from .figure import FigureError
from .files import PathLike, drawing, page_file
from .look import Look
from .scale import place_ticks, typeset
from .sources import caption
from .sweeps import HeatMap
from .words import WORDS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FORMATS = {".svg": "svg", ".png": "png", ".pdf": "pdf", ".eps": "eps", ".pgf": "pgf"}
_MOST_NUMBERS = 100  # More would not be legible in their cells.
_LEVELS = 7


def save_map(map_: HeatMap, path: PathLike, contours: bool = False, look: Look = Look()) -> None:
    """Draws a map to a file in the format of its ending, svg without ending. With `contours` it has
    lines of equal value between the cells that converged."""
    ending = pathlib.Path(path).suffix.lower()
    if ending and ending not in FORMATS:
        raise FigureError(f"{path}: a heat map is drawn as svg, png, pdf, eps or pgf")
    with drawing(look):
        page = matplotlib.figure.Figure(figsize=look.inches(1), layout="constrained")
        ax = page.subplots()
        draw_map(map_, ax, contours)
        add_title(page, map_.title, look)
        add_notes(page, _legend(map_), caption(map_.sources), look)
        data = page_file(page, FORMATS.get(ending, "svg"), map_.title, map_.sources)
    pathlib.Path(path).write_bytes(data)


def draw_map(map_: HeatMap, ax: Axes, contours: bool = False) -> None:
    """Cells that did not converge are hatched, cells that failed are crossed, cells whose value the end
    of the run cuts are grey with a bar, cells without its contact light grey."""
    ax.grid(False)
    rows, columns = map_.values.shape
    norm = _norm(map_)
    # Shapes keep the map a vector drawing, where an image would embed a bitmap.
    mesh = ax.pcolormesh(np.arange(columns + 1) - 0.5, np.arange(rows + 1) - 0.5,
                         map_.values, norm=norm, cmap="viridis",
                         edgecolors="face", linewidth=0.3)
    ax.set(xlim=(-0.5, columns - 0.5), ylim=(rows - 0.5, -0.5), xlabel=typeset(map_.x_label),
           ylabel=typeset(map_.y_label))
    bar = ax.figure.colorbar(mesh, ax=ax, label=typeset(map_.label))
    bar.solids.set(rasterized=False, edgecolor="face")
    known = map_.values[np.isfinite(map_.values)]
    if not map_.log and len(known) and (known == np.round(known)).all():
        bar.ax.yaxis.set_major_locator(MaxNLocator("auto", integer=True))
    place_ticks(ax.xaxis, map_.x_texts, 64 // (max(map(len, map_.x_texts)) + 2))
    place_ticks(ax.yaxis, map_.y_texts)
    for (y, x), word in np.ndenumerate(map_.words):
        if word:
            _cover(ax, x, y, word, norm(map_.values[y, x]) if np.isfinite(map_.values[y, x]) else 1)
    varies = len(known) and known.min() < known.max() and rows > 1 and columns > 1
    if contours and varies:
        _contours(map_, ax)
    elif map_.values.size <= _MOST_NUMBERS:
        for (y, x), value in np.ndenumerate(map_.values):
            if np.isfinite(value):
                ax.text(x, y, f"{value:.4g}", ha="center", va="center", fontsize="small",
                        color="white" if norm(value) < 0.5 else "black")


def add_legend(map_: HeatMap, ax: Axes) -> None:
    """What grey cells are, above the map."""
    colours = {"CUT": WORDS["map"]["cut"], "no contact": WORDS["map"]["no_contact"]}
    shown = [word for word in dict.fromkeys(map_.words.flat) if word in colours]
    if shown:
        ax.legend([Patch(facecolor=colours[word]) for word in shown], shown, loc="lower right",
                  bbox_to_anchor=(1, 1), ncols=len(shown), frameon=False)


def _norm(map_: HeatMap) -> Any:
    """From the least to the largest value, wider where there is one or none."""
    known = map_.values[np.isfinite(map_.values)]
    low, high = (known.min(), known.max()) if len(known) else (1.0, 1.0)
    if low == high:
        space = max(abs(low) / 2, 0.5)
        low, high = (low / 2, low * 2) if map_.log else (low - space, low + space)
    return LogNorm(low, high) if map_.log else Normalize(low, high)


def _cover(ax: Axes, x: int, y: int, word: str, height: float) -> None:
    """What lies over a cell."""
    cell: dict[str, Any] = {"xy": (x - 0.5, y - 0.5), "width": 1, "height": 1, "linewidth": 0}
    if word == "not converged":
        ax.add_patch(Rectangle(**cell, fill=False, hatch="///",
                               edgecolor="white" if height < 0.5 else "black"))
        return
    colours = WORDS["map"]
    if word != "failed":  # Which has no value, and so no colour.
        face = colours["cut" if word == "CUT" else "no_contact"]
        ax.add_patch(Rectangle(**cell, facecolor=face, zorder=2))
    if word == "failed":
        for ends in ((y - 0.5, y + 0.5), (y + 0.5, y - 0.5)):
            ax.plot((x - 0.5, x + 0.5), ends, color=colours["failed"], linewidth=1.5)
    elif word == "CUT":
        ax.plot((x, x), (y - 0.5, y + 0.5), color="black", linewidth=1.5)


def _contours(map_: HeatMap, ax: Axes) -> None:
    """White on both sides of each line, so that it is seen on every colour."""
    values = np.where(map_.words == "", map_.values, math.nan)
    known = values[np.isfinite(values)]
    if not len(known):
        return
    levels = _levels(float(known.min()), float(known.max()), map_.log)
    blocks = np.isfinite(values)
    if not levels or not (blocks[1:, 1:] & blocks[:-1, 1:] & blocks[1:, :-1]
                          & blocks[:-1, :-1]).any():
        return  # No line lies between four cells that converged.
    lines = ax.contour(values, levels=levels, colors="black", linewidths=1.0)
    for part in lines.collections:
        part.set_path_effects([withStroke(linewidth=2.5, foreground="white")])
    for text in ax.clabel(lines, fmt="%.4g", fontsize="small"):
        text.set_path_effects([withStroke(linewidth=2.5, foreground="white")])


def _levels(low: float, high: float, log: bool) -> list[float]:
    """Round numbers within the scale: on a logarithmic one 1, 2 and 5 of each decade, and only 1 of
    each over more than four decades."""
    decades = math.log10(high / low) if log else 0.0
    if decades < 1:
        levels = MaxNLocator(_LEVELS, steps=[1, 2, 5, 10]).tick_values(low, high)
    else:
        parts = (1, 2, 5) if decades <= 4 else (1,)
        powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
        levels = np.array([part * 10.0**power for power in powers for part in parts])
    return [float(level) for level in levels if low <= level <= high]


def _legend(map_: HeatMap) -> str:
    counts = map_.counts
    white = [f"{counts['<= 0']} value{'s' * (counts['<= 0'] != 1)} <= 0"] if counts["<= 0"] else []
    white += [f"{counts['none']} without value"] if counts["none"] else []
    return "; ".join(filter(None, [
        "hatched: not converged", "crossed: failed",
        "grey with a bar: CUT by the end" if counts["CUT"] else "",
        "light grey: no contact" if counts["no contact"] else "",
        f"white: {', '.join(white)}" if white else ""]))
