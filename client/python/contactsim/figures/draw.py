"""Draws figures with matplotlib. Data stay in SI units; axes show them in readable ones."""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING, Any, Iterable

import matplotlib
import matplotlib.figure
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from .axes import chosen_unit
from .coarse import parted
from .draw_coarse import draw_coarse, draw_stamp, keys
from .figure import Curve, Figure, Kind, Mark, Panel
from .look import Look
from .rows import draw_rows
from .scale import scale_axis, scale_log_axis
from .sources import caption, printable
from .words import WORDS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_MOST_KEYS = 10  # Above it, or above _FEW_KEYS in a column of a journal, dashed curves have one entry together.
_FEW_KEYS = 4
_MOST_LEVEL_LABELS = 4  # More are upright, or left out of a column, whose panels are too low for them.
_GREY = "#666666"


def drawn(figure: Figure, look: Look = Look()) -> matplotlib.figure.Figure:
    """The figure of matplotlib, to be saved within `matplotlib.rc_context(look.rc)`."""
    width, height = look.inches(len(figure.panels))
    keys = [Key(panel, figure.crowd, look, width) for panel in figure.panels]
    if not look.size:  # A long key takes nothing of the panels.
        height += sum(key.height for key in keys)
    page = matplotlib.figure.Figure(figsize=(width, height), layout="constrained")
    axes = page.subplots(len(figure.panels), 1, squeeze=False)[:, 0]
    for panel, ax, key in zip(figure.panels, axes, keys):
        draw_panel(panel, ax, look, key)
    add_title(page, figure.title, look)
    add_notes(page, figure.note, caption(figure.sources) if figure.sources else "", look)
    page.align_ylabels(list(axes))
    return page


def draw_panel(panel: Panel, ax: Axes, look: Look = Look(), key: Key | None = None) -> None:
    """Draws a panel on axes, with its key above them."""
    if panel.letter:
        ax.text(0.012, 0.97, panel.letter, transform=ax.transAxes, va="top", fontweight="bold", zorder=6,
                bbox={"facecolor": "white", "alpha": 0.8, "linewidth": 0, "pad": 1.5})
    if panel.kind is not Kind.LINES:
        draw_rows(panel, ax, look)
        draw_stamp(panel, ax)
        return
    if look.paper and len(panel.labels) > _MOST_LEVEL_LABELS:
        panel = dataclasses.replace(panel, labels=[])
    _draw_bands(panel, ax)
    for curve in _merged(part for curve in panel.curves if not _is_shaded(curve, look)
                         for part in parted(curve)):
        ax.plot(curve.x, curve.y, scalex=True, scaley=True, label=curve.label or "_", **look.line(curve))
    _draw_shaded([parted(curve)[0] for curve in panel.curves if _is_shaded(curve, look)], ax, look)
    draw_coarse(panel, ax, look)
    for y in panel.dotted:
        ax.axhline(y, color="0.4", linestyle=":", linewidth=1.0, zorder=1)
    _draw_labels(panel, ax)
    _scale(panel, ax, look)
    (key or Key(panel, 0, look, 8.0)).add_to(ax)


def add_title(page: matplotlib.figure.Figure, title: str, look: Look) -> None:
    """The title above all panels."""
    if look.title and not look.paper and title:
        page.suptitle(printable(title)).set_parse_math(False)


def add_notes(page: matplotlib.figure.Figure, note: str, origin: str, look: Look) -> None:
    """Below all panels: what marks mean, and where the figure comes from."""
    points = matplotlib.rcParams["font.size"]
    told = origin if look.provenance and not look.paper else ""
    said = note if look.provenance or not note.startswith("o start") else ""
    if not told and not said:
        return
    width, height = page.get_size_inches()
    line = 1.4 * 0.75 * points / 72 / height
    both = bool(told and said) and (len(told) + len(said)) * 0.4 * points / 72 > width
    for text, x, side, low in ((told, 0.99, "right", 0.2), (said, 0.01, "left", 1.2 if both else 0.2)):
        page.text(x, low * line, printable(text), ha=side, color=_GREY, fontsize=0.75 * points,
                  parse_math=False)
    bottom = (2.4 if both else 1.4) * line
    page.get_layout_engine().set(rect=(0, bottom, 1, 1 - bottom))


class Key:
    """The legend above a panel: named curves, then what faint and dashed curves and bands are."""

    def __init__(self, panel: Panel, crowd: int, look: Look, width: float) -> None:
        self._look = look
        named = [curve for curve in panel.curves
                 if curve.keyed and curve.label and panel.kind is Kind.LINES]
        full = len(named) > (_FEW_KEYS if look.paper else _MOST_KEYS)
        listed = [curve for curve in named if not (full and curve.mark is Mark.DASHED)]
        self._entries: list[tuple[Any, str]] = [
            (Line2D([], [], **look.line(curve)), curve.label) for curve in listed]
        faint = next((curve for curve in panel.curves if curve.is_faint), None)
        if crowd and named and faint:
            grey = dataclasses.replace(faint, shade=None)
            self._entries.append((Line2D([], [], **look.line(grey)), f"{crowd} smaller"))
        if full and panel.dashed:
            black = Curve("", 0 if look.paper else len(WORDS["palette"]) - 1, np.empty(0), np.empty(0), Mark.DASHED)
            self._entries.append((Line2D([], [], **look.line(black)), panel.dashed))
        if panel.bands and panel.band_label and not look.paper:
            self._entries.append((Patch(facecolor=WORDS["band"]), panel.band_label))
        if panel.kind is Kind.LINES:
            self._entries += keys(panel)
        points = look.rc["legend.fontsize"]
        longest = max((len(text) for _, text in self._entries), default=0)
        self.columns = max(1, int(0.88 * width * 72 / (points * (0.55 * longest + 4))))
        rows = math.ceil(len(self._entries) / self.columns)
        self.height = max(rows - 2, 0) * 1.6 * points / 72  #: Beyond two rows, in inches.

    def add_to(self, ax: Axes) -> None:
        """As many entries beside each other as there is room for."""
        if not self._entries:
            return
        handles, texts = zip(*self._entries)
        legend = ax.legend(handles, texts, loc="lower center", bbox_to_anchor=(0.5, 1.0),
                           ncols=min(self.columns, len(texts)), borderaxespad=0.2,
                           columnspacing=1.4, handlelength=2.2)
        for text in legend.get_texts():
            text.set_parse_math(False)


