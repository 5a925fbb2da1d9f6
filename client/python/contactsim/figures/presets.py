"""The figures that can be made of a run, by name."""

from __future__ import annotations

import itertools
import math
from fractions import Fraction
from typing import TYPE_CHECKING, Callable, Sequence

import numpy as np
from contact.v1 import event_pb2, job_pb2

from ..model import Array
from ..spelling import expected
from .coarse import stamp
from .contacts import contact_ranges, deformation_velocity, force, hysteresis
from .figure import Curve, Figure, FigureError, Kind, Mark, Panel
from .shown import OfCycle, Part, Shown
from .sources import source_of

if TYPE_CHECKING:
    from ..result import Result

_LEAST = 1e-17  # Stands for an error of zero, which has no logarithm.
_MANY_SIZES = 1000  # Values that differ by more need a logarithmic axis: the small would lie on it.
_SILENT = (job_pb2.Cycle.SETTLED, job_pb2.Cycle.RELEASED)
_CYCLES = "o start, × end of a contact cycle"


def _bodies(run: Shown, quantity: str, label: str, moved: bool = False) -> Panel:
    """A quantity of each body, less its first position if `moved`, with marks at the cycles of its
    contacts."""
    panel = run.over_time(label)
    origins = {body.name: body.position_m for body in run.result.scenario.bodies}
    for colour, body in run.bodies:
        column = f"{body}.{quantity}"
        offset = -origins[body] if moved else 0.0
        touching = [law.name for _, law in run.contacts if body in law.bodies]
        panel.curves.append(run.curve(run.column(column) + offset, body, colour, contacts=touching))
        at_start, at_end = _ends(run, column, offset)
        for _, law in run.contacts:
            if body in law.bodies:
                panel.curves += run.marks(law.name, f"{body}, {law.name}", colour, at_start, at_end)
    return panel


def _ends(run: Shown, column: str, offset: float) -> tuple[OfCycle, OfCycle]:
    """The value of a column where a cycle starts and ends."""
    return (lambda cycle: run.at(column, cycle.start_time_s) + offset,
            lambda cycle: run.at(column, cycle.end_time_s) + offset)


def _position(run: Shown) -> list[Panel]:
    """x over t of each body; dotted where its centre is when it touches a wall."""
    panel = _bodies(run, "position", "position [m]")
    panel.by_span = True
    panel.dotted = [law.wall_touch for _, law in run.contacts if law.wall_touch is not None]
    return [panel]


def _displacement(run: Shown) -> list[Panel]:
    """Positions less those at the start of the run."""
    return [_bodies(run, "position", "displacement [m]", moved=True)]


def _velocity(run: Shown) -> list[Panel]:
    """v over t of each body."""
    return [_bodies(run, "velocity", "velocity [m/s]")]


def _restitution(run: Shown) -> list[Panel]:
    """Over the place of each cycle: ε asked for (o) and had by its group (×), and |Δε|/ε below, which
    tells apart what coincides above."""
    x_label = "cycle, in order of its end"
    values = Panel(x_label, "energy restitution coefficient", counted_x=True, lowest_y=0.0)
    errors = Panel(x_label, "|Δε|/ε [1]", counted_x=True, log_y=True)
    groups = {(g.contact, g.number): g.restitution_out for g in run.result.job.groups}
    for colour, law in run.contacts:
        table = [(place, cycle.restitution_in,
                  groups.get((law.name, cycle.group),
                             math.nan if cycle.status in _SILENT else cycle.restitution_out))
                 for place, cycle in run.cycles(law.name)]
        place, asked, had = np.array(table, float).reshape(-1, 3).T
        miss = np.maximum(np.abs(had - asked) / asked, _LEAST)
        values.curves += [_known(f"{law.name} asked for", colour, place, asked, Mark.START, False),
                          _known(law.name, colour, place, had, Mark.END)]
        errors.curves.append(_known(law.name, colour, place, miss, Mark.END, False))
    return [values, errors] if any(len(curve.x) for curve in errors.curves) else [values]


def _known(label: str, colour: int, x: Array, y: Array, mark: Mark,
           keyed: bool = True) -> Curve:
    """Without points that are none: a law that is given has no restitution asked for."""
    known = ~np.isnan(y)
    return Curve(label, colour, x[known], y[known], mark, keyed)


