"""Rows of what the paper prints, computed with the settings and the process of the paper."""

from __future__ import annotations

from typing import Any

from laboratory import Laboratory
from rows import row

PAPER = "The paper"

#: Sect. 6.1: fixed steps, update (31), phases split at the largest force, 0.2 m/s for both contacts.
CHAIN = {"solver.method": "RK4", "solver.update": "PAPER_RATIO",
         "solver.phase_split": "PEAK_FORCE", "solver.restitution_tolerance": 0.01,
         "contacts[*].reference_velocity_m_per_s": 0.2}
#: Sect. 6.2: fixed steps, a tolerance of 0.5 %.
SPRING = {"solver.method": "RK4", "solver.restitution_tolerance": 0.005}

#: Table 3 as another program solved it: ε of both contacts, α of the first and of the second.
EQUAL = ((0.95, .087346, .098950), (0.9, .188225, .216388), (0.85, .306477, .356961),
         (0.8, .447341, .526944), (0.75, .617717, .734634), (0.7, .826069, .990693),
         (0.6, 1.392557, 1.701894), (0.5, 2.206096, 2.787331), (0.4, 3.330300, 4.439533),
         (0.3, 4.927446, 7.086591), (0.2, 7.510070, 12.013407))


def delivered(laboratory: Laboratory, **changes: Any) -> list[float]:
    """ε_out of both contacts of the triple chain."""
    settings = {**CHAIN, **changes}
    return [cycle.restitution_out
            for cycle in laboratory.cycles("three-ball-chain", set=settings)]


@row("table2-method", PAPER, "Table 2, described method: ε out of both contacts", "Table 2", 1e-3,
     each=True)
def _(laboratory: Laboratory) -> Any:
    return delivered(laboratory), (0.8067, 0.7059)


def table_2(law: str, published: tuple[float, float], words: str) -> None:
    @row(f"table2-{law.lower().replace('_', '-')}", PAPER,
         f"Table 2, {words}: ε out of both contacts", "Table 2", 1e-3, each=True)
    def _(laboratory: Laboratory) -> Any:
        return (delivered(laboratory, **{"contacts[*].damping": law,
                                         "contacts[*].restitution": 0.8}), published)


table_2("HUNT_CROSSLEY", (0.8453, 0.8661), "Hunt and Crossley")
table_2("FLORES", (0.8020, 0.8306), "Flores et al.")


def corrections(laboratory: Laboratory, update: str) -> list[int]:
    """The corrections of μ in the first eleven cycles of Sect. 6.2."""
    cycles = laboratory.cycles("spring-wall", set={**SPRING, "solver.update": update})
    return [cycle.iterations for cycle in cycles[:11]]


@row("table4-newton", PAPER, "Table 4, (29): corrections of μ in cycles 1 to 11", "Table 4", 0.0)
def _(laboratory: Laboratory) -> Any:
    return corrections(laboratory, "PAPER_NEWTON"), (0, 0, 1, 1, 5, 1, 1, 1, 1, 1, 0)


@row("table4-ratio", PAPER, "Table 4, (31): corrections of μ in cycles 1 to 11; "
     "(31) creeps, so a last digit of ε moves the count", "Table 4", 0.14)
def _(laboratory: Laboratory) -> Any:
    return corrections(laboratory, "PAPER_RATIO"), (0, 0, 7, 14, 22, 13, 18, 15, 10, 7, 4)


@row("figure15", PAPER, "Fig. 15: μ/k at the peaks of cycles 1 to 10 [s/m]",
     "Fig. 15, printed as α", 0.05, each=True)
def _(laboratory: Laboratory) -> Any:
    cycles = laboratory.cycles("spring-wall", set={**SPRING, "solver.update": "PAPER_NEWTON"})
    return ([cycle.mu_over_k_s_per_m for cycle in cycles[:10]],
            (.0123, .0176, .0235, .0326, .0460, .0581, .0739, .0894, .0990, .1044))


def misses(laboratory: Laboratory, percents: range) -> float:
    """The largest miss of (23), relative to ε."""
    wanted = [percent / 100 for percent in percents]
    sweep = laboratory.client.sweep(
        "two-balls", {"contacts[0].restitution": wanted}, ["cycles[A-B].restitution_out"],
        set={"contacts[0].damping": "PAPER_EQ23", "end_time_s": 1.0, "output.ledger_only": True})
    delivered_ = sweep.frame["cycles[A-B].restitution_out"]
    return float(max(abs(delivered_ / wanted - 1)))


