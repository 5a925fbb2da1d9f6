"""Rows of a single collision, which has closed forms: Hertz's, and those of a damped contact."""

from __future__ import annotations

import math
from typing import Any

from laboratory import Laboratory, ball_and_wall
from rows import row

HERTZ = "Hertz 1881, closed form"
CLOSED = "closed form of M1 and M2 (L1 to L3)"
ELASTIC = "A collision without damping"
DAMPED = "A collision with damping"

#: α(ε) of the laws, each with a closed form of what an isolated collision makes of it.
LAWS = {
    "EXACT": lambda e: alpha_of(e),
    "PAPER_EQ23": lambda e: 1.5 * (1 - e * e) / (e * e + e**0.87),
    "HUNT_CROSSLEY": lambda e: 1.5 * (1 - e),
    "LANKARANI_NIKRAVESH": lambda e: 0.75 * (1 - e * e),
    "FLORES": lambda e: 1.6 * (1 - e) / e,
    "HU_GUO": lambda e: 1.5 * (1 - e) / e,
    "LEE_WANG": lambda e: 0.75 * (1 - e),
    "HERBERT_MCWHANNELL": lambda e: 6 * (1 - e) / ((2 * e - 1) ** 2 + 3),
    "ZHIYING_QISHAO": lambda e: 0.75 * (1 - e * e) * math.exp(2 * (1 - e)),
    "GONTHIER": lambda e: (1 - e * e) / e,
    "CARVALHO_MARTINS": lambda e: 1.5 * (1 - e) * (11 - e) / (1 + 9 * e),
    "GHARIB_HURMUZLU": lambda e: 1 / e,
}


def root(function: Any, low: float, high: float) -> float:
    """The root of a function that changes its sign between two numbers, by halving."""
    rising = function(high) > 0
    for _ in range(200):
        middle = (low + high) / 2
        if (function(middle) > 0) == rising:
            high = middle
        else:
            low = middle
    return (low + high) / 2


def alpha_of(restitution: float) -> float:
    """L1: the α that gives an isolated collision this restitution."""
    e = restitution
    return root(lambda a: a * (1 + e) - math.log((1 + a) / (1 - a * e)), 1e-9, (1 - 1e-15) / e)


def restitution_of(alpha: float) -> float:
    """L2: the restitution that α gives an isolated collision."""
    return root(lambda e: alpha * (1 + e) - math.log((1 + alpha) / (1 - alpha * e)), 1e-12,
                min(1.0, (1 - 1e-15) / alpha))


def deepest(mass: float, stiffness: float, velocity: float, exponent: float = 1.5,
            alpha: float = 0.0) -> float:
    """L3: δ_m."""
    loss = (alpha - math.log1p(alpha)) / alpha**2 if alpha else 0.5
    return ((exponent + 1) * mass * velocity**2 / stiffness * loss) ** (1 / (exponent + 1))


def duration(mass: float, stiffness: float, velocity: float, exponent: float = 1.5) -> float:
    """T1: how long an elastic impact lasts."""
    a = 1 / (exponent + 1)
    shape = math.sqrt(math.pi) * math.gamma(1 + a) / math.gamma(0.5 + a)
    return 2 * deepest(mass, stiffness, velocity, exponent) / velocity * shape


def glass(laboratory: Laboratory) -> tuple[Any, float, float]:
    """The cycle of two glass balls, their reduced mass and k."""
    mass = 4 / 3 * math.pi * 0.01**3 * 2800 / 2
    stiffness = 4 / 3 * 48e9 / (2 * (1 - 0.2**2)) * math.sqrt(0.005)
    return laboratory.cycles("glass-balls")[0], mass, stiffness


@row("hertz-deformation", ELASTIC, "δ_m of two glass balls at ±10 m/s [m]", HERTZ, 1e-9)
def _(laboratory: Laboratory) -> Any:
    cycle, mass, stiffness = glass(laboratory)
    return cycle.delta_max_m, deepest(mass, stiffness, 20)


