"""A metric of a sweep over one axis, as a line, or over two, as a map."""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING, Any, Sequence

import numpy as np

from ..labels import metric_label
from ..model import Array
from .figure import Curve, Figure, FigureError, Mark, Panel, Source
from .sources import source_of

if TYPE_CHECKING:
    from ..sweeping import SweepResult

MOST_CELLS = 10_000  #: Of a map.


@dataclasses.dataclass
class HeatMap:
    """A grid of cells: the first axis down, the second across."""

    title: str
    x_label: str
    y_label: str
    label: str  #: Of the metric.
    x_texts: Sequence[str]  #: The values of the axes in words.
    y_texts: Sequence[str]
    values: Array  #: By row and column; NaN where none is shown.
    words: Any  #: `CUT`, `no contact`, `failed`, `not converged`, or empty.
    log: bool
    counts: dict[str, int]  #: Of cells without a value, by why.
    sources: Sequence[Source]


def sweep_line(sweep: SweepResult, metric: str, log: bool = False) -> Figure:
    """One metric over one axis: a line through the cells in the order of their values, broken where a
    cell has no value that is known, with crosses where a cell did not converge."""
    axis = sweep.job.sweep.axes[0]
    order = np.argsort([cell.values[0] for cell in sweep.cells], kind="stable")
    x = np.array([sweep.cells[i].values[0] for i in order])
    values = _shown(sweep, metric, log)
    y = values[order]
    if np.isnan(y).all():
        raise FigureError(f"no cell of this sweep has a {metric} to show")
    missed = ~np.isnan(y) & (sweep.frame.convergence.to_numpy()[order] != "FULL")
    curves = [Curve(metric, 0, x, y, Mark.LINE_POINTS, False)]
    if missed.any():
        curves.append(Curve("not converged", 1, x[missed], y[missed], Mark.END, False))
    names = sweep.frame[sweep.axes[0]].to_numpy()[order]
    panel = Panel(sweep.axis_labels[0], metric_label(metric), curves, log_y=log,
                  log_x=axis.HasField("log"),
                  x_words={at: name for at, name in zip(x, names) if isinstance(name, str)})
    return Figure(sweep.job.sweep.base.title, [panel], [source_of(sweep.job)],
                  _note(_counts(sweep, metric, values), bool(missed.any())))


def require_map(sweep: SweepResult) -> None:
    """Raises FigureError unless the sweep can be drawn as a map."""
    grid = sweep.job.sweep.combination in (0, sweep.job.sweep.GRID)
    if not grid or len(sweep.axes) != 2 or not 0 < len(sweep.cells) <= MOST_CELLS:
        raise FigureError(f"a heat map is of a grid of two axes with at most {MOST_CELLS} cells")


def heat_map(sweep: SweepResult, metric: str, log: bool = False) -> HeatMap:
    """One metric over two axes."""
    require_map(sweep)
    rows, columns = (list(dict.fromkeys(cell.values[axis] for cell in sweep.cells))
                     for axis in (0, 1))
    shape = len(rows), len(columns)
    values, words = np.full(shape, math.nan), np.full(shape, "", dtype=object)
    shown = _shown(sweep, metric, log)
    for i, cell in enumerate(sweep.cells):
        at = rows.index(cell.values[0]), columns.index(cell.values[1])
        row = sweep.frame.iloc[i]
        values[at] = shown[i]
        words[at] = ("failed" if row.state == "FAILED" else sweep.unknown[metric].iloc[i]
                     or ("" if row.convergence == "FULL" else "not converged"))
    texts = [[sweep.value_text(axis, value) for value in of_axis]
             for axis, of_axis in enumerate((rows, columns))]
    return HeatMap(sweep.job.sweep.base.title, sweep.axis_labels[1], sweep.axis_labels[0],
                   metric_label(metric), texts[1], texts[0], values, words, log,
                   _counts(sweep, metric, shown), [source_of(sweep.job)])


def _shown(sweep: SweepResult, metric: str, log: bool) -> Array:
    """The value of each cell; NaN where the figure shows none."""
    if metric not in sweep.metrics:
        raise FigureError(f"the sweep has no metric {metric}, but {', '.join(sweep.metrics)}")
    values = sweep.frame[metric].to_numpy(float)
    with np.errstate(invalid="ignore"):
        return np.where(np.isfinite(values) & ((values > 0) | (not log)), values, math.nan)


def _counts(sweep: SweepResult, metric: str, shown: Array) -> dict[str, int]:
    """Of cells of which no value is shown."""
    failed = sweep.frame.state.to_numpy() == "FAILED"
    words = sweep.unknown[metric].to_numpy()
    other = np.isnan(shown) & ~failed & (words == "")
    finite = np.isfinite(sweep.frame[metric].to_numpy(float))
    return {"failed": int(failed.sum()), "CUT": int((~failed & (words == "CUT")).sum()),
            "no contact": int((~failed & (words == "no contact")).sum()),
            "<= 0": int((other & finite).sum()), "none": int((other & ~finite).sum())}


def _note(counts: dict[str, int], missed: bool) -> str:
    """What the line cannot show, and what its crosses are."""
    def cells(name: str, one: str, many: str) -> str:
        return f"{counts[name]} {one if counts[name] == 1 else many}" if counts[name] else ""
    return "; ".join(filter(None, [
        "× not converged" if missed else "", cells("failed", "cell failed", "cells failed"),
        cells("CUT", "cell CUT by the end", "cells CUT by the end"),
        cells("no contact", "cell without contact", "cells without contact"),
        cells("<= 0", "value <= 0 not shown", "values <= 0 not shown")]))