def _mu_unit(run: Shown) -> str:
    """That of μ in μ δⁿ δ̇, if all contacts shown have the same n: N·s/m^(5/2) of n = 3/2."""
    powers = {Fraction(law.damping_exponent + 1).limit_denominator(100) for _, law in run.contacts}
    power = str(powers.pop()) if len(powers) == 1 else "n+1"
    return "N·s/m" + ("" if power == "1" else f"^{power}" if power.isdigit() else f"^({power})")


def _iterations(run: Shown) -> list[Panel]:
    """μ and |f| over the passes of the episode that took the most passes, a curve for each cycle."""
    shown = {law.name for _, law in run.contacts}
    passes = [(one, [u for u in one.unknowns if u.contact in shown])
              for one in run.result.passes if run.in_window(one.start_time_s)]
    passes = [(one, unknowns) for one, unknowns in passes if unknowns]
    if not passes:
        raise FigureError("this run iterated nothing")
    episode = max((one for one, _ in passes), key=lambda one: one.number).episode
    points: dict[str, list[tuple[float, float, float]]] = {}
    for one, unknowns in passes:
        if one.episode == episode:
            for u in unknowns:
                points.setdefault(f"{u.contact} #{u.number}", []).append(
                    (one.number, u.mu, max(abs(u.residual), _LEAST)))
    only = all(one.episode == episode for one, _ in passes)
    x_label = "pass" if only else f"pass of episode {episode}"
    panels = [Panel(x_label, f"μ [{_mu_unit(run)}]", counted_x=True),
              Panel(x_label, "|W_r/W_c + ε²| [1]", counted_x=True, log_y=True)]
    for colour, (label, rows) in enumerate(points.items()):
        number, mu, residual = np.array(rows).T
        panels[0].curves.append(Curve(label, colour, number, mu, Mark.LINE_POINTS))
        panels[1].curves.append(Curve(label, colour, number, residual, Mark.LINE_POINTS))
    low = min(curve.y.min() for curve in panels[0].curves)
    high = max(curve.y.max() for curve in panels[0].curves)
    panels[0].log_y = bool(0 < low and _MANY_SIZES * low < high)
    return panels


def _acceleration(run: Shown) -> list[Panel]:
    """a over t of each body."""
    return [_bodies(run, "acceleration", "acceleration [m/s^2]")]


def _supports(run: Shown) -> list[Panel]:
    """Force of each support on its body over t, and the energy in its spring."""
    if not run.result.scenario.supports:
        raise FigureError("this run has no supports")
    run.column("system.support_energy")
    ending = ".support_force"
    names = [column.removesuffix(ending) for column in run.result.arrays if column.endswith(ending)]
    panels = []
    for quantity, label in (("support_force", "force [N]"), ("support_energy", "energy [J]")):
        panel = run.over_time(label)
        panel.curves = [run.curve(run.column(f"{name}.{quantity}"), name, colour)
                        for colour, name in enumerate(names)]
        panels.append(panel)
    return panels


def _energy(run: Shown) -> list[Panel]:
    """What holds energy over t, what contacts and supports have dissipated, the work of loads and
    drives, and the sum less that work, which is constant."""
    panel = run.over_time("energy [J]")
    kinetic, contacts, supports, dissipated, work = (
        run.column(f"system.{name}") for name in ("kinetic_energy", "contact_energy",
                                                  "support_energy", "dissipated_energy", "load_work"))
    parts = {"kinetic": kinetic, "contacts": contacts, "supports": supports,
             "dissipated": dissipated, "load work": work}
    shown = {label: values for label, values in parts.items() if values.any()}
    shown["sum less load work"] = kinetic + contacts + supports + dissipated - work
    panel.curves = [run.curve(values, label, colour)
                    for colour, (label, values) in enumerate(shown.items())]
    return [panel]


def _forces(run: Shown, kind: Kind) -> list[Panel]:
    """Contact force over t, a row for each contact."""
    rows = [(place, law.name, f"{law.name}.contact_force") for place, law in run.contacts]
    return _rows(run, kind, "contact", "force [N]", rows)


