"""Rows of contacts under loads: identities, rest, release, and a ball that bounces to rest."""

from __future__ import annotations

import math
from typing import Any

from isolated import alpha_of
from laboratory import Laboratory, ball_and_wall
from rows import row

LOADED = "Contacts under loads"
BOUNCES = "A ball that bounces to rest"
GRAVITY = 9.81


def pressed(stiffness: float, restitution: float, velocity: float, force: float) -> None:
    @row(f"newton-{stiffness:g}-{restitution:g}-{force:g}", LOADED,
         f"Newton's ratio v⁺/v⁻ under {force:g} N, ε = {restitution:g}, k = {stiffness:g}",
         "identity e² = ε² − (1 − ε²) 2 P δ_m/(m v²), δ_m from the ledger", 1e-7)
    def _(laboratory: Laboratory) -> Any:
        cycle = laboratory.cycles(ball_and_wall(
            1, stiffness, restitution, 0.5, velocity=-velocity, position=0.001,
            loads=[{"constant": {"force_n": -force}}]))[0]
        speed = cycle.approach_velocity_m_per_s
        lost = (1 - restitution**2) * 2 * force * cycle.delta_max_m / speed**2
        return (-cycle.separation_velocity_m_per_s / speed, math.sqrt(restitution**2 - lost))


for case in ((1e5, 0.5, 1, 9.81), (1e7, 0.3, 3, 50), (1e6, 0.8, 2, 300)):
    pressed(*case)


@row("step-load", LOADED, "√(1 − δ_o/δ_m) of the first cycle of a ball that a step load presses, "
     "ε = 0.6", "identity of a step load from rest: this is ε", 1e-8)
def _(laboratory: Laboratory) -> Any:
    scenario = ball_and_wall(0.5, 1e8, 0.6, 0.05, loads=[{"step": {"force_n": -500}}])
    first = laboratory.cycles(scenario)[0]
    return math.sqrt(1 - first.delta_end_m / first.delta_max_m), 0.6


@row("rest-depth", LOADED, "deformation [m] at which a pressed ball rests",
     "statics: (P/k)^(2/3)", 1e-4)
def _(laboratory: Laboratory) -> Any:
    scenario = ball_and_wall(0.5, 1e8, 0.3, 0.5, loads=[{"step": {"force_n": -500}}])
    return -laboratory.run(scenario).job.final_bodies[0].position_m, (500 / 1e8) ** (2 / 3)


@row("release", LOADED, "energy that a pressed ball gets back when it is let go, over what is "
     "stored, ε = 0.5", "closed form r = ε²α²/(2(α − ln(1 + α)))", 1e-3)
def _(laboratory: Laboratory) -> Any:
    pulse = {"force_n": -500, "start_time_s": 0, "duration_s": 0.5}
    scenario = ball_and_wall(0.5, 1e8, 0.5, 0.6, loads=[{"rectangular_pulse": pulse}])
    last = laboratory.cycles(scenario)[-1]
    stored = 1e8 * last.delta_start_m**2.5 / 2.5
    alpha = alpha_of(0.5)
    return (0.25 * last.separation_velocity_m_per_s**2 / stored,
            0.25 * alpha**2 / (2 * (alpha - math.log1p(alpha))))


def dropped(laboratory: Laboratory) -> list[Any]:
    """The bounces of a hard ball that falls from 1 m."""
    return laboratory.cycles(ball_and_wall(
        1, 1e15, 0.7, 2.6, position=1, loads=[{"constant": {"force_n": -GRAVITY}}]))


@row("fall", BOUNCES, "time [s] and speed [m/s] of the first impact from 1 m, g = 9.81 m/s²",
     "free fall", 1e-10, each=True)
def _(laboratory: Laboratory) -> Any:
    first = dropped(laboratory)[0]
    return ((first.start_time_s, first.approach_velocity_m_per_s),
            (math.sqrt(2 / GRAVITY), math.sqrt(2 * GRAVITY)))


@row("bounces", BOUNCES, "time [s] of the tenth impact, ε = 0.7", "geometric series, rigid limit",
     1e-4)
def _(laboratory: Laboratory) -> Any:
    fall = math.sqrt(2 / GRAVITY)
    return (dropped(laboratory)[9].start_time_s,
            fall * (1 + 2 * sum(0.7**j for j in range(1, 10))))


@row("bounces-end", BOUNCES, "time [s] at which it comes to rest, from its last separate impact",
     "√(2h/g)(1 + e)/(1 − e), rigid limit", 2e-4)
