"""Rows of cases that other programs have solved: the files of tests/reference."""

from __future__ import annotations

from typing import Any

from laboratory import Laboratory, reference, row_of_balls
from rows import row

SOLVED = "Cases that other programs have solved"
OTHER = "tests/reference/"


def chain(place: int) -> None:
    case = reference("chains")[place]
    balls = len(case["masses"])

    @row(f"random-chain-{place + 1}", SOLVED,
         f"a chain of {balls} touching balls, random: final velocities [m/s]",
         f"{OTHER}chains.json", 1e-8)
    def _(laboratory: Laboratory) -> Any:
        scenario = row_of_balls(case["masses"], case["v"][0], 0.03, stiffness=case["k"],
                                restitution=case["eps"], radius=0.05)
        return laboratory.velocities(scenario), case["v_final"]


for number in range(6):  # In the seventh, balls meet again, which that program left out.
    chain(number)


def spring(place: int) -> None:
    case = reference("spring_ball")[place]

    @row(f"spring-{place + 1}", SOLVED,
         f"cycle {place + 1} of the paper's ball on a spring: μ/k [s/m], δ_m [m], end [s]",
         f"{OTHER}spring_ball.json", 1e-4, each=True)
    def _(laboratory: Laboratory) -> Any:
        cycle = laboratory.cycles("spring-wall")[place]
        return ((cycle.mu_over_k_s_per_m, cycle.delta_max_m, cycle.end_time_s),
                (case["mu_over_k"], case["delta_max"], case["t_end"]))


for number in range(6):
    spring(number)


@row("random-groups", SOLVED,
     "random scenarios of two to five bodies: final velocities [m/s] where both programs chose the "
     "same groups, half of 53 at least", f"{OTHER}groups.json", 2e-6)
def _(laboratory: Laboratory) -> Any:
    ours, theirs, same = [], [], 0
    for case in reference("groups"):
        groups = laboratory.run(case["scenario"]).job.groups
        found = sorted((g.contact, g.encounter, g.cycles) for g in groups)
        if found == sorted((g["contact"], g["encounter"], g["cycles"])
                           for g in case["groups"]):
            same += 1
            ours += laboratory.velocities(case["scenario"])
            theirs += case["final_velocities_m_per_s"]
    return (ours, theirs) if 2 * same >= len(reference("groups")) else (float("nan"), 0.0)
