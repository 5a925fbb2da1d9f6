"""Pictures of what the words of the ledger mean: NIRV, groups, JUMP, LIMITED and the others."""

from __future__ import annotations

import itertools
import math
from typing import Any, Iterable

import contactsim
import matplotlib.pyplot as plt
import numpy as np
from contact.v1 import job_pb2

from pictures import COLOURS, of_contact

DENSE = {"output.samples_per_contact": 200}


def told(ax: Any, run: contactsim.Result, contact: str, start: float, end: float,
         quantity: str = "deformation") -> None:
    """A quantity of a contact over time, a shade and a word for each of its cycles."""
    inside = (run["time"] >= start) & (run["time"] <= end)
    values = run[f"{contact}.{quantity}"][inside]
    scale, unit = (1e6, "deformation [µm]") if quantity == "deformation" else (1, "force [N]")
    ax.plot(run["time"][inside] * 1e3, values * scale, color="black", linewidth=1)
    mine = [c for c in run.job.cycles if c.contact == contact and start <= c.end_time_s
            and c.start_time_s < end]
    for place, cycle in enumerate(mine):
        ax.axvspan(cycle.start_time_s * 1e3, min(cycle.end_time_s, end) * 1e3, alpha=0.18,
                   color=COLOURS[place % len(COLOURS)], linewidth=0)
        middle = (max(cycle.start_time_s, start) + min(cycle.end_time_s, end)) / 2
        ax.annotate(f"{word(cycle)} {cycle.number}", (middle * 1e3, 1), ha="center", va="top",
                    xycoords=("data", "axes fraction"), fontsize=7, rotation=90)
    ax.set(xlabel="time [ms]", ylabel=unit, xlim=(start * 1e3, end * 1e3))


def word(cycle: Any) -> str:
    return job_pb2.Cycle.Status.Name(cycle.status)


def kind(cycle: Any) -> str:
    return job_pb2.Cycle.Kind.Name(cycle.kind)


def nirv(client: contactsim.Client) -> Any:
    """The paper's ball on a spring: collisions separate, then cycles follow each other closed."""
    run = client.run("spring-wall", set=DENSE)
    figure, (depth, loops) = plt.subplots(1, 2, width_ratios=(2, 1))
    depth.plot(run["time"] * 1e3, run["ball-wall.deformation"] * 1e3, color="black", linewidth=1)
    depth.axhline(0, color="0.6", linewidth=0.6)
    for cycle in run.job.cycles[:10]:
        depth.axvspan(cycle.start_time_s * 1e3, cycle.end_time_s * 1e3, alpha=0.18, linewidth=0,
                      color=COLOURS[0 if kind(cycle) == "COLLISION" else 1])
        depth.annotate(f"{kind(cycle)} {cycle.number}",
                       ((cycle.start_time_s + cycle.end_time_s) * 500, 1), ha="center", va="top",
                       xycoords=("data", "axes fraction"), fontsize=7, rotation=90)
    depth.set(xlabel="time [ms]", ylabel="deformation [mm]", ylim=(-4, 14), xlim=(0, 32))
    for place, colour in ((3, COLOURS[0]), (5, COLOURS[1])):
        cycle = run.job.cycles[place]
        _, x, force = of_contact(run, "ball-wall", cycle.start_time_s, cycle.end_time_s)
        loops.plot(x * 1e3, force / 1e3, color=colour, label=f"{kind(cycle)} {cycle.number}")
    loops.set(xlabel="deformation [mm]", ylabel="force [kN]")
    loops.legend(frameon=False, fontsize="small")
    return figure


def given(scenario: Any, contact: str, mu: float) -> Any:
    """A scenario in which a contact has this μ."""
    message = contactsim.load_scenario(scenario)
    entry = next(c for c in message.contacts if c.name == contact)
    entry.ClearField("restitution")
    entry.damping, entry.mu = entry.MU, mu
    message.output.ledger_only = True
    return message


