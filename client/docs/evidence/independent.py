"""Rows of an independent integration: SciPy solves the equations with the μ that contactd found."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

import contactsim
from contactsim.model import contact_names, contact_pairs
from laboratory import Laboratory
from rows import row

INDEPENDENT = "Integrated again by SciPy (DOP853), with the μ of the ledger"


class Replay:
    """The motion of a scenario from its equations alone.

    Its state is positions, velocities and the work of each contact. Between two instants at which
    the ledger says that a cycle begins, turns or ends, μ of each contact is constant.
    """

    def __init__(self, result: contactsim.Result) -> None:
        self.scenario = result.scenario
        self.cycles = list(result.job.cycles)
        self.names = [body.name for body in self.scenario.bodies]
        self.contacts = [(name, contact, [self.names.index(body) for body in pair])
                         for contact in self.scenario.contacts
                         for name, pair in zip(contact_names(contact), contact_pairs(contact))]
        self.masses = np.array([body.mass_kg for body in self.scenario.bodies])
        self.mu = [0.0] * len(self.contacts)
        self.works = {(c.contact, c.number): [0.0, 0.0] for c in self.cycles}
        self.velocities = self._integrate()

    def _integrate(self) -> np.ndarray:
        bodies, contacts = len(self.names), len(self.contacts)
        state = np.concatenate([[body.position_m for body in self.scenario.bodies],
                                [body.velocity_m_per_s for body in self.scenario.bodies],
                                np.zeros(contacts)])
        instants = {0.0, self.scenario.end_time_s, *self._breakpoints()}
        for cycle in self.cycles:
            instants |= {cycle.start_time_s, cycle.turn_time_s, cycle.end_time_s}
        ordered = sorted(t for t in instants if not math.isnan(t))
        for start, end in zip(ordered, ordered[1:]):
            running = self._choose((start + end) / 2)
            step = solve_ivp(lambda t, y: self._slope(t, y), (start, end), state, "DOP853",
                             rtol=1e-12, atol=1e-16)
            for contact, cycle in running:
                half = int((start + end) / 2 > cycle.turn_time_s)
                done = step.y[2 * bodies + contact, -1] - state[2 * bodies + contact]
                self.works[cycle.contact, cycle.number][half] += done
            state = step.y[:, -1]
        return state[bodies:2 * bodies]

    def _choose(self, time: float) -> list[tuple[int, Any]]:
        """Sets μ of each contact at a time; the cycles that run then."""
        running = []
        for place, (name, _, _) in enumerate(self.contacts):
            cycle = next((c for c in self.cycles if c.contact == name
                          and c.start_time_s <= time <= c.end_time_s), None)
            self.mu[place] = cycle.mu if cycle else 0.0
            if cycle:
                running.append((place, cycle))
        return running

    def _breakpoints(self) -> list[float]:
        pulses = [load.half_sine_pulse for load in self.scenario.loads
                  if load.WhichOneof("kind") == "half_sine_pulse"]
        return [t for p in pulses for t in (p.start_time_s, p.start_time_s + p.duration_s)]

    def _slope(self, time: float, state: np.ndarray) -> np.ndarray:
        bodies = len(self.names)
        x, v = state[:bodies], state[bodies:2 * bodies]
        force, power = self._loads(time, x, v), []
        for place in range(len(self.contacts)):
            push, speed = self._contact(place, x, v, force)
            power.append(push * speed)
        return np.concatenate([v, force / self.masses, power])

    def _contact(self, place: int, x: np.ndarray, v: np.ndarray,
                 force: np.ndarray) -> tuple[float, float]:
        """Adds the force of a contact; that force and δ̇."""
        _, contact, bodies = self.contacts[place]
        radii = sum(self.scenario.bodies[body].radius_m for body in bodies)
        if len(bodies) == 1:
            depth, speed = x[bodies[0]] + radii - contact.wall.position_m, v[bodies[0]]
        else:
            depth, speed = radii - (x[bodies[1]] - x[bodies[0]]), v[bodies[0]] - v[bodies[1]]
        push = (contact.stiffness + self.mu[place] * speed) * max(depth, 0.0) ** 1.5
        for body, direction in zip(bodies, (-1, 1)):
            force[body] += direction * push
        return push, speed

    def _loads(self, time: float, x: np.ndarray, v: np.ndarray) -> np.ndarray:
        force = np.zeros(len(self.names))
        for load in self.scenario.loads:
            force[self.names.index(load.body)] += load_at(load, time)
        for support in self.scenario.supports:
            place = self.names.index(support.body)
            force[place] -= (support.stiffness_n_per_m * (x[place] - support.rest_position_m)
                             + support.damping_n_s_per_m * v[place])
        return force

    def restitutions(self, groups: list[Any]) -> list[float]:
        """ε of each group from the works that were integrated here."""
        return [math.sqrt(-sum(r for _, r in works) / sum(c for c, _ in works))
                for works in ([self.works[group.contact, number] for number in range(
                    group.first_cycle, group.first_cycle + group.cycles)] for group in groups)]


def load_at(load: Any, time: float) -> float:
    """The force of a load."""
    kind = load.WhichOneof("kind")
    if kind == "constant":
        return float(load.constant.force_n)
    if kind == "sine":
        return load.sine.amplitude_n * math.sin(
            load.sine.angular_frequency_rad_per_s * time + load.sine.phase_rad)
    if kind != "half_sine_pulse":
        raise ValueError(f"no replay of {kind}")
    pulse = load.half_sine_pulse
    phase = (time - pulse.start_time_s) / pulse.duration_s
    return pulse.amplitude_n * math.sin(math.pi * phase) if 0 <= phase <= 1 else 0.0


def replayed(template: str) -> None:
    @row(f"scipy-{template}", INDEPENDENT, f"`{template}`: final velocities [m/s]",
         "SciPy's DOP853, relative tolerance 1e-12", 1e-7)
    def _(laboratory: Laboratory) -> Any:
        result = laboratory.run(template)
        return laboratory.velocities(template), list(Replay(result).velocities)

    @row(f"scipy-{template}-restitution", INDEPENDENT,
         f"`{template}`: ε of its groups, from works integrated there",
         "ε asked for in the scenario", 1e-6)
    def _(laboratory: Laboratory) -> Any:
        result = laboratory.run(template)
        groups = [g for g in result.job.groups if g.status == 1]
        return Replay(result).restitutions(groups), [g.restitution_in for g in groups]


for name in ("three-ball-chain", "newton-cradle", "two-balls-wall", "spring-wall", "gear-teeth",
             "half-sine-pulse"):
    replayed(name)
