"""Many curves over the same x as a picture: a row for each."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ..model import Array
from .figure import Panel


def cells(panel: Panel, columns: int, rows: int) -> Array:
    """The values of a panel in at most so many columns and rows, those of the first curve in row 0. Of
    all values that fall into a cell it has the one with the largest size, so that no peak is lost;
    between samples a curve is straight."""
    x = panel.curves[0].x
    values = np.array([curve.y for curve in panel.curves])
    edges = np.linspace(x[0], x[-1], min(columns, len(x)) + 1)[:-1]
    places = np.concatenate([edges, x])
    order = np.argsort(places, kind="stable")
    values = np.column_stack([_between(x, values, edges), values])[:, order]
    values = _largest(values, np.searchsorted(places[order], edges), 1)
    count = min(rows, len(values))
    return _largest(values, np.arange(count) * len(values) // count, 0)


def _between(x: Array, values: Array, places: Array) -> Array:
    """The values of each row at these places of the axis."""
    i = np.clip(np.searchsorted(x, places), 1, len(x) - 1)
    step = x[i] - x[i - 1]
    part = np.divide(places - x[i - 1], step, out=np.ones_like(step), where=step > 0)
    between: Array = values[:, i - 1] + part * (values[:, i] - values[:, i - 1])
    return between


def _largest(values: Array, starts: npt.NDArray[np.signedinteger[Any]], axis: int) -> Array:
    """Of each group along an axis the value with the largest size."""
    high = np.maximum.reduceat(values, starts, axis=axis)
    low = np.minimum.reduceat(values, starts, axis=axis)
    largest: Array = np.where(high >= -low, high, low)
    return largest