@row("hertz-force", ELASTIC, "their largest force [N]", HERTZ, 1e-9)
def _(laboratory: Laboratory) -> Any:
    cycle, mass, stiffness = glass(laboratory)
    return cycle.peak_force_n, stiffness * deepest(mass, stiffness, 20) ** 1.5


@row("hertz-duration", ELASTIC, "time for which they touch [s]", HERTZ, 1e-9)
def _(laboratory: Laboratory) -> Any:
    cycle, mass, stiffness = glass(laboratory)
    return cycle.end_time_s - cycle.start_time_s, duration(mass, stiffness, 20)


def elastic(exponent: float) -> None:
    @row(f"elastic-{exponent:g}", ELASTIC,
         f"δ_m [m] and duration [s] of an impact with F = k δ^{exponent:g}",
         "closed form with Γ (T1)", 1e-9, each=True)
    def _(laboratory: Laboratory) -> Any:
        cycle = laboratory.cycles(ball_and_wall(
            0.3, 1e7, 1, 1, velocity=-2, position=0.01, exponent=exponent))[0]
        return ((cycle.delta_max_m, cycle.end_time_s - cycle.start_time_s),
                (deepest(0.3, 1e7, 2, exponent), duration(0.3, 1e7, 2, exponent)))


for n in (1.0, 2.0, 3.0, 5.0):
    elastic(n)


def damped(restitution: float) -> None:
    @row(f"mu-{restitution:g}", DAMPED,
         f"μ [N·s/m^2.5] that an isolated collision with ε = {restitution:g} needs", CLOSED, 1e-7)
    def _(laboratory: Laboratory) -> Any:
        cycle = laboratory.cycles(ball_and_wall(
            0.3, 1e7, restitution, 1, velocity=-2, position=0.01))[0]
        return cycle.mu, alpha_of(restitution) * 1e7 / 2


for e in (0.1, 0.3, 0.5, 0.8, 0.95):
    damped(e)


@row("damped-deformation", DAMPED, "δ_m with ε = 0.5 [m]", CLOSED, 1e-9)
def _(laboratory: Laboratory) -> Any:
    cycle = laboratory.cycles(ball_and_wall(0.3, 1e7, 0.5, 1, velocity=-2, position=0.01))[0]
    return cycle.delta_max_m, deepest(0.3, 1e7, 2, alpha=alpha_of(0.5))


@row("unequal-balls", DAMPED, "velocities of balls of 0.1 and 0.7 kg after ε = 0.6 [m/s]",
     "momentum, and Newton's ratio", 1e-9)
def _(laboratory: Laboratory) -> Any:
    scenario = {"bodies[A].mass_kg": 0.1, "bodies[B].mass_kg": 0.7,
                "contacts[0].restitution": 0.6, "solver.restitution_tolerance": 1e-11}
    common, relative = 0.1 / 0.8, 0.6
    return (laboratory.velocities("two-balls", set=scenario),
            (common - relative * 0.7 / 0.8, common + relative * 0.1 / 0.8))


def shape(exponent: float, restitution: float, time: float, force: float, depth: float) -> None:
    @row(f"shape-{exponent:g}-{restitution:g}", DAMPED,
         f"duration, largest force and δ_m with n = {exponent:g}, ε = {restitution:g}, "
         "k = m = v = 1", "numerical integration, another program", 2e-6, each=True)
    def _(laboratory: Laboratory) -> Any:
        cycle = laboratory.cycles(ball_and_wall(
            1, 1, restitution, 10, velocity=-1, exponent=exponent, position=0.5))[0]
        return ((cycle.end_time_s - cycle.start_time_s, cycle.peak_force_n, cycle.delta_max_m),
                (time, force, depth))


for case in ((1.0, 0.7, 3.179214, 0.950529, 0.843272), (1.5, 0.9, 3.255461, 1.085187, 1.048822),
             (1.5, 0.7, 3.373982, 1.033322, 0.953977), (1.5, 0.5, 3.603561, 1.062871, 0.847993),
             (1.5, 0.3, 4.138547, 1.190024, 0.720417), (2.0, 0.7, 3.446729, 1.147743, 1.021744),
             (2.5, 0.7, 3.462070, 1.278378, 1.064474), (3.0, 0.7, 3.449835, 1.418903, 1.092047)):
    shape(*case)