def together(cycles: Iterable[Any]) -> float:
    """ε of the summed works of cycles."""
    listed = list(cycles)
    compression = sum(c.work_compression_j for c in listed)
    return math.sqrt(-sum(c.work_restitution_j for c in listed) / compression)


def grown(client: contactsim.Client) -> Any:
    """The wall's second cycle begins compressed, and gives back more than it took at every μ."""
    run = client.run("two-balls-wall", set=DENSE)
    figure, (over_time, over_mu) = plt.subplots(1, 2)
    told(over_time, run, "wall", 1.5e-3, 11e-3)
    mu = np.geomspace(1e8, 8e8, 30)
    rows = [[c for c in client.run(given("two-balls-wall", "wall", value)).job.cycles
             if c.contact == "wall"][:2] for value in mu]
    for place, label in ((slice(0, 1), "first cycle alone"), (slice(1, 2), "second cycle alone"),
                         (slice(0, 2), "both together")):
        over_mu.loglog(mu, [together(cycles[place]) for cycles in rows], label=label)
    over_mu.axhline(0.678, color="0.4", linestyle=":")
    over_mu.plot([run.job.cycles[0].mu], [0.678], "ko", fillstyle="none")
    over_mu.set(xlabel="μ of the wall [N·s/m$^{2.5}$]", ylabel="ε out")
    over_mu.legend(frameon=False, fontsize="small")
    return figure


def infeasible(client: contactsim.Client) -> Any:
    """The same ball where groups may not grow: the second cycle gives back more than it takes."""
    run = client.run("two-balls-wall", set={**DENSE, "solver.restitution_scope": "CYCLE"})
    figure, (over_time, loops) = plt.subplots(1, 2)
    told(over_time, run, "wall", 1.5e-3, 11e-3)
    for cycle, colour in zip((c for c in run.job.cycles if c.contact == "wall"), COLOURS):
        _, depth, force = of_contact(run, "wall", cycle.start_time_s, cycle.end_time_s)
        loops.plot(depth * 1e6, force / 1e3, color=colour, label=f"{word(cycle)} {cycle.number}: "
                   f"W_c {cycle.work_compression_j:.3g} J, W_r {cycle.work_restitution_j:.3g} J")
    loops.set(xlabel="deformation [µm]", ylabel="force [kN]")
    loops.legend(frameon=False, fontsize=7)
    return figure


#: A ball that is held against a wall and struck by a pulse; its eight cycles share one μ.
HELD = {
    "bodies": [{"name": "B1", "mass_kg": 0.66416, "radius_m": 0.02, "position_m": 0.02}],
    "contacts": [{"name": "wall", "between": ["B1"], "wall": {"side": "LEFT"},
                  "stiffness": 6742880.0, "restitution": 0.5391}],
    "loads": [{"body": "B1", "constant": {"force_n": -747.0}},
              {"body": "B1", "half_sine_pulse": {"amplitude_n": -1520.0, "start_time_s": 0.0336,
                                                 "duration_s": 0.000463}}],
    "end_time_s": 0.06719, "solver": {"restitution_scope": "ENCOUNTER"}}


def jump(client: contactsim.Client) -> Any:
    """Below some μ the pulse finds the ball still swinging; above it the ball rests before."""
    run = client.run(HELD)
    found = run.job.groups[0].mu
    figure, (over_time, over_mu) = plt.subplots(1, 2)
    told(over_time, run, "wall", 0, HELD["end_time_s"])
    for low, high in ((0.9 * found, found * (1 - 1e-5)), (found, 1.1 * found)):
        mu = np.linspace(low, high, 16)
        over_mu.plot(mu, [of_group(client.run(given(HELD, "wall", value)).job.cycles)
                          for value in mu], color=COLOURS[0])
    over_mu.axhline(0.5391, color="0.4", linestyle=":")
    over_mu.set(xlabel="μ [N·s/m$^{2.5}$]", ylabel="ε out of the group")
    return figure


def of_group(cycles: Any) -> float:
    """ε of the first group of HELD: eight cycles, or as many as there are before it rests."""
    before = itertools.takewhile(lambda cycle: word(cycle) != "SETTLED", cycles)
    return together(itertools.islice(before, 8))


