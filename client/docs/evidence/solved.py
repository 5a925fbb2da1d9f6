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


def groups(place: int) -> None:
    case = reference("groups")[place]
    title = case["scenario"]["title"]

    @row(f"groups-{title.replace(' ', '-')}", SOLVED,
         f"μ of each group of the random scenario `{title}` [N·s/m^2.5]", f"{OTHER}groups.json",
         1e-6, each=True)
    def _(laboratory: Laboratory) -> Any:
        job = laboratory.run(case["scenario"]).job
        found = {(g.contact, g.encounter, g.first_cycle): g.mu for g in job.groups}
        named = [((g["contact"], g["encounter"], g["first_cycle"]), g["mu"])
                 for g in case["groups"] if g["mu"] and g["end"] != "RUN_END"]
        return ([found.get(name, float("nan")) for name, _ in named], [mu for _, mu in named])


for number in range(len(reference("groups"))):
    groups(number)
