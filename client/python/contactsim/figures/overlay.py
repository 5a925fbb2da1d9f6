"""Several runs over each other, and measured data over a run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Sequence

import pandas as pd

from ..comparing import compare
from .figure import Curve, Figure, FigureError, Mark, Panel, number_text
from .sources import source_of

if TYPE_CHECKING:
    from ..measured import SignalComparison
    from ..result import Result

_MOST_PANELS = 3  # Of runs over each other, and
_MOST_MEASURED = 4  # of measured data.
_MOST_PARAMETERS = 2  # In a key.


def overlay_figure(runs: Sequence[Result], channels: Sequence[str] = ()) -> Figure:
    """The same channels, by default the first contact forces, of several runs over each other: a panel
    for each channel, a colour for each run. The key names a run by what differs."""
    title = runs[0].scenario.title
    parameters = compare(*runs).parameters if len(runs) > 1 else pd.DataFrame()
    if len(parameters) == 1:
        title += f": {parameters.index[0]}"
    panels: list[Panel] = []
    for channel in channels or _contact_forces(runs[0]):
        for run in runs:
            if channel not in run.arrays:
                raise FigureError(f"{run.name} recorded no {channel}")
        panels.append(Panel("time [s]", _label(channel, runs[0].units[channel]), [
            Curve("" if panels else _key(parameters, run, place), place, run["time"], run[channel])
            for place, run in enumerate(runs)]))
    return Figure(title, panels, [source_of(run.job) for run in runs])


def measured_figure(comparison: SignalComparison, file: str) -> Figure:
    """Measured points over the run, in a window of their times and a tenth more; the first signals."""
    run, shift = comparison.result, comparison.shift_s
    low = min(signal.times.min() for signal in comparison.signals) + shift
    high = max(signal.times.max() for signal in comparison.signals) + shift
    margin = (high - low) / 10
    time = run["time"]
    near = (time >= low - margin) & (time <= high + margin)
    panels: list[Panel] = []
    for signal in comparison.signals[:_MOST_MEASURED]:
        keys = ("", "") if panels else (run.name, file)
        panels.append(Panel("time [s]", _label(signal.channel, signal.unit), [
            Curve(keys[0], 0, time[near], run[signal.channel][near]),
            Curve(keys[1], 1, signal.times + shift, signal.values, Mark.POINTS)]))
    return Figure(run.scenario.title, panels, [source_of(run.job)])


def _label(channel: str, unit: str) -> str:
    """`contact force of B1-B2 [N]`."""
    owner, _, quantity = channel.rpartition(".")
    return f"{quantity.replace('_', ' ')} of {owner} [{unit}]"


def _contact_forces(run: Result) -> list[str]:
    channels = [name for name in run.arrays if name.endswith(".contact_force")][:_MOST_PANELS]
    if not channels:
        raise FigureError(f"{run.name} recorded no contact force")
    return channels


def _key(parameters: pd.DataFrame, run: Result, place: int) -> str:
    """A run by the value of the one parameter in which the runs differ, which the title names; by a
    few parameters and its job; or by its job alone."""
    values = [_text(row[place]) for row in parameters.to_numpy()]
    if len(values) == 1:
        return values[0]
    named = zip(parameters.index[:_MOST_PARAMETERS], values)
    return ", ".join([run.name, *(f"{path} = {value}" for path, value in named)])


def _text(value: object) -> str:
    if value is None:
        return "not set"
    return number_text(value) if isinstance(value, float) else str(value)
