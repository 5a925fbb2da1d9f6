"""A run beside measured data: the same comparison as `contactctl compare JOB measured.csv`."""

from __future__ import annotations

import dataclasses
import difflib
import functools
import html
import os
import re
from typing import TYPE_CHECKING, Any, Callable, Mapping, Union

import numpy as np
import pandas as pd

from .model import Array
from .tables import Table, is_time_name
from .units import factor, in_si

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .result import Result

#: A DataFrame, or a CSV file, with times and the channels that were measured.
MeasuredLike = Union[pd.DataFrame, str, "os.PathLike[str]"]

_SHIFTS = 1001  # That are looked at before the best one is refined.
_MOST_POINTS = 4000  # Of a signal, for that.
_HEADER = re.compile(r"(?P<name>.*\S)\s*[\[(]\s*(?P<unit>[^\[\]()]*?)\s*[\])]")


@dataclasses.dataclass(frozen=True)
class Signal:
    """Measured values of one channel, in SI; all finite."""

    channel: str
    unit: str
    times: Array  #: By the clock of the measurement.
    values: Array


@dataclasses.dataclass(frozen=True)
class SignalComparison:
    """Measured signals beside those of a run. True if all are within their tolerance."""

    result: Result
    signals: list[Signal]
    shift_s: float  #: Simulated time minus measured time.
    #: A row a signal: `unit`, `points`, `outside` of the run, `rms`, `largest` deviation, measured
    #: minus simulated, its `largest_time`, `measured_peak`, `simulated_peak`, what is `allowed`,
    #: and `holds`. In SI.
    table: pd.DataFrame

    def __bool__(self) -> bool:
        return bool(self.table.holds.all())

    def plot(self, ax: Any = None) -> Any:
        """Measured points over simulated lines, one Axes a signal."""
        import matplotlib.pyplot as plt  # Only who plots needs matplotlib.

        if ax is None:
            ax = plt.subplots(len(self.signals), 1, sharex=True, layout="constrained")[1]
        axes: list[Axes] = list(np.ravel(ax))
        for signal, each in zip(self.signals, axes):
            times = signal.times + self.shift_s
            margin = 0.1 * (times.max() - times.min())
            every = self.result["time"]
            near = (every >= times.min() - margin) & (every <= times.max() + margin)
            each.plot(every[near], self.result[signal.channel][near], label="simulated")
            each.plot(times, signal.values, ".", markersize=3, label="measured")
            each.set(xlabel="time [s]", ylabel=f"{signal.channel} [{signal.unit}]")
        axes[0].legend(fontsize="small")
        return ax

    def _repr_html_(self) -> str:
        verdict = "within tolerance" if self else "not within tolerance"
        return (f"<p><b>{html.escape(self.result.name)} is {verdict}</b>, simulated time = "
                f"measured time {self.shift_s:+.6g} s</p>{self.table.to_html()}")


def compare_measured(result: Result, measured: MeasuredLike, *,
                     map: Mapping[str, str] | None = None, abs_tol: float = 0.0,
                     rel_tol: float = 0.05, tolerances: Mapping[str, float] | None = None,
                     shift_s: float = 0.0,
                     fit_shift_s: tuple[float, float] | None = None) -> SignalComparison:
    """A run beside measured data.

    Columns are channels with their units, such as `B1.velocity [mm/s]`; `map` has the channel of
    other headers, with a unit if the header has none. Times are in the column, or the index, `time`
    or `t`. A signal may be `max(abs_tol, rel_tol · |peak|)` from the run, or what `tolerances`
    says for its channel, in SI. Simulated time is measured time plus `shift_s`, or plus the shift
    of least squares in the range `fit_shift_s`. Columns that are no channels are left out. Raises
    ValueError for what does not fit.
    """
    signals = _signals(result, _columns(measured), map or {})
    shift = _fit(result, signals, fit_shift_s) if fit_shift_s else shift_s
    rows = []
    for signal in signals:
        own = (tolerances or {}).get(signal.channel)
        rows.append(_row(result, signal, shift, abs_tol if own is None else own,
                         rel_tol if own is None else 0.0))
    table = pd.DataFrame(rows, index=pd.Index([s.channel for s in signals], name="signal"))
    return SignalComparison(result, signals, shift, table)


def _columns(measured: MeasuredLike) -> dict[str, Callable[[], Array]]:
    """The columns of the data by their headers, those of times with them, read when they are used."""
    if not isinstance(measured, pd.DataFrame):
        table = Table(measured)
        headers = [c.header if c.header.endswith((")", "]")) or not c.unit else
                   f"{c.name} [{c.unit}]" for c in table.columns]
        return {header: functools.partial(table.numbers, i, True)
                for i, header in enumerate(headers)}
    frame = measured if measured.index.name is None else measured.reset_index()
    return {str(header): functools.partial(frame[header].to_numpy, float, na_value=np.nan)
            for header in frame.columns}


def _meaning(header: str, map_: Mapping[str, str]) -> tuple[str, str]:
    """The channel of a column and its unit; the unit is empty if nothing tells it."""
    found = _HEADER.fullmatch(header)
    name, unit = (found["name"], found["unit"]) if found else (header.strip(), "")
    mapped = map_.get(header, map_.get(name))
    if mapped is None:
        return name, unit
    target = _HEADER.fullmatch(mapped)
    return (target["name"], target["unit"]) if target else (mapped, unit)


