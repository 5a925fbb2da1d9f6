"""A scenario solved for many values of its fields, and what came of each."""

from __future__ import annotations

import html
from typing import TYPE_CHECKING, Any, Iterable, Mapping, Union

import pandas as pd
from contact.v1 import event_pb2, job_pb2, scenario_pb2
from google.protobuf.descriptor import FieldDescriptor

from .labels import axis_label
from .scenario import ScenarioLike, read_scenario
from .spelling import expected, shown
from .units import field_at, unit_of, unit_of_metric

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes

#: A value of an axis: a number, or the word of an enum.
AxisValue = Union[float, str]

_VARIABLE = "var:"

_CUT = "CUT"
_UNTOUCHED = "no contact"
_WORDS = {event_pb2.SweepCell.CUT: _CUT, event_pb2.SweepCell.NO_CONTACT: _UNTOUCHED}


def make_sweep(scenario: ScenarioLike, grid: Mapping[str, Iterable[AxisValue]],
               metrics: Iterable[str], variables: Mapping[str, Any] | None,
               set_: Mapping[str, Any] | None) -> scenario_pb2.Sweep:
    """A grid: every value of each field with every value of the others."""
    base, fields = read_scenario(scenario, variables, set_)
    axes = [_axis(name, values, fields) for name, values in grid.items()]
    return scenario_pb2.Sweep(base=base, axes=axes, metrics=list(metrics))


def _axis(name: str, values: Any,
          variables: Mapping[str, list[str]]) -> scenario_pb2.Sweep.Axis:
    """The axis of a path, or of all numbers that are the variable `var:NAME`."""
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise TypeError(f"the axis {name!r} is a list of values, as in {{{name!r}: [0.5, 0.7]}}, and "
                        f"not {shown(values)}")
    axis = scenario_pb2.Sweep.Axis(field=name)
    if name.startswith(_VARIABLE):
        paths = _numbers(name[len(_VARIABLE):], variables)
        axis = scenario_pb2.Sweep.Axis(field=paths[0], also=paths[1:], label=name)
    field = field_at(scenario_pb2.Scenario.DESCRIPTOR, axis.field)
    axis.values.extend(_number_of(value, field) for value in values)
    return axis


def _numbers(name: str, variables: Mapping[str, list[str]]) -> list[str]:
    if name not in variables:
        raise ValueError(f"unknown variable '{name}'" + expected(name, variables))
    paths = []
    for path in variables[name]:
        field = field_at(scenario_pb2.Scenario.DESCRIPTOR, path)
        if field is not None and field.cpp_type != FieldDescriptor.CPPTYPE_STRING:
            paths.append(path)
    if not paths:
        raise ValueError(f"the variable '{name}' is the whole value of no number")
    return paths


def _number_of(value: AxisValue, field: FieldDescriptor | None) -> float:
    """The number of a value on the wire."""
    if not isinstance(value, str):
        return float(value)
    word = value.upper().replace("-", "_")
    words = field.enum_type.values_by_name if field is not None and field.enum_type else {}
    if word not in words:
        raise ValueError(f"{value!r} is no value of the axis"
                         + (f"; one of {', '.join(words)}" if words else ""))
    return float(words[word].number)


