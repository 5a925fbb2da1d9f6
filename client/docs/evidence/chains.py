"""Rows of touching balls without damping: cradles, solitary waves, tapered chains, dropped pairs."""

from __future__ import annotations

import math
from typing import Any

from laboratory import Laboratory, ball_and_wall, row_of_balls
from rows import row

ROWS_OF_BALLS = "Rows of touching balls, no damping"
WAVES = "Solitary waves in a row of balls"
RK4 = "Runge–Kutta of order 4, another program"


def cradle(exponent: float, balls: int, velocities: dict[int, float], tolerance: float) -> None:
    @row(f"cradle-{exponent:g}-{balls}", ROWS_OF_BALLS,
         f"velocities of {balls} equal balls, the first one struck, n = {exponent:g}", RK4,
         tolerance)
    def _(laboratory: Laboratory) -> Any:
        final = laboratory.velocities(row_of_balls(
            [1.0] * balls, 1, 10.0 * balls, exponent=exponent))
        return [final[place] for place in velocities], list(velocities.values())


def listed(*values: float) -> dict[int, float]:
    return dict(enumerate(values))


cradle(1.5, 3, listed(-0.07095235, 0.07640304, 0.99454931), 2e-8)
cradle(1.5, 4, listed(-0.07108502, -0.02962620, 0.10973864, 0.99097257), 2e-8)
cradle(1.5, 5, listed(-0.07108502, -0.03027376, -0.01446363, 0.12704499, 0.98877742), 2e-8)
cradle(1.5, 7, {-1: 0.98670506}, 2e-8)
cradle(1.0, 3, listed(-0.13026170, 0.15022957, 0.98003213), 2e-8)
cradle(1.0, 5, listed(-0.13227948, -0.07532917, -0.03101083, 0.29621775, 0.94240173), 2e-8)


def tapered(q: float, last: float, hard: float) -> None:
    @row(f"taper-{q:g}", ROWS_OF_BALLS,
         f"velocity of the last of 20 balls, each {q:.0%} smaller than the one before; "
         f"hard spheres {hard:g}", RK4, 2e-6)
    def _(laboratory: Laboratory) -> Any:
        radii = [(1 - q) ** i for i in range(20)]
        stiffness = [math.sqrt(2 * a * b / (a + b)) for a, b in zip(radii, radii[1:])]
        scenario = row_of_balls([r**3 for r in radii], 1, 40, stiffness=stiffness)
        return laboratory.velocities(scenario)[-1], last


for case in ((0.02, 1.718077, 1.763066), (0.05, 3.740915, 4.078285), (0.08, 7.316323, 9.282697),
             (0.1, 10.544511, 15.902487)):
    tapered(*case)


def long_row(laboratory: Laboratory, striker: float = 1.0, balls: int = 80) -> list[Any]:
    """The ledger of a long row that a ball of another mass strikes."""
    return laboratory.cycles(row_of_balls([striker] + [1.0] * (balls - 1), 1, 1.2 * balls))


def cycles_of(cycles: list[Any], contact: int) -> list[Any]:
    return [cycle for cycle in cycles if cycle.contact == f"C{contact}"]


@row("wave-force", WAVES, "force of the wave that a ball starts, k = m = v = 1", RK4, 1e-4)
def _(laboratory: Laboratory) -> Any:
    return cycles_of(long_row(laboratory), 30)[0].peak_force_n, 0.63954


@row("wave-speed", WAVES, "its speed, in contacts a unit of time", RK4 + ", sampled", 3e-4)
def _(laboratory: Laboratory) -> Any:
    near, far = (cycles_of(long_row(laboratory), place)[0].turn_time_s for place in (20, 50))
    return 30 / (far - near), 0.84034


@row("wave-nesterenko", WAVES, "speed over the sixth root of the force; Nesterenko's value is for "
     "long waves, this one has five balls", "Nesterenko, long-wave limit √(4/5)", 0.015)
def _(laboratory: Laboratory) -> Any:
    near, far = (cycles_of(long_row(laboratory), place)[0] for place in (20, 50))
    speed = 30 / (far.turn_time_s - near.turn_time_s)
    return speed / far.peak_force_n ** (1 / 6), math.sqrt(0.8)


@row("wave-ball", WAVES, "largest velocity of a ball in the wave", RK4, 1e-4)
def _(laboratory: Laboratory) -> Any:
    scenario = row_of_balls([1.0] * 60, 1, 60)
    scenario["output"] = {"sample_interval_s": 0.005}
    return float(laboratory.run(scenario)["B31.velocity"].max()), 0.68163