@row("figure4-low", PAPER, "Fig. 4: largest miss of (23) for ε from 0.05 to 0.30",
     "Sect. 3: 2.9 %", 0.05)
def _(laboratory: Laboratory) -> Any:
    return misses(laboratory, range(5, 31, 5)), 0.029


@row("figure4-high", PAPER, "Fig. 4: largest miss of (23) above 0.30", "Sect. 3: 0.8 %", 0.02)
def _(laboratory: Laboratory) -> Any:
    return misses(laboratory, range(35, 100, 5)), 0.008


CHAIN_61 = "The paper's chain, solved to the end"


@row("chain-mu", CHAIN_61, "μ of both contacts of the triple-ball chain [N·s/m^2.5]",
     "another program, to 1e-9", 1e-8, each=True)
def _(laboratory: Laboratory) -> Any:
    cycles = laboratory.cycles("three-ball-chain", set={"solver.restitution_tolerance": 1e-11})
    return [cycle.mu for cycle in cycles], (2.259378079e8, 4.563828953e8)


@row("chain-velocities", CHAIN_61, "its final velocities [m/s]", "another program, to 1e-11", 1e-9)
def _(laboratory: Laboratory) -> Any:
    return (laboratory.velocities("three-ball-chain", set={"solver.restitution_tolerance": 1e-11}),
            (-0.003731206344, 0.048726255138, 0.155004951207))


@row("chain-ends", CHAIN_61, "when its contacts part [s]", "another program, to 1e-12", 1e-9,
     each=True)
def _(laboratory: Laboratory) -> Any:
    cycles = laboratory.cycles("three-ball-chain", set={"solver.restitution_tolerance": 1e-11})
    return [cycle.end_time_s for cycle in cycles], (2.154799718e-3, 2.576052458e-3)


@row("chain-depth-force", CHAIN_61, "δ_m [m] and largest force [N] of both contacts",
     "another program, six digits", 1e-5, each=True)
def _(laboratory: Laboratory) -> Any:
    cycles = laboratory.cycles("three-ball-chain", set={"solver.restitution_tolerance": 1e-11})
    return ([cycle.delta_max_m for cycle in cycles] + [cycle.peak_force_n for cycle in cycles],
            (99.166e-6, 79.867e-6, 104.652, 79.405))


def alphas(laboratory: Laboratory, restitution: float, velocity: float = 0.2) -> list[float]:
    """α of both contacts, that of the second by the velocity of the first."""
    cycles = laboratory.cycles("three-ball-chain", set={
        "contacts[*].restitution": restitution, "bodies[0].velocity_m_per_s": velocity,
        "end_time_s": 0.02 * 0.2 / velocity})
    first = {cycle.contact: cycle for cycle in reversed(cycles)}
    return [first[name].mu_over_k_s_per_m * velocity for name in ("B1-B2", "B2-B3")]


def equal(restitution: float, first: float, second: float) -> None:
    @row(f"table3-{restitution:g}", "The paper's Table 3, solved",
         f"α of both contacts with ε = {restitution:g}", "another program, six digits", 1e-5,
         each=True)
    def _(laboratory: Laboratory) -> Any:
        return alphas(laboratory, restitution), (first, second)


for case in EQUAL:
    equal(*case)


@row("table3-velocity", "The paper's Table 3, solved",
     "α of both contacts at 0.5 m/s beside those at 0.1 m/s, ε = 0.7",
     "scale invariance: α does not depend on the velocity", 1e-7, each=True)
def _(laboratory: Laboratory) -> Any:
    return alphas(laboratory, 0.7, 0.5), alphas(laboratory, 0.7, 0.1)


def laws(law: str, factor: float, found: tuple[float, float]) -> None:
    @row(f"chain-{law.lower().replace('_', '-')}", CHAIN_61,
         f"ε that α = {factor:g} ({law}) gives both contacts, phases split at δ̇ = 0",
         "another program, five digits", 2e-5, each=True)
    def _(laboratory: Laboratory) -> Any:
        cycles = laboratory.cycles("three-ball-chain", set={
            "contacts[*].damping": law, "contacts[*].restitution": 0.8,
            "contacts[*].reference_velocity_m_per_s": 0.2})
        return [cycle.restitution_out for cycle in cycles], found


laws("HUNT_CROSSLEY", 0.30, (0.85229, 0.87044))
laws("FLORES", 0.40, (0.81545, 0.83841))
