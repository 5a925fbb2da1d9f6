"""Panels about the contacts of a run, a colour each."""

from __future__ import annotations

import math
from typing import Callable, Sequence

import numpy as np
from contact.v1 import job_pb2, scenario_pb2

from ..model import Array, ContactLaw
from .coarse import FEW_SAMPLES, coarse_cycles, ranges, samples_in, stamp
from .figure import Curve, Label, Mark, Panel, Range
from .shown import Shown

_MOST_LABELS = 12  # More would hide the curves.
_APART = 0.02  # Of the time shown: the height of a label that is upright.


def force(run: Shown) -> Panel:
    """Contact force over t, with the equivalent external force dashed and μ/k at the largest peaks of
    cycles that have enough samples to be seen."""
    panel = run.over_time("force [N]")
    panel.dashed = "equivalent external"
    for colour, law in run.contacts:
        ends = _Ends(run, law)
        panel.curves += [
            run.curve(run.column(f"{law.name}.contact_force"), law.name, colour,
                      contacts=[law.name]),
            run.curve(run.column(f"{law.name}.external_force"), f"{law.name} equivalent external",
                      colour, Mark.DASHED, contacts=[law.name]),
            *run.marks(law.name, law.name, colour, ends.start_force, ends.end_force)]
        panel.ranges += contact_ranges(run, law, "contact_force", colour)
    panel.labels = _peaks(run, panel)
    return panel


def deformation_velocity(run: Shown) -> Panel:
    """δ̇ over t."""
    panel = run.over_time("deformation velocity [m/s]")
    for colour, law in run.contacts:
        ends = _Ends(run, law)
        panel.curves += [
            run.curve(run.column(f"{law.name}.deformation_velocity"), law.name, colour,
                      contacts=[law.name]),
            *run.marks(law.name, law.name, colour,
                       lambda cycle: cycle.approach_velocity_m_per_s, ends.end_rate)]
    return panel


def hysteresis(run: Shown) -> Panel:
    """F over δ: a loop for each cycle that has a sample, from where to where the ledger says. Its area
    is the energy lost. Of a cycle with too few samples there are points."""
    panel = Panel("deformation [m]", "contact force [N]", stamp=stamp(run))
    for colour, law in run.contacts:
        loops = [(cycle, _loop(run, law, cycle)) for _, cycle in run.cycles(law.name)]
        first = True  # It alone is in the key.
        for cycle, (delta, values) in loops:
            if not len(delta):
                continue
            label = law.name if first else f"{law.name} #{cycle.number}"
            few = bool(coarse_cycles([cycle], run.column("time")))
            panel.curves += [
                Curve(label, colour, delta, values, Mark.RARE if few else Mark.LINE, first),
                Curve(f"{label} starts", colour, delta[:1], values[:1], Mark.START, False),
                Curve(f"{label} ends", colour, delta[-1:], values[-1:], Mark.END, False)]
            first = False
    return panel


def contact_ranges(run: Shown, law: ContactLaw, quantity: str, colour: int) -> list[Range]:
    """From which to which value a quantity of a contact goes in cycles with too few samples: from the
    lower end to the peak of the ledger. None of other quantities, whose extremes it does not tell."""
    ends = _Ends(run, law)
    values: dict[str, Callable[[job_pb2.Cycle], Sequence[float]]] = {
        "contact_force": lambda c: (ends.start_force(c), ends.end_force(c), c.peak_force_n),
        "deformation": lambda c: (c.delta_start_m, c.delta_end_m, c.delta_max_m)}
    if quantity not in values:
        return []
    return ranges(run, law.name, colour,
                  lambda cycle: (min(values[quantity](cycle)), max(values[quantity](cycle))))


class _Ends:
    """What the ledger tells of the ends of the cycles of a contact, exactly but for a cycle that the
    end of the run cuts."""

    def __init__(self, run: Shown, law: ContactLaw) -> None:
        self._run = run
        self._law = law
        self._clip = run.result.scenario.solver.tension == scenario_pb2.Solver.CLIP

    def start_force(self, cycle: job_pb2.Cycle) -> float:
        return self._force(cycle, cycle.start_time_s, cycle.delta_start_m,
                           cycle.approach_velocity_m_per_s)

    def end_force(self, cycle: job_pb2.Cycle) -> float:
        if cycle.end == job_pb2.Cycle.RUN_END:
            return self._run.at(f"{cycle.contact}.contact_force", cycle.end_time_s)
        return self._force(cycle, cycle.end_time_s, cycle.delta_end_m,
                           cycle.separation_velocity_m_per_s)

    def end_rate(self, cycle: job_pb2.Cycle) -> float:
        if cycle.end == job_pb2.Cycle.RUN_END:
            return self._run.at(f"{cycle.contact}.deformation_velocity", cycle.end_time_s)
        rate: float = cycle.separation_velocity_m_per_s
        return rate

    def _force(self, cycle: job_pb2.Cycle, time: float, delta: float, rate: float) -> float:
        """Where δ̇ or δ is 0: that of the spring, and that of a damper which does not fade with δ.
        Of a table, whose force depends on what it has borne, that of the samples beside."""
        if self._law.tabled and delta > 0:
            return self._run.at(f"{cycle.contact}.contact_force", time)
        damper = cycle.mu * rate if self._law.damping_exponent == 0 else 0.0
        value: float = self._law.stiffness * math.pow(max(delta, 0.0), self._law.exponent) + damper
        return max(value, 0.0) if self._clip else value


def _loop(run: Shown, law: ContactLaw, cycle: job_pb2.Cycle) -> tuple[Array, Array]:
    """δ and F of a cycle, without points if no sample is in it."""
    time = run.column("time")
    first = int(np.searchsorted(time, cycle.start_time_s, "right"))
    last = int(np.searchsorted(time, cycle.end_time_s, "left"))
    delta = run.column(f"{law.name}.deformation")
    values = run.column(f"{law.name}.contact_force")
    if first >= last:
        return np.empty(0), np.empty(0)
    ends = _Ends(run, law)
    return (np.concatenate([[cycle.delta_start_m], delta[first:last], [cycle.delta_end_m]]),
            np.concatenate([[ends.start_force(cycle)], values[first:last],
                            [ends.end_force(cycle)]]))


def _peaks(run: Shown, panel: Panel) -> list[Label]:
    """μ/k at the largest peaks of the force, so far apart that one can read them."""
    time = run.column("time")
    seen = [cycle for _, law in run.contacts for _, cycle in run.cycles(law.name)
            if run.in_window(cycle.turn_time_s) and samples_in(cycle, time) >= FEW_SAMPLES]
    apart = _APART * max((curve.x[-1] - curve.x[0] for curve in panel.curves if len(curve.x)),
                         default=0.0)
    chosen: list[job_pb2.Cycle] = []
    for cycle in sorted(seen, key=lambda cycle: -cycle.peak_force_n):
        if len(chosen) == _MOST_LABELS:
            break
        if all(abs(other.turn_time_s - cycle.turn_time_s) >= apart for other in chosen):
            chosen.append(cycle)
    return [Label(cycle.turn_time_s, cycle.peak_force_n, f"μ/k = {cycle.mu_over_k_s_per_m:.4g} s/m")
            for cycle in sorted(chosen, key=lambda cycle: cycle.turn_time_s)]