def pressed(load: dict[str, Any], restitution: float, end: float) -> dict[str, Any]:
    """A ball of half a kilogram that loads press against a wall."""
    return {"bodies": [{"name": "ball", "mass_kg": 0.5}],
            "contacts": [{"name": "wall", "between": ["ball"], "wall": {"side": "RIGHT"},
                          "stiffness": 1.8e7, "restitution": restitution}],
            "loads": [{"body": "ball", **load}], "end_time_s": end,
            "output": {"sample_interval_s": end / 4000}}


def released(client: contactsim.Client) -> Any:
    """A ball is pressed until it rests, then let go: it gives back a part of what was stored."""
    pulse = {"rectangular_pulse": {"force_n": 500, "duration_s": 0.06}}
    run = client.run(pressed(pulse, 0.5, 0.066))
    figure, (depth, force) = plt.subplots(1, 2)
    told(depth, run, "wall", 0, 0.066)
    told(force, run, "wall", 0.058, 0.066, "contact_force")
    return figure


def limited(client: contactsim.Client) -> Any:
    """A fast load drives a contact that never opens: too much comes back, whatever μ is."""
    scenario = pressed({"constant": {"force_n": 500}}, 0.1, 0.012)
    scenario["loads"].append({"body": "ball", "sine": {
        "amplitude_n": 250, "angular_frequency_rad_per_s": 6000}})
    run = client.run(scenario)
    figure, (depth, restitution) = plt.subplots(1, 2)
    told(depth, run, "wall", 0, 0.012)
    run.plot.restitution(restitution)
    return figure


def cut(client: contactsim.Client) -> Any:
    """The run ends while the contact is closed: what comes after is not told as if it were known."""
    whole = client.run("two-balls", set={**DENSE, "end_time_s": 4e-3})
    cycle = whole.job.cycles[0]
    ends = (0.3 * cycle.start_time_s + 0.7 * cycle.turn_time_s,
            0.5 * (cycle.turn_time_s + cycle.end_time_s), 4e-3)
    figure, axes = plt.subplots(1, 3, sharey=True)
    for ax, end in zip(axes, ends):
        run = client.run("two-balls", set={**DENSE, "end_time_s": end})
        told(ax, run, "A-B", cycle.start_time_s - 1e-4, 2.4e-3, "contact_force")
        ax.axvline(end * 1e3, color="0.4", linestyle=":")
        row = run.job.cycles[0]
        ax.set_title(f"peak force {number(row.peak_force_n)}\nε out {number(row.restitution_out)}",
                     fontsize=8)
        ax.set_xlim((cycle.start_time_s - 1e-4) * 1e3, 2.4)
    return figure


def number(value: float) -> str:
    return "not told" if math.isnan(value) else f"{value:.4g}"


def settled(client: contactsim.Client) -> Any:
    """A pressed ball swings ever less, until its cycles have no work that counts."""
    run = client.run(pressed({"step": {"force_n": 500}}, 0.4, 0.03))
    figure, ax = plt.subplots()
    told(ax, run, "wall", 0, 0.03)
    return figure


def not_converged(client: contactsim.Client) -> Any:
    """With one correction the chain's contacts stay above the tolerance; with three they do not."""
    figure, axes = plt.subplots(1, 2, sharey=True)
    for ax, corrections in zip(axes, (1, 50)):
        run = client.run("three-ball-chain", set={"solver.max_iterations": corrections})
        for (contact, rows), colour in zip(run.iterations.groupby("contact"), COLOURS):
            ax.semilogy(rows["pass"], rows.residual.abs().clip(lower=1e-16), "o-", color=colour,
                        label=contact, fillstyle="none")
        ax.set(xlabel="pass", title=f"max_iterations {corrections}: {word(run.job.cycles[0])}")
        ax.axhline(1e-8, color="0.5", linestyle=":")
    axes[0].set_ylabel("|W$_r$/W$_c$ + ε²|")
    axes[0].legend(frameon=False)
    return figure
