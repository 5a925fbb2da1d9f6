"""Plots of a result with matplotlib, by preset."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING, Any, Iterable, Iterator

import numpy as np

from .model import contact_laws, mechanical_energy, wall_touches

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .result import Result

PRESETS = ("position", "velocity", "force", "deformation_velocity", "hysteresis", "restitution",
           "iterations", "energy")

# Okabe and Ito's colours, which colour-blind readers can tell apart.
_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")


class Plots:
    """The presets. Each draws on `ax`, or on axes of its own, and returns them."""

    def __init__(self, result: Result) -> None:
        self._result = result
        names = dict.fromkeys(cycle.contact for cycle in result.job.cycles)
        names.update(dict.fromkeys(self._owners("contact_force")))
        self._contacts = dict(zip(names, itertools.cycle(_COLOURS)))

    def __call__(self, preset: str, ax: Any = None) -> Any:
        """The plot with this name, such as `force` or `deformation-velocity`."""
        name = preset.replace("-", "_")
        if name not in PRESETS:
            raise ValueError(f"there is no preset {preset!r}; one of {', '.join(PRESETS)}")
        return getattr(self, name)(ax)

    def position(self, ax: Axes | None = None) -> Axes:
        """x over t of each body; dotted where its centre is when it touches a wall."""
        ax = self._bodies(ax, "position", "position [m]")
        for touch in wall_touches(self._result.scenario):
            ax.axhline(touch, color="0.4", linestyle=":", zorder=1)
        return ax

    def velocity(self, ax: Axes | None = None) -> Axes:
        """v over t of each body."""
        return self._bodies(ax, "velocity", "velocity [m/s]")

    def force(self, ax: Axes | None = None) -> Axes:
        """Contact force over t, with the equivalent external force dashed and μ/k at each peak."""
        ax = self._over_time(ax, "force [N]")
        time = self._result["time"]
        for contact in self._owners("contact_force"):
            colour = self._contacts[contact]
            ax.plot(time, self._result[f"{contact}.contact_force"], color=colour, label=contact)
            external = self._result[f"{contact}.external_force"]
            ax.plot(time, external, color=colour, linestyle="--", linewidth=0.8, alpha=0.7)
            self._mark(ax, contact, f"{contact}.contact_force", colour)
        peaks = [c for c in self._result.job.cycles if not math.isnan(c.turn_time_s)]
        for cycle in peaks[:12]:  # More would hide the curves.
            ax.annotate(f"μ/k = {cycle.mu_over_k_s_per_m:.4g} s/m",
                        (cycle.turn_time_s, cycle.peak_force_n), xytext=(0, 3),
                        textcoords="offset points", ha="center", fontsize="small",
                        rotation=90 if len(peaks) > 4 else 0)
        ax.margins(y=0.25 if len(peaks) > 4 else 0.1)
        return _finish(ax)

    def deformation_velocity(self, ax: Axes | None = None) -> Axes:
        """δ̇ over t of each contact."""
        ax = self._over_time(ax, "deformation velocity [m/s]")
        for contact in self._owners("deformation_velocity"):
            column = f"{contact}.deformation_velocity"
            colour = self._contacts[contact]
            ax.plot(self._result["time"], self._result[column], color=colour, label=contact)
            self._mark(ax, contact, column, colour)
        return _finish(ax)

    def hysteresis(self, ax: Axes | None = None) -> Axes:
        """F over δ: a loop for each cycle, whose area is the energy lost."""
        ax = _axes(ax, "deformation [m]", "contact force [N]")
        time = self._result["time"]
        for cycle, label in self._labelled_cycles():
            inside = (time >= cycle.start_time_s) & (time <= cycle.end_time_s)
            delta = self._result[f"{cycle.contact}.deformation"][inside]
            force = self._result[f"{cycle.contact}.contact_force"][inside]
            colour = self._contacts[cycle.contact]
            ax.plot(delta, force, color=colour, label=label)
            if len(delta):
                ax.plot(delta[:1], force[:1], "o", color=colour, fillstyle="none")
                ax.plot(delta[-1:], force[-1:], "x", color=colour)
        return _finish(ax)

    def restitution(self, ax: Axes | None = None) -> Axes:
        """ε asked for (o) and had by its group (×), for each cycle of the ledger."""
        ax = _axes(ax, "cycle, in order of its end", "energy restitution coefficient")
        groups = {(g.contact, g.number): g.restitution_out for g in self._result.job.groups}
        had = [groups.get((c.contact, c.group), c.restitution_out)
               for c in self._result.job.cycles]
        ledger = self._result.cycles.assign(restitution_out=had)
        for contact, rows in ledger.groupby("contact", sort=False):
            colour = self._contacts[contact]
            ax.plot(rows.index + 1, rows.restitution_in, "o", color=colour, fillstyle="none",
                    label=f"{contact} asked for")
            ax.plot(rows.index + 1, rows.restitution_out, "x", color=colour,
                    label=f"{contact} had")
        ax.set_ylim(0, 1.05)
        ax.xaxis.get_major_locator().set_params(integer=True)
        return _finish(ax)

    def iterations(self, axes: Any = None, episode: int | None = None) -> Any:
        """μ and the residual |f| over the passes of one episode, by default the longest.

        `axes` are two; both are returned.
        """
        import matplotlib.pyplot as plt

        if axes is None:
            axes = plt.subplots(2, 1, sharex=True, layout="constrained")[1]
        table = self._result.iterations
        if episode is None and len(table):
            episode = int(table.groupby("episode")["pass"].max().idxmax())
        for (contact, number), rows in table[table.episode == episode].groupby(
                ["contact", "number"], sort=False):
            style = {"marker": "o", "color": self._contacts.get(contact), "fillstyle": "none"}
            axes[0].plot(rows["pass"], rows.mu, label=f"{contact} #{number}", **style)
            axes[1].plot(rows["pass"], rows.residual.abs().clip(lower=1e-17), **style)
        axes[0].set_ylabel("μ [N·s/m$^{n+1}$]")
        axes[1].set(ylabel="|f(μ)| = |W$_r$/W$_c$ + ε²|", xlabel="pass", yscale="log")
        axes[1].xaxis.get_major_locator().set_params(integer=True)
        for ax in axes:
            _finish(ax)
        return axes

    def energy(self, ax: Axes | None = None) -> Axes:
        """What holds energy over t, and the sum, which damping and loads that vary change."""
        ax = self._over_time(ax, "energy [J]")
        parts = mechanical_energy(self._result.scenario, self._result.arrays)
        for colour, (label, values) in zip(_COLOURS, parts.items()):
            ax.plot(self._result["time"], values, color=colour, label=label)
        return _finish(ax)

    def _owners(self, quantity: str) -> list[str]:
        """Names of the bodies or contacts that have this quantity."""
        suffix = "." + quantity
        return [name.removesuffix(suffix) for name in self._result.units if name.endswith(suffix)]

    def _over_time(self, ax: Axes | None, label: str) -> Axes:
        ax = _axes(ax, "time [s]", label)
        alone = [cycle for cycle in self._result.job.cycles if not cycle.group]
        for band in (*self._result.job.groups, *alone):
            ax.axvspan(band.start_time_s, band.end_time_s, alpha=0.08, linewidth=0,
                       color=self._contacts[band.contact])
        return ax

    def _bodies(self, ax: Axes | None, quantity: str, label: str) -> Axes:
        ax = self._over_time(ax, label)
        touching = {law.name: law.bodies for law in contact_laws(self._result.scenario)}
        for body, colour in zip(self._owners(quantity), itertools.cycle(_COLOURS)):
            column = f"{body}.{quantity}"
            ax.plot(self._result["time"], self._result[column], color=colour, label=body)
            for contact, bodies in touching.items():
                if body in bodies:
                    self._mark(ax, contact, column, colour)
        return _finish(ax)

    def _mark(self, ax: Axes, contact: str, column: str, colour: str) -> None:
        """o where cycles of the contact start, × where they end."""
        mine = [c for c in self._result.job.cycles if c.contact == contact]
        for marker, times in (("o", [c.start_time_s for c in mine]),
                              ("x", [c.end_time_s for c in mine])):
            values = np.interp(times, self._result["time"], self._result[column])
            ax.plot(times, values, marker, color=colour, fillstyle="none", markersize=5)

    def _labelled_cycles(self) -> Iterator[tuple[Any, str | None]]:
        """Cycles, the first of each contact with a label for the legend."""
        seen: set[str] = set()
        for cycle in self._result.job.cycles:
            yield cycle, None if cycle.contact in seen else cycle.contact
            seen.add(cycle.contact)


def _axes(ax: Axes | None, xlabel: str, ylabel: str) -> Axes:
    if ax is None:
        import matplotlib.pyplot as plt  # Only who plots needs matplotlib.

        ax = plt.subplots(layout="constrained")[1]
    ax.set(xlabel=xlabel, ylabel=ylabel)
    return ax


def _finish(ax: Axes) -> Axes:
    handles: Iterable[Any] = ax.get_legend_handles_labels()[0]
    if handles:
        ax.legend(fontsize="small")
    ax.grid(alpha=0.25)
    return ax