def law(name: str) -> None:
    @row(f"law-{name.lower().replace('_', '-')}", "What damping laws deliver",
         f"ε delivered by {name} for 0.3, 0.5, 0.7, 0.9", CLOSED, 1e-8)
    def _(laboratory: Laboratory) -> Any:
        wanted = (0.3, 0.5, 0.7, 0.9)
        ours = [laboratory.cycles(ball_and_wall(
            0.3, 1e7, e, 1, velocity=-2, position=0.01, damping=name))[0].restitution_out
            for e in wanted]
        return ours, [restitution_of(LAWS[name](e)) for e in wanted]


for known in LAWS:
    law(known)


@row("law-kelvin-voigt", "What damping laws deliver",
     "duration [s] and ε of KELVIN_VOIGT for ε = 0.6", "half a period of the damped oscillator",
     1e-8, each=True)
def _(laboratory: Laboratory) -> Any:
    cycle = laboratory.cycles(ball_and_wall(0.3, 1e6, 0.6, 1, velocity=-2, position=0.01,
                                            exponent=1, damping="KELVIN_VOIGT"))[0]
    damping = -math.log(0.6) / math.hypot(math.pi, math.log(0.6))
    period = math.pi / math.sqrt(1e6 / 0.3 * (1 - damping**2))
    return (cycle.end_time_s - cycle.start_time_s, cycle.restitution_out), (period, 0.6)


@row("law-hertz-quarter-power", "What damping laws deliver",
     "ε of HERTZ_QUARTER_POWER for 0.6 at 0.1, 1 and 10 m/s", "Antypov and Elliott 2011", 1e-7)
def _(laboratory: Laboratory) -> Any:
    ours = [laboratory.cycles(ball_and_wall(
        0.3, 1e8, 0.6, 1, velocity=-v, position=0.01,
        damping="HERTZ_QUARTER_POWER"))[0].restitution_out for v in (0.1, 1, 10)]
    return ours, [0.6] * 3


#: ε asked for, and the ratio of velocities that a linear spring and damper whose force is kept from
#: pulling delivers if its damping is that of the formula for one that pulls.
CLAMPED = ((0.95, 0.95051), (0.9, 0.90203), (0.8, 0.80810), (0.7, 0.71820), (0.6, 0.63229),
           (0.5, 0.55028), (0.4, 0.47201), (0.3, 0.39714))


def clamped(restitution: float) -> float:
    """What it delivers, in closed form."""
    z = -math.log(restitution) / math.hypot(math.pi, math.log(restitution))
    s = math.sqrt(1 - z * z)
    return math.exp(-z / s * (math.pi - math.atan2(2 * z * s, 1 - 2 * z * z)))


def delivered_clamped(laboratory: Laboratory, restitution: float) -> float:
    """The ratio of velocities of KELVIN_VOIGT with `tension: CLIP`."""
    scenario = ball_and_wall(0.3, 1e6, restitution, 1, velocity=-2, position=0.01, exponent=1,
                             damping="KELVIN_VOIGT")
    scenario["solver"] = {**scenario["solver"], "tension": "CLIP"}
    only = laboratory.cycles(scenario)[0]
    return -only.separation_velocity_m_per_s / only.approach_velocity_m_per_s


@row("peers-clamped", "What damping laws deliver",
     "v⁺/v⁻ of a linear spring and damper kept from pulling (the law of MuJoCo, Chrono, and of LAMMPS "
     "and LIGGGHTS with that option), for 0.95 to 0.3", "closed form", 1e-7, each=True)
def _(laboratory: Laboratory) -> Any:
    wanted = [e for e, _ in CLAMPED]
    return ([delivered_clamped(laboratory, e) for e in wanted], [clamped(e) for e in wanted])


@row("peers-clamped-table", "What damping laws deliver", "the same, as solved numerically",
     "another program, five digits", 1e-5, each=True)
def _(laboratory: Laboratory) -> Any:
    return ([delivered_clamped(laboratory, e) for e, _ in CLAMPED], [found for _, found in CLAMPED])