def _factor(header: str, unit: str, si: str) -> float:
    if not unit:
        last = _HEADER.sub(r"\g<name>", header).rpartition("_")
        return (factor(last[2], si) if last[1] else None) or 1.0
    found = factor(unit, si)
    if found is None:
        raise ValueError(f"column '{header}': '{unit}' is no unit of a quantity in {si}")
    return found


def _signals(result: Result, given: dict[str, Callable[[], Array]],
             map_: Mapping[str, str]) -> list[Signal]:
    meanings = {header: _meaning(header, map_) for header in given}
    channels = {header: _channel(result, name) for header, (name, _) in meanings.items()}
    columns = {header: numbers() for header, numbers in given.items()
               if is_time_name(meanings[header][0]) or channels[header]}
    clock = next((header for header in columns if is_time_name(meanings[header][0])), None)
    if clock is None:
        raise ValueError(f"there is no column time among {', '.join(meanings)}; "
                         "map={HEADER: 'time'} names it")
    times = in_si(columns[clock], _factor(clock, meanings[clock][1], "s"))
    signals = []
    for header in columns:
        channel = channels[header]
        if header == clock or channel is None:
            continue
        unit = result.units[channel]
        values = in_si(columns[header], _factor(header, meanings[header][1], unit))
        good = np.isfinite(times) & np.isfinite(values)
        signals.append(Signal(channel, unit, times[good], values[good]))
    _require_channels(result, map_)
    if not signals:
        raise ValueError(f"no column of {', '.join(meanings)} is a channel; "
                         "map={HEADER: CHANNEL} joins them; channels are "
                         + ", ".join(result.units))
    return signals


def _require_channels(result: Result, map_: Mapping[str, str]) -> None:
    for mapped in map_.values():
        name = _meaning(mapped, {})[0]
        if not is_time_name(name) and _channel(result, name) is None:
            near = difflib.get_close_matches(name, result.units, 1)
            hint = f"did you mean {near[0]!r}?" if near else ", ".join(result.units)
            raise ValueError(f"{result.name} has no channel {name!r}; {hint}")


def _channel(result: Result, name: str) -> str | None:
    """The channel of this name; `X.force` is `X.contact_force`."""
    if name in result.units:
        return name if name != "time" else None
    longer = name.removesuffix(".force") + ".contact_force" if name.endswith(".force") else ""
    return longer if longer in result.units else None


def _simulated(result: Result, signal: Signal, shift: float) -> Array:
    """The run at the times of a signal; NaN outside of it."""
    found: Array = np.interp(signal.times + shift, result["time"], result[signal.channel],
                             left=np.nan, right=np.nan)
    return found


def _peak(values: Array) -> float:
    return float(values[np.argmax(np.abs(values))]) if len(values) else 0.0


def _fit(result: Result, signals: list[Signal], between: tuple[float, float]) -> float:
    """The shift at which the squared deviations, relative to the peaks, are least."""
    some = [Signal(s.channel, s.unit, s.times[::len(s.times) // _MOST_POINTS + 1],
                   s.values[::len(s.times) // _MOST_POINTS + 1]) for s in signals]

    def misfit(shift: float) -> float:
        total = 0.0
        for signal in some:
            deviation = signal.values - _simulated(result, signal, shift)
            inside = np.isfinite(deviation)
            if 2 * np.count_nonzero(inside) < len(inside):
                return float("inf")
            total += float(np.mean(deviation[inside]**2)) / (_peak(signal.values)**2 or 1.0)
        return total

    shifts = np.linspace(*between, _SHIFTS)
    errors = np.array([misfit(float(shift)) for shift in shifts])
    if not np.isfinite(errors).any():
        raise ValueError("at no shift half of the measured points lie within the run")
    best = int(np.argmin(errors))
    step = (between[1] - between[0]) / (_SHIFTS - 1)
    for _ in range(20):  # Thirds of an interval around the best shift.
        near = np.clip(shifts[best] + step * np.array([-2 / 3, -1 / 3, 0, 1 / 3, 2 / 3]), *between)
        errors = np.array([misfit(float(shift)) for shift in near])
        shifts, best, step = near, int(np.argmin(errors)), step / 3
    return float(shifts[best])


def _row(result: Result, signal: Signal, shift: float, abs_tol: float,
         rel_tol: float) -> dict[str, Any]:
    deviation = signal.values - _simulated(result, signal, shift)
    inside = np.isfinite(deviation)
    if not inside.any():
        raise ValueError(f"no measured point of {signal.channel} lies within the run; shift_s "
                         "moves them, fit_shift_s looks for the shift")
    largest = int(np.nanargmax(np.abs(deviation)))
    times = signal.times[inside] + shift
    during = (result["time"] >= times.min()) & (result["time"] <= times.max())
    ends = _simulated(result, signal, shift)[inside][[0, -1]]
    peak = _peak(signal.values[inside])
    allowed = max(abs_tol, rel_tol * abs(peak))
    return {"unit": signal.unit, "points": int(inside.sum()), "outside": int((~inside).sum()),
            "rms": float(np.sqrt(np.mean(deviation[inside]**2))),
            "largest": float(deviation[largest]), "largest_time": float(signal.times[largest]),
            "measured_peak": peak,
            "simulated_peak": _peak(np.concatenate([result[signal.channel][during], ends])),
            "allowed": allowed, "holds": bool(abs(deviation[largest]) <= allowed)}
