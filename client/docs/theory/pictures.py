"""Pictures of the cycle, of the search for μ, and of bodies in clusters."""

from __future__ import annotations

import math
from typing import Any

import contactsim
import matplotlib.pyplot as plt

COMPRESSION, RESTITUTION, LOST = "#0072B2", "#D55E00", "0.85"
COLOURS = (COMPRESSION, RESTITUTION, "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
ONE = {"contacts[0].restitution": 0.5, "end_time_s": 2.2e-3, "output.samples_per_contact": 400}


def of_contact(run: contactsim.Result, contact: str, start: float, end: float) -> tuple:
    """Time, deformation and force of a contact between two instants."""
    inside = (run["time"] >= start) & (run["time"] <= end)
    return tuple(run[name][inside] for name in (
        "time", f"{contact}.deformation", f"{contact}.contact_force"))


def halves(run: contactsim.Result, cycle: Any) -> tuple[tuple, tuple]:
    """A cycle's compression and its restitution."""
    return (of_contact(run, cycle.contact, cycle.start_time_s, cycle.turn_time_s),
            of_contact(run, cycle.contact, cycle.turn_time_s, cycle.end_time_s))


def cycle(client: contactsim.Client) -> Any:
    """One collision over time, and as a loop whose area is the energy lost."""
    run = client.run("two-balls", set=ONE)
    only = run.job.cycles[0]
    figure, (over_time, loop) = plt.subplots(1, 2)
    for (time, depth, force), colour, label in zip(
            halves(run, only), (COMPRESSION, RESTITUTION), ("compression", "restitution")):
        over_time.plot((time - only.start_time_s) * 1e3, force, color=colour, label=label)
        loop.plot(depth * 1e6, force, color=colour)
    there, back = halves(run, only)
    loop.fill(list(there[1] * 1e6) + list(back[1] * 1e6), list(there[2]) + list(back[2]),
              color=LOST, zorder=0)
    loop.text(0.62, 0.62, f"lost: {only.work_compression_j + only.work_restitution_j:.3g} J",
              transform=loop.transAxes, ha="center", fontsize="small")
    over_time.set(xlabel="time since the touch [ms]", ylabel="contact force [N]")
    loop.set(xlabel="deformation [µm]", ylabel="contact force [N]",
             title=f"ε = √(−W_r/W_c) = {only.restitution_out:.3g}")
    over_time.legend(frameon=False)
    return figure


def damping(client: contactsim.Client) -> Any:
    """Loops of the same collision for several ε, each with the μ that was found for it."""
    figure, ax = plt.subplots()
    for restitution, colour in zip((1.0, 0.8, 0.5, 0.2), COLOURS):
        run = client.run("two-balls", set={**ONE, "contacts[0].restitution": restitution,
                                           "end_time_s": 4e-3})
        only = run.job.cycles[0]
        _, depth, force = of_contact(run, only.contact, only.start_time_s, only.end_time_s)
        ax.plot(depth * 1e6, force, color=colour, label=f"ε = {restitution:g}: μ = {only.mu:.3g}")
    ax.set(xlabel="deformation [µm]", ylabel="contact force [N]")
    ax.legend(frameon=False, title="μ in N·s/m$^{2.5}$")
    return figure


def iteration(client: contactsim.Client) -> Any:
    """How far ε of the chain's worse contact is off, pass by pass, of four ways to correct μ."""
    figure, ax = plt.subplots()
    ways = {"Newton on both contacts together": {},
            "(29), each contact on its own": {"solver.update": "PAPER_NEWTON"},
            "(31), each contact on its own": {"solver.update": "PAPER_RATIO"},
            "bisection, each contact on its own": {"solver.update": "PAPER_BISECTION"}}
    for (label, settings), colour in zip(ways.items(), COLOURS):
        run = client.run("three-ball-chain", set={"solver.restitution_tolerance": 1e-6, **settings})
        worst = run.iterations.assign(off=(
            run.iterations.restitution_out / [asked(run, c) for c in run.iterations.contact] - 1
        ).abs()).groupby("pass").off.max()
        ax.semilogy(worst.index, worst.clip(lower=1e-16), "o-", color=colour, label=label,
                    fillstyle="none")
    ax.axhline(1e-6, color="0.5", linestyle=":")
    ax.set(xlabel="pass", ylabel="|ε out/ε in − 1|, worse of two", ylim=(1e-13, 1))
    ax.legend(frameon=False, fontsize="small")
    return figure


def asked(run: contactsim.Result, contact: str) -> float:
    """ε asked for at a contact."""
    return next(c.restitution for c in run.scenario.contacts if c.name == contact)


def overlap(client: contactsim.Client) -> Any:
    """The chain's two forces act at the same time, so each changes the other's works."""
    run = client.run("three-ball-chain")
    figure, (forces, velocities) = plt.subplots(1, 2)
    run.plot.force(forces)
    run.plot.velocity(velocities)
    return figure


def gas(balls: int) -> dict[str, Any]:
    """Balls that fly about on a line."""
    return {"bodies": [{"name": f"B{i}", "mass_kg": 0.1, "radius_m": 0.01, "position_m": 0.035 * i,
                        "velocity_m_per_s": round(math.sin(12.9898 * i), 3)} for i in range(balls)],
            "contacts": [{"name": "c", "between": [f"B{i}" for i in range(balls)],
                          "stiffness": 1e7, "restitution": 0.8}],
            "end_time_s": 0.08, "output": {"sample_interval_s": 1e-4}}


def clusters(client: contactsim.Client) -> Any:
    """A gas over time: what touches at the same time has one colour, and was solved together."""
    run = client.run(gas(24))
    figure, ax = plt.subplots(figsize=(7, 3.6))
    for body in run.scenario.bodies:
        ax.plot(run["time"] * 1e3, run[f"{body.name}.position"] * 1e3, color="0.75", linewidth=0.8)
    for cycle_ in run.job.cycles:
        left = int(cycle_.contact.rpartition("-")[2]) - 1
        inside = (run["time"] >= cycle_.start_time_s) & (run["time"] <= cycle_.end_time_s)
        for body in (left, left + 1):
            ax.plot(run["time"][inside] * 1e3, run[f"B{body}.position"][inside] * 1e3,
                    color=COLOURS[cycle_.episode % len(COLOURS)], linewidth=2.5)
    ax.set(xlabel="time [ms]", ylabel="position [mm]")
    return figure