class SweepResult:
    """The cells of an ended sweep."""

    def __init__(self, job: job_pb2.Job, cells: Iterable[event_pb2.SweepCell]) -> None:
        self.job = job  #: The Job message, with its spec and progress.
        self.axes = [axis.label or axis.field for axis in job.sweep.axes]
        self.metrics = list(job.sweep.metrics)
        #: SI unit of each axis and metric: `1` without dimension, empty for words.
        self.units = {name: unit_of(field) for name, field in zip(self.axes, self._fields())}
        self.units.update({metric: unit_of_metric(metric) for metric in self.metrics})
        by_index = {cell.index: cell for cell in cells}
        #: The messages, in the order of their numbers.
        self.cells = ordered = [by_index[index] for index in sorted(by_index)]
        index = pd.Index([cell.index for cell in ordered], name="cell")
        #: A row a cell: axes, metrics, `state`, `convergence`, `message`. Axes of an enum have its
        #: words. Metrics of a cell that failed are NaN, as are those that `unknown` has a word for.
        self.frame = pd.DataFrame(
            [self._row(cell) for cell in ordered], index=index,
            columns=[*self.axes, *self.metrics, "state", "convergence", "message"])
        #: Why a metric is no known number, a row a cell: `CUT`, it comes from a cycle that the end
        #: of the run cuts; `no contact`, the contact was not touched; empty, it is known.
        self.unknown = pd.DataFrame([self._words(cell) for cell in ordered], index=index,
                                    columns=self.metrics)

    @property
    def name(self) -> str:
        """Format: `jobs/{id}`."""
        return self.job.name

    @property
    def xr(self) -> xarray.Dataset:
        """The metrics of a grid over its axes, with units as attributes. Needs xarray."""
        data: xarray.Dataset = self.frame.set_index(self.axes)[self.metrics].to_xarray()
        for name in (*self.axes, *self.metrics):
            data[name].attrs["units"] = self.units[name]
        return data

    @property
    def axis_labels(self) -> list[str]:
        """What each axis varies, in words, such as `velocity of B1 [m/s]`."""
        return [axis_label(self.job.sweep, axis) for axis in range(len(self.axes))]

    def heatmap(self, metric: str | None = None, ax: Axes | None = None, *, log: bool = False,
                contours: bool = False) -> Axes:
        """A metric, by default the first, over the two axes of the sweep: the first one down.

        Cells that did not converge are hatched, those that failed crossed; those that `unknown` has
        a word for are grey. With `contours` lines of equal value lie between the cells that
        converged.
        """
        import matplotlib.pyplot as plt  # Only who plots needs matplotlib.

        from .figures.maps import add_legend, draw_map
        from .figures.sweeps import heat_map

        map_ = heat_map(self, metric or self.metrics[0], log)
        if ax is None:
            ax = plt.subplots(layout="constrained")[1]
        draw_map(map_, ax, contours)
        add_legend(map_, ax)
        return ax

    def value_text(self, axis: int, value: float) -> str:
        """A value of an axis in a few digits, or its word."""
        shown = _shown(value, self._fields()[axis])
        return shown if isinstance(shown, str) else f"{shown:.4g}"

    def _words(self, cell: event_pb2.SweepCell) -> list[str]:
        """Of each metric; servers of earlier versions do not tell where it comes from."""
        words = [_WORDS.get(source, "") for source in cell.sources]
        return words + [""] * (len(self.metrics) - len(words))

    def _row(self, cell: event_pb2.SweepCell) -> list[Any]:
        failed = cell.state == job_pb2.Job.FAILED
        metrics = [value if not (failed or word) else float("nan")
                   for value, word in zip(cell.metrics, self._words(cell))]
        metrics += [float("nan")] * (len(self.metrics) - len(metrics))
        values = [_shown(value, field) for value, field in zip(cell.values, self._fields())]
        return [*values, *metrics, job_pb2.Job.State.Name(cell.state),
                "" if failed else job_pb2.Job.Convergence.Name(cell.convergence),
                cell.message or self._remark(cell)]

    def _remark(self, cell: event_pb2.SweepCell) -> str:
        """What a cell that did not fail cannot know."""
        if cell.HasField("cycles") and cell.cycles == 0:
            return _UNTOUCHED
        named = zip(self.metrics, self._words(cell))
        return "; ".join(f"{metric}: {word}" for metric, word in named if word)

    def _fields(self) -> list[FieldDescriptor | None]:
        """The field of each axis."""
        return [field_at(scenario_pb2.Scenario.DESCRIPTOR, axis.field)
                for axis in self.job.sweep.axes]

    def __repr__(self) -> str:
        return f"<SweepResult {self._headline()}>"

    def _headline(self) -> str:
        progress = self.job.progress
        return (f"{self.name}: {job_pb2.Job.State.Name(self.job.state)}, {progress.cells_done} of "
                f"{progress.cells} cells, {progress.cells_failed} failed, "
                f"{progress.cells_not_converged} not converged")

    def _repr_html_(self) -> str:
        return (f"<p><b>{html.escape(self._headline())}</b></p>"
                f"{self.frame.to_html(max_rows=20)}")


def _shown(value: float, field: FieldDescriptor | None) -> AxisValue:
    """The word of an enum, or the number."""
    if field is None or not field.enum_type:
        return value
    choice = field.enum_type.values_by_number.get(round(value))
    return choice.name if choice is not None else value

