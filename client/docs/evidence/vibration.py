"""Rows of driven impacts: a ball on a shaking table, an oscillator that hits a stop."""

from __future__ import annotations

import math
from typing import Any

from laboratory import Laboratory
from rows import row

TABLE = "A ball on a shaking table, in the table's frame"
STOP = "An oscillator that hits a stop"
PERIOD = 2 * math.pi


def landing(restitution: float, shaking: float) -> float:
    """Phase of the impact of the orbit that bounces once a period: cos φ = π(1 − e)/((1 + e) Γ)."""
    return math.acos(math.pi * (1 - restitution) / ((1 + restitution) * shaking))


def shaken(restitution: float, shaking: float, off: float, periods: int) -> dict[str, Any]:
    """g = ω = 1. The ball starts where the periodic orbit is at time 0, and a little beside it."""
    phase = landing(restitution, shaking)
    height = shaking * math.sin(phase) + math.pi * phase - phase**2 / 2
    return {
        "bodies": [{"name": "ball", "mass_kg": 1, "position_m": height + off,
                    "velocity_m_per_s": -math.pi + phase - shaking}],
        "contacts": [{"name": "table", "between": ["ball"], "wall": {"side": "LEFT"},
                      "stiffness": 1e12, "restitution": restitution}],
        "loads": [{"body": "ball", "constant": {"force_n": -1}},
                  {"body": "ball", "sine": {"amplitude_n": shaking,
                                            "angular_frequency_rad_per_s": 1}}],
        "end_time_s": periods * PERIOD, "output": {"ledger_only": True}}


def impacts(laboratory: Laboratory, *arguments: Any) -> list[float]:
    """The times of the impacts."""
    return [cycle.start_time_s for cycle in laboratory.cycles(shaken(*arguments))]


def phase_of(restitution: float, shaking: float) -> None:
    @row(f"table-phase-{restitution:g}", TABLE,
         f"phase [rad] of the impact, once a period, e = {restitution:g}, Γ = {shaking:g}",
         "cos φ = π(1 − e)/((1 + e) Γ), rigid limit", 1e-3)
    def _(laboratory: Laboratory) -> Any:
        last = impacts(laboratory, restitution, shaking, 0.05, 40)[-1]
        return last % PERIOD, landing(restitution, shaking)


for pair in ((0.3, 1.9), (0.5, 1.3), (0.7, 0.9)):
    phase_of(*pair)


def multiplier(laboratory: Laboratory, restitution: float, shaking: float) -> float:
    """By what a small disturbance of the periodic orbit grows from one impact to the next."""
    times = impacts(laboratory, restitution, shaking, 1e-3, 24)
    steps = [b - a - PERIOD for a, b in zip(times, times[1:])]
    return steps[17] / steps[16]


def doubling(restitution: float) -> None:
    threshold = math.hypot(math.pi * (1 - restitution) / (1 + restitution),
                           2 * (1 + restitution**2) / (1 + restitution) ** 2)

    @row(f"table-doubling-{restitution:g}", TABLE,
         f"Γ at which the period doubles, e = {restitution:g}: where a disturbance turns by −1",
         "Γ² = (π(1 − e)/(1 + e))² + (2(1 + e²)/(1 + e)²)², rigid limit", 1e-3)
    def _(laboratory: Laboratory) -> Any:
        low, high = threshold - 0.01, threshold + 0.01
        at_low, at_high = (multiplier(laboratory, restitution, g) for g in (low, high))
        return low + (high - low) * (-1 - at_low) / (at_high - at_low), threshold


for e in (0.3, 0.5):
    doubling(e)


def stop(omega: float, speed: float) -> None:
    @row(f"stop-{omega:g}", STOP,
         f"speed of its impact, once a period, at ω = {omega:g}, ζ = 0.02, e = 0.8",
         "piecewise exact map, another program, rigid limit", 1e-3)
    def _(laboratory: Laboratory) -> Any:
        scenario = {
            "bodies": [{"name": "ball", "mass_kg": 1, "position_m": -1}],
            "contacts": [{"name": "stop", "between": ["ball"], "wall": {"side": "RIGHT"},
                          "stiffness": 1e12, "restitution": 0.8}],
            "supports": [{"body": "ball", "stiffness_n_per_m": 1, "damping_n_s_per_m": 0.04}],
            "loads": [{"body": "ball", "sine": {"amplitude_n": 1, "phase_rad": math.pi / 2,
                                                "angular_frequency_rad_per_s": omega}}],
            "end_time_s": 80 * PERIOD / omega, "output": {"ledger_only": True}}
        return laboratory.cycles(scenario)[-1].approach_velocity_m_per_s, speed


for pair in ((1.9, 3.77495452), (2.0, 5.19590262), (2.1, 3.24479666), (2.2, 1.84326664),
             (2.3, 1.19800098), (2.4, .85230175), (2.5, .64253886)):
    stop(*pair)