def _velocities(run: Shown, kind: Kind) -> list[Panel]:
    """v over t, a row for each body."""
    rows = [(place, body, f"{body}.velocity") for place, body in run.bodies]
    return _rows(run, kind, "body", "velocity [m/s]", rows)


def _rows(run: Shown, kind: Kind, row: str, label: str,
          rows: list[tuple[int, str, str]]) -> list[Panel]:
    curves = [run.curve(run.column(column), name, place) for place, name, column in rows]
    return [Panel("time [s]", label, curves, kind, row, stamp=stamp(run))]


#: By name: what makes the panels, and what their marks mean.
PRESETS: dict[str, tuple[Callable[[Shown], list[Panel]], str]] = {
    "position": (_position, _CYCLES),
    "displacement": (_displacement, _CYCLES),
    "velocity": (_velocity, _CYCLES),
    "acceleration": (_acceleration, _CYCLES),
    "force": (lambda run: [force(run)], _CYCLES),
    "deformation-velocity": (lambda run: [deformation_velocity(run)], _CYCLES),
    "hysteresis": (lambda run: [hysteresis(run)], _CYCLES),
    "restitution": (_restitution, "o asked for, × had"),
    "iterations": (_iterations, ""),
    "energy": (_energy, ""),
    "supports": (_supports, ""),
    "force-map": (lambda run: _forces(run, Kind.MAP), ""),
    "velocity-map": (lambda run: _velocities(run, Kind.MAP), ""),
    "force-waterfall": (lambda run: _forces(run, Kind.WATERFALL), ""),
    "velocity-waterfall": (lambda run: _velocities(run, Kind.WATERFALL), ""),
}


def preset_figure(preset: str, result: Result, part: Part = Part()) -> Figure:
    """The figure with this name of a part of a run. Raises FigureError if the run did not record what
    it shows."""
    if preset not in PRESETS:
        raise FigureError(f"there is no preset {preset!r}" + expected(preset, PRESETS))
    make, note = PRESETS[preset]
    return _of_run(result, make(Shown(result, part)), note)


def presets_figure(presets: Sequence[str], result: Result, part: Part = Part()) -> Figure:
    """The panels of several presets below each other, with letters, as a figure of a paper has them."""
    figures = [preset_figure(preset, result, part) for preset in presets]
    panels = [panel for figure in figures for panel in figure.panels]
    if len(figures) > 1:
        for place, panel in enumerate(panels):
            panel.letter = f"({chr(ord('a') + place)})"
    notes = dict.fromkeys(figure.note for figure in figures if figure.note)
    return Figure(figures[0].title, panels, figures[0].sources, "; ".join(notes))


def channels_figure(channels: Sequence[str], result: Result, part: Part = Part()) -> Figure:
    """Channels such as `B1.velocity` over time, a panel for each quantity, in the order in which they
    are named."""
    run = Shown(result, part)
    panels: dict[str, Panel] = {}
    for colour, channel in enumerate(channels):
        if channel not in result.arrays:
            owner = channel.rpartition(".")[0]
            alike = [name for name in result.arrays if name.rpartition(".")[0] == owner]
            raise FigureError(f"'{channel}' is no channel of this job"
                              + expected(channel, alike or result.arrays))
        quantity = channel.rpartition(".")[2].replace("_", " ")
        label = f"{quantity} [{result.units[channel]}]"
        panel = panels.setdefault(label, run.over_time(label))
        panel.curves.append(run.curve(result.arrays[channel], channel, colour))
        of, _, name = channel.rpartition(".")
        for _, law in run.contacts:
            if law.name == of:
                panel.ranges += contact_ranges(run, law, name, colour)
    return _of_run(result, list(panels.values()), "")


def _of_run(result: Result, panels: list[Panel], note: str) -> Figure:
    for panel in panels:
        panel.curves = [curve for curve in panel.curves if len(curve.x)]
        if not panel.curves:
            if result.job.HasField("sweep"):
                raise FigureError("this is a sweep, which has no trajectory of its own; "
                                  "sweep heatmap draws its cells")
            raise FigureError("this run has nothing to show there")
    marked = any(curve.is_mark for panel in panels for curve in panel.curves)
    return Figure(result.scenario.title, panels, [source_of(result.job)], note if marked else "")
