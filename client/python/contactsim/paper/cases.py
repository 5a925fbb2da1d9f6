"""The scenarios of the paper, and the ways in which it solves them."""

from __future__ import annotations

from typing import Any, Callable, Sequence

from contact.v1 import scenario_pb2
from contact.v1.scenario_pb2 import Body, Contact, Load, Output, Scenario, Solver, Support, Wall

from ..result import Result

#: Runs scenarios; the results are in their order.
Solve = Callable[[Sequence[Scenario]], Sequence[Result]]

STUDY_VELOCITY = 0.5  #: Speed of the balls of section 3, in m/s.
STUDY_STIFFNESS = 2.41e10  #: Of their contacts, in N/m^1.5.


def _ball(name: str, position: float, velocity: float) -> scenario_pb2.Body:
    return Body(name=name, mass_kg=0.5, radius_m=0.05, position_m=position,
                velocity_m_per_s=velocity)


def _wall(ball: str, position: float, **fields: Any) -> scenario_pb2.Contact:
    return Contact(between=[ball], wall=Wall(position_m=position, side=Wall.RIGHT), **fields)


def triple_chain(restitution12: float, restitution23: float,
                 velocity: float = 0.2) -> scenario_pb2.Scenario:
    """The paper's 6.1: three balls in a row, the first with a velocity."""
    pairs = (("B1", "B2", restitution12), ("B2", "B3", restitution23))
    return Scenario(
        title="Triple-ball chain, paper 6.1",
        bodies=[_ball("B1", 0, velocity), _ball("B2", 0.1, 0), _ball("B3", 0.2, 0)],
        contacts=[Contact(name=f"{left}-{right}", between=[left, right], stiffness=1e8,
                          restitution=restitution) for left, right, restitution in pairs],
        end_time_s=3e-3, output=Output(sample_interval_s=5e-6))


def spring_wall() -> scenario_pb2.Scenario:
    """The paper's 6.2: a ball on a spring, pushed against a wall by 500 + 250 sin(2000 t) N."""
    sine = Load.Sine(amplitude_n=250, angular_frequency_rad_per_s=2000)
    return Scenario(
        title="Ball on a spring, paper 6.2", bodies=[_ball("ball", -0.01, 0)],
        contacts=[_wall("ball", 0.048, name="ball-wall", stiffness=1.8e7, restitution=0.9)],
        supports=[Support(body="ball", stiffness_n_per_m=1e6, damping_n_s_per_m=100)],
        loads=[Load(body="ball", constant=Load.Constant(force_n=500)),
               Load(body="ball", sine=sine)],
        end_time_s=0.035, output=Output(sample_interval_s=1e-5))


def collisions(restitutions: Sequence[float], damping: int) -> scenario_pb2.Scenario:
    """The paper's section 3, once for each restitution: a ball against a wall. The contact of
    restitution i is named `i`. Records the ledger only."""
    places = range(len(restitutions))
    return Scenario(
        title="Collisions of the paper's section 3",
        bodies=[_ball(f"ball{i}", i - 0.05, STUDY_VELOCITY) for i in places],
        contacts=[_wall(f"ball{i}", i, name=f"{i}", stiffness=STUDY_STIFFNESS,
                        restitution=restitutions[i], damping=damping) for i in places],
        end_time_s=2e-3, output=Output(ledger_only=True))


def solve_as_paper(scenario: scenario_pb2.Scenario, update: scenario_pb2.Solver.Update,
                   tolerance: float) -> None:
    """By the process of the paper: Runge-Kutta with steps of 1 µs, this update of μ, and the paper's ξ
    for the restitution, relative."""
    scenario.solver.MergeFrom(Solver(method=Solver.RK4, step_s=1e-6, update=update,
                                     restitution_tolerance=tolerance))


def split_at_peak_force(scenario: scenario_pb2.Scenario) -> None:
    """Splits the phases of a cycle at the largest force, as the paper's Table 2 does."""
    scenario.solver.phase_split = Solver.PEAK_FORCE


def use_law(scenario: scenario_pb2.Scenario, damping: int, restitution: float,
            velocity: float) -> None:
    """Gives every contact this law, this restitution, and the velocity of which the law makes μ."""
    for contact in scenario.contacts:
        contact.damping = damping
        contact.restitution = restitution
        contact.reference_velocity_m_per_s = velocity


def use_reference_velocity(scenario: scenario_pb2.Scenario, velocity: float) -> None:
    """Makes the first μ of every contact of this velocity, as 6.1 does."""
    for contact in scenario.contacts:
        contact.reference_velocity_m_per_s = velocity


def record_ledger_only(scenario: scenario_pb2.Scenario) -> None:
    """Makes a scenario record no trajectory."""
    scenario.output.CopyFrom(Output(ledger_only=True))