def _(laboratory: Laboratory) -> Any:
    last = dropped(laboratory)[11]
    left = 2 * 0.7 * last.approach_velocity_m_per_s / GRAVITY / (1 - 0.7)
    return last.start_time_s + left, 2.5586340


@row("support", LOADED, "time [s] and speed [m/s] of the first touch of the paper's ball on a spring",
     "closed form of the driven, damped oscillator", 1e-9, each=True)
def _(laboratory: Laboratory) -> Any:
    first = laboratory.cycles("spring-wall")[0]
    time = driven_touch()
    return (first.start_time_s, first.approach_velocity_m_per_s), (time, driven(time)[1])


def driven(time: float) -> tuple[float, float]:
    """Position and velocity of m x″ + c x′ + k x = 500 + 250 sin 2000 t from −10 mm at rest."""
    mass, damping, stiffness, omega = 0.5, 100.0, 1e6, 2000.0
    decay = damping / (2 * mass)
    swing = math.sqrt(stiffness / mass - decay**2)
    real, imaginary = stiffness - mass * omega**2, damping * omega
    size = real**2 + imaginary**2
    sine, cosine = 250 * real / size, -250 * imaginary / size
    level = 500 / stiffness
    a = -0.01 - level - cosine
    b = (decay * a - omega * sine) / swing
    fade = math.exp(-decay * time)
    c, s = math.cos(swing * time), math.sin(swing * time)
    position = (fade * (a * c + b * s) + level
                + sine * math.sin(omega * time) + cosine * math.cos(omega * time))
    velocity = (fade * ((b * swing - a * decay) * c - (a * swing + b * decay) * s)
                + omega * (sine * math.cos(omega * time) - cosine * math.sin(omega * time)))
    return position, velocity


def driven_touch() -> float:
    """When it is at −2 mm for the first time, by halving."""
    low, high = 0.0, 0.0012
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if driven(middle)[0] < -0.002 else (low, middle)
    return (low + high) / 2


@row("pressed-particles", LOADED, "positions [m] and velocities [m/s] at 1 ms of two balls that are "
     "pressed between two walls at the start", "verification case of MFIX-DEM, by SciPy", 1e-4)
def _(laboratory: Laboratory) -> Any:
    balls = [{"name": name, "radius_m": 0.5e-3, "density_kg_per_m3": density, "position_m": position}
             for name, density, position in (("low", 2e4, 0.45e-3), ("high", 1e4, 1.35e-3))]
    spring = {"stiffness": 1e3, "exponent": 1, "restitution": 1}
    scenario = {"start": "AS_GIVEN", "bodies": balls, "contacts": [
        {"between": ["low"], "wall": {"side": "LEFT"}, **spring},
        {"between": ["low", "high"], **spring},
        {"between": ["high"], "wall": {"side": "RIGHT", "position_m": 1.8e-3}, **spring}],
        "loads": [{"gravity": {}}], "end_time_s": 1e-3}
    ends = laboratory.run(scenario).job.final_bodies
    return ([body.position_m for body in ends] + [body.velocity_m_per_s for body in ends],
            [0.42713e-3, 1.38355e-3, -0.02595, 0.39185])


@row("stack-at-rest", LOADED, "positions [m] of four balls that stand on a floor from the start",
     "statics: each contact carries what stands on it, (W/k)^(2/3)", 1e-12)
def _(laboratory: Laboratory) -> Any:
    masses, k, radius = [2.0, 0.5, 1.0, 0.1], 1e7, 0.05
    names = [f"B{i + 1}" for i in range(4)]
    scenario = {"start": "AT_EQUILIBRIUM", "bodies": [
        {"name": name, "mass_kg": mass, "radius_m": radius, "position_m": 0.05 + 0.1 * i}
        for i, (name, mass) in enumerate(zip(names, masses))],
        "contacts": [{"between": names, "stiffness": k, "restitution": 0.5},
                     {"between": ["B1"], "wall": {"side": "LEFT"}, "stiffness": k,
                      "restitution": 0.5}],
        "loads": [{"gravity": {}}], "end_time_s": 0.1}
    heights, face = [], 0.0
    for i in range(4):
        face += radius - (9.80665 * sum(masses[i:]) / k) ** (2 / 3)
        heights.append(face)
        face += radius
    return [body.position_m for body in laboratory.run(scenario).job.final_bodies], heights
