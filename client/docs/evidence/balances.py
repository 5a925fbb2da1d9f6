"""Rows of balances: what must be 0 whatever the scenario is."""

from __future__ import annotations

from typing import Any

import contactsim
from laboratory import Laboratory, reference, row_of_balls
from rows import row

BALANCES = "Balances, which are 0 for an exact solution"


def worst(laboratory: Laboratory, field: str) -> float:
    """The largest residual of the shipped scenarios."""
    runs = [laboratory.run(name) for name in contactsim.templates()]
    return max(getattr(run.job.summary, field) for run in runs)


def balance(key: str, field: str, words: str, tolerance: float) -> None:
    @row(f"balance-{key}", BALANCES, f"{words}, worst of the shipped scenarios",
         "conservation law", tolerance)
    def _(laboratory: Laboratory) -> Any:
        return worst(laboratory, field), 0.0


balance("energy", "energy_residual", "energy: motion, springs and contacts against work and loss",
        1e-9)
balance("momentum", "momentum_residual", "momentum against impulse", 1e-12)
balance("cycles", "worst_identity_residual",
        "energy of each cycle, the paper's (32) with F_e of two bodies", 1e-7)


@row("balance-random", BALANCES, "energy of each cycle, worst of the random scenarios of groups.json",
     "conservation law", 1e-7)
def _(laboratory: Laboratory) -> Any:
    runs = [laboratory.run(case["scenario"]) for case in reference("groups")]
    return max(run.job.summary.worst_identity_residual for run in runs), 0.0


@row("elastic-energy", BALANCES, "energy of 40 touching balls after a blow [J]",
     "an elastic row keeps its energy", 1e-9)
def _(laboratory: Laboratory) -> Any:
    velocities = laboratory.velocities(row_of_balls([1.0] * 40, 1, 100))
    return sum(v * v for v in velocities) / 2, 0.5