def striker(mass: float, forces: tuple[float, ...]) -> None:
    @row(f"striker-{mass:g}", WAVES,
         f"forces of the waves that a striker of {mass:g} masses starts, at contact 30", RK4, 1e-3,
         slow=mass == 3)
    def _(laboratory: Laboratory) -> Any:
        ours = [cycle.peak_force_n for cycle in cycles_of(long_row(laboratory, mass), 30)]
        return ours[:len(forces)], forces


striker(2, (.95018, .13456))
striker(3, (1.14351, .32787, .10208, .03317))
striker(4, (1.27722, .49484, .20650, .08885, .03402))


def impurity(ratio: float, passed: float) -> None:
    @row(f"impurity-{ratio:g}", WAVES,
         f"force behind a ball of {ratio:g} masses over the force before it", RK4 + ", end effects",
         1e-3)
    def _(laboratory: Laboratory) -> Any:
        masses = [1.0] * 41
        masses[20] = ratio
        cycles = laboratory.cycles(row_of_balls(masses, 1, 50))
        before, behind = (cycles_of(cycles, place)[0].peak_force_n for place in (10, 34))
        return behind / before, passed


for pair in ((0.25, .97004), (0.5, .96229), (2, .92654), (4, .70169)):
    impurity(*pair)

DROPS = "Two balls dropped on a floor, the lighter on the heavier"


def dropped(ratio: float, upper: float = 1.0, gap: float = 0.0) -> dict[str, Any]:
    """Two balls that reach a floor with velocity 1."""
    return {
        "bodies": [{"name": "lower", "mass_kg": ratio, "radius_m": 0.5, "position_m": 0.5,
                    "velocity_m_per_s": -1},
                   {"name": "upper", "mass_kg": 1, "radius_m": 0.5, "position_m": 1.5 + gap,
                    "velocity_m_per_s": -1}],
        "contacts": [{"name": "floor", "between": ["lower"], "wall": {"side": "LEFT"},
                      "stiffness": 1, "restitution": 1},
                     {"name": "pair", "between": ["lower", "upper"], "stiffness": upper,
                      "restitution": 1}],
        "solver": {"relative_tolerance": 1e-12}, "end_time_s": 400,
        "output": {"ledger_only": True}}


def drop(ratio: float, hard: float, upper: float, lower: float, softer: float) -> None:
    @row(f"drop-{ratio:g}", DROPS, f"m₁/m₂ = {ratio:g}, touching: velocities of upper and lower; "
         "upper with k₂ = k₁/√2", RK4, 1e-5)
    def _(laboratory: Laboratory) -> Any:
        lower_, upper_ = laboratory.velocities(dropped(ratio))
        soft = laboratory.velocities(dropped(ratio, math.sqrt(0.5)))[1]
        return (upper_, lower_, soft), (upper, lower, softer)

    @row(f"drop-hard-{ratio:g}", DROPS, f"m₁/m₂ = {ratio:g}, ten lengths apart: the upper one",
         "textbook: one collision after the other", 1e-5)
    def _(laboratory: Laboratory) -> Any:
        return laboratory.velocities(dropped(ratio, gap=10))[1], hard


for case in ((1, 1, 1.15669, .81368, 1.21084), (2, 5 / 3, 1.47202, .64543, 1.58850),
             (3, 2, 1.54450, .73361, 1.69878), (5, 7 / 3, 1.50440, .86450, 1.69879),
             (10, 29 / 11, 1.26708, .96925, 1.48862), (20, 59 / 21, 1.04155, .99788, 1.14303)):
    drop(*case)


@row("gas-of-equal-balls", ROWS_OF_BALLS,
     "200 hard equal balls only exchange their velocities [m/s]",
     "an elastic collision of equal masses exchanges velocities", 1e-6)
def _(laboratory: Laboratory) -> Any:
    thrown = [math.sin(12.9898 * i) for i in range(200)]
    scenario = row_of_balls([1.0] * 200, 0, 0.4, stiffness=1e14, radius=0.005, gap=0.05)
    for body, velocity in zip(scenario["bodies"], thrown):
        body["velocity_m_per_s"] = velocity
    return sorted(laboratory.velocities(scenario)), sorted(thrown)


@row("two-walls", ROWS_OF_BALLS,
     "speed of a ball [m/s] and time [s] after eight impacts between two walls, ε = 0.7",
     "geometric series, rigid limit", 1e-4, each=True)
def _(laboratory: Laboratory) -> Any:
    scenario = ball_and_wall(1, 1e13, 0.7, 60, velocity=-1, position=0.5)
    scenario["contacts"].append({**scenario["contacts"][0], "name": "right",
                                 "wall": {"side": "RIGHT", "position_m": 1}})
    eighth = sorted(laboratory.cycles(scenario), key=lambda cycle: cycle.start_time_s)[7]
    return ((-eighth.separation_velocity_m_per_s, eighth.start_time_s),
            (0.7**8, 0.5 + sum(0.7**-j for j in range(1, 8))))
