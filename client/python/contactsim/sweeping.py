"""A scenario solved for many values of its fields, and what came of each."""

from __future__ import annotations

import html
from typing import TYPE_CHECKING, Any, Iterable, Mapping

import numpy as np
import pandas as pd
from contact.v1 import event_pb2, job_pb2, scenario_pb2

from .scenario import ScenarioLike, load_scenario

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes


def make_sweep(scenario: ScenarioLike, grid: Mapping[str, Iterable[float]],
               metrics: Iterable[str]) -> scenario_pb2.Sweep:
    """A grid: every value of each field with every value of the others."""
    axes = [scenario_pb2.Sweep.Axis(field=field, values=[float(value) for value in values])
            for field, values in grid.items()]
    return scenario_pb2.Sweep(base=load_scenario(scenario), axes=axes, metrics=list(metrics))


class SweepResult:
    """The cells of an ended sweep."""

    def __init__(self, job: job_pb2.Job, cells: Iterable[event_pb2.SweepCell]) -> None:
        self.job = job  #: The Job message, with its spec and progress.
        self.axes = [axis.field for axis in job.sweep.axes]
        self.metrics = list(job.sweep.metrics)
        by_index = {cell.index: cell for cell in cells}
        #: A row a cell: axes, metrics, `state`, `convergence`, `message`. Metrics of a cell that
        #: failed are NaN.
        self.frame = pd.DataFrame(
            [self._row(by_index[index]) for index in sorted(by_index)],
            columns=[*self.axes, *self.metrics, "state", "convergence", "message"],
            index=pd.Index(sorted(by_index), name="cell"))

    @property
    def name(self) -> str:
        """Format: `jobs/{id}`."""
        return self.job.name

    @property
    def xr(self) -> xarray.Dataset:
        """The metrics of a grid over its axes. Needs xarray."""
        return self.frame.set_index(self.axes)[self.metrics].to_xarray()

    def heatmap(self, metric: str | None = None, ax: Axes | None = None) -> Axes:
        """A metric, by default the first, over the two axes of the sweep: the first one down.

        Cells that did not converge are hatched, those that failed crossed.
        """
        import matplotlib.pyplot as plt  # Only who plots needs matplotlib.

        metric = metric or self.metrics[0]
        if len(self.axes) != 2 or metric not in self.metrics:
            raise ValueError(f"a heat map is of two axes, and of one of {self.metrics}")
        table = self.frame.pivot(index=self.axes[0], columns=self.axes[1], values=metric)
        if ax is None:
            ax = plt.subplots(layout="constrained")[1]
        image = ax.imshow(np.ma.masked_invalid(table.to_numpy(float)), aspect="auto",
                          cmap="viridis")
        ax.figure.colorbar(image, ax=ax, label=metric)
        ax.set_xticks(range(table.shape[1]), [f"{value:.4g}" for value in table.columns])
        ax.set_yticks(range(table.shape[0]), [f"{value:.4g}" for value in table.index])
        ax.set(xlabel=self.axes[1], ylabel=self.axes[0])
        self._mark(ax, table)
        return ax

    def _mark(self, ax: Axes, table: pd.DataFrame) -> None:
        for _, cell in self.frame.iterrows():
            x = table.columns.get_loc(cell[self.axes[1]])
            y = table.index.get_loc(cell[self.axes[0]])
            if cell.state == "FAILED":
                ax.plot([x - 0.5, x + 0.5], [y - 0.5, y + 0.5], color="#b00020", lw=1.5)
                ax.plot([x - 0.5, x + 0.5], [y + 0.5, y - 0.5], color="#b00020", lw=1.5)
            elif cell.convergence != "FULL":
                ax.fill([x - 0.5, x + 0.5, x + 0.5, x - 0.5], [y - 0.5, y - 0.5, y + 0.5, y + 0.5],
                        fill=False, hatch="///", lw=0)

    def _row(self, cell: event_pb2.SweepCell) -> list[Any]:
        failed = cell.state == job_pb2.Job.FAILED
        metrics = [float("nan")] * len(self.metrics) if failed else list(cell.metrics)
        return [*cell.values, *metrics, job_pb2.Job.State.Name(cell.state),
                "" if failed else job_pb2.Job.Convergence.Name(cell.convergence), cell.message]

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