def _merged(curves: Iterable[Curve]) -> list[Curve]:
    """Curves that no reader tells apart as one, with gaps, because drawing each takes long. Faint
    ones lie behind the others."""
    groups: dict[Any, list[Curve]] = {}
    for place, curve in enumerate(curves):
        alone = curve.keyed and not curve.is_faint
        shade = -1 if curve.is_faint else curve.colour
        groups.setdefault((shade, curve.mark, place if alone else -1), []).append(curve)
    gap = [math.nan]
    return [Curve(group[0].label, group[0].colour,
                  np.concatenate([part for curve in group for part in (curve.x, gap)]),
                  np.concatenate([part for curve in group for part in (curve.y, gap)]),
                  group[0].mark, group[0].keyed) if len(group) > 1 else group[0]
            for group in groups.values()]


def _is_shaded(curve: Curve, look: Look) -> bool:
    """True for a faint line whose colour is its place."""
    return curve.mark is Mark.FAINT and look.shade_of(curve) is not None


def _draw_shaded(curves: list[Curve], ax: Axes, look: Look) -> None:
    """Draws all at once, because drawing each takes long."""
    if curves:
        ax.add_collection(LineCollection(
            [np.column_stack([curve.x, curve.y]) for curve in curves],
            colors=[look.shade_of(curve) for curve in curves], linewidths=0.5, zorder=1.5))


def _draw_bands(panel: Panel, ax: Axes) -> None:
    if panel.bands:
        shapes = [[(start, 0), (start, 1), (end, 1), (end, 0)] for start, end in panel.bands]
        ax.add_collection(PolyCollection(shapes, facecolors=WORDS["band"], linewidths=0, zorder=0,
                                         transform=ax.get_xaxis_transform()), autolim=False)


def _draw_labels(panel: Panel, ax: Axes) -> None:
    upright = len(panel.labels) > _MOST_LEVEL_LABELS
    for label in panel.labels:
        ax.annotate(label.text, (label.x, label.y), xytext=(0, 4), textcoords="offset points",
                    ha="center", va="bottom", rotation=90 if upright else 0, fontsize="small")


def _scale(panel: Panel, ax: Axes, look: Look) -> None:
    x = chosen_unit(panel.x_label, _largest(panel, "x", panel.log_x), panel.log_x, look.units)
    y = chosen_unit(panel.y_label, _largest(panel, "y", panel.log_y), panel.log_y, look.units)
    ax.margins(x=0.02)
    for axis, unit, log in ((ax.xaxis, x, panel.log_x), (ax.yaxis, y, panel.log_y)):
        if log:
            axis._set_axes_scale("log")
            scale_log_axis(axis, unit)
        else:
            scale_axis(axis, unit)
    _limit_log(panel, ax)
    if panel.counted_x:
        ax.xaxis.set_major_locator(MaxNLocator("auto", integer=True))
        known = np.concatenate([curve.x for curve in panel.curves])
        ax.set_xlim(known.min() - 0.5, known.max() + 0.5)
    if panel.x_words:
        ax.set_xticks(list(panel.x_words), list(panel.x_words.values()))
    if not panel.log_y:
        _limit_y(panel, ax)


def _limit_y(panel: Panel, ax: Axes) -> None:
    """Free space around the points, and above them for labels."""
    values = np.concatenate([[y for y in panel.dotted], *(curve.y for curve in panel.curves),
                             *(y for each in panel.ranges for y in (each.low, each.high))])
    values = values[np.isfinite(values)]
    low, high = (values.min(), values.max()) if len(values) else (-1.0, 1.0)
    span = high - low or abs(low) or 2.0
    above = 0.04 if not panel.labels else 0.4 if len(panel.labels) > _MOST_LEVEL_LABELS else 0.1
    low -= (0.04 if values.size and values.min() < values.max() else 0.5) * span
    high += (above if values.size and values.min() < values.max() else 0.5) * span
    ax.set_ylim(low if panel.lowest_y is None else panel.lowest_y, high)


def _limit_log(panel: Panel, ax: Axes) -> None:
    """Whole decades, where there are none between the numbers."""
    for log, axis, name in ((panel.log_x, ax.xaxis, "x"), (panel.log_y, ax.yaxis, "y")):
        values = np.concatenate([getattr(curve, name) for curve in panel.curves] or [np.empty(0)])
        values = values[values > 0]
        if log and len(values):
            low, high = math.floor(math.log10(values.min())), math.ceil(math.log10(values.max()))
            if high - low <= 2:
                axis.axes.set(**{f"{name}lim": (10.0**low, 10.0**max(high, low + 1))})


def _largest(panel: Panel, name: str, log: bool) -> float:
    """The largest absolute value on an axis; NaN without numbers."""
    ranges = [each.high for each in panel.ranges] if name == "y" else []
    values = np.concatenate([getattr(curve, name) for curve in panel.curves] + ranges
                            or [np.empty(0)])
    values = values[~np.isnan(values) & ((values > 0) | (not log))]
    return float(np.abs(values).max()) if len(values) else math.nan
