"""The paper's 6.1: the triple-ball chain."""

from __future__ import annotations

import dataclasses
import math
from typing import Sequence

import numpy as np
from contact.v1 import job_pb2
from contact.v1.scenario_pb2 import Contact, Scenario, Solver

from ..figures import Curve, Figure, Mark, preset_figure
from ..figures.sweeps import HeatMap
from ..result import Result
from .cases import (Solve, record_ledger_only, solve_as_paper, split_at_peak_force, triple_chain,
                    use_law, use_reference_velocity)
from .items import Data, Item, Number, cycles_of, samples

_VELOCITY = 0.2  # Of the first ball, in m/s.
_CONTACTS = ("B1-B2", "B2-B3")
_RUNS = ("run 0 is Hunt and Crossley, 1 Flores et al., 2 the described method as published, "
         "3 the same converged")
# The models of Figs. 10 to 12 and Table 2. The named laws give both contacts the factor for 0.8.
_MODELS = {"Hunt and Crossley": Contact.HUNT_CROSSLEY, "Flores et al.": Contact.FLORES,
           "Described method": Contact.ENERGY_RESTITUTION}
# Restitution that the paper's Table 2 prints for each model and contact.
_PUBLISHED = ((0.8453, 0.8661), (0.8020, 0.8306), (0.8067, 0.7059))
_TABLE_3 = ("The cells of the printed Table 3 cannot be told apart in the text of the paper, and no "
            "map of them was published: there is nothing to compare these numbers with.")
_MARKS = (Mark.LINE, Mark.DASHED, Mark.DOTTED)  # Of the balls.


def chain_figures(solve: Solve) -> list[Item]:
    """fig9 to fig12."""
    runs = solve([*map(_as_published, _MODELS.values()), _converged(Contact.ENERGY_RESTITUTION)])

    def item(id_: str, title: str, figure: Figure, columns: Sequence[str],
             headers: Sequence[str]) -> Item:
        figure.title = title
        return Item(id_, title, data=[samples(id_, columns, headers, runs, _RUNS)], figure=figure)
    loops = [f"{contact}.{column}" for contact in _CONTACTS
             for column in ("deformation", "contact_force")]
    return [
        item("fig9", "Velocities of the balls", _velocities(runs[2]),
             ["B1.velocity", "B2.velocity", "B3.velocity"],
             ["velocity_b1 [m/s]", "velocity_b2 [m/s]", "velocity_b3 [m/s]"]),
        item("fig10", "Contact forces", _models("force", runs),
             [f"{contact}.contact_force" for contact in _CONTACTS],
             ["force_b12 [N]", "force_b23 [N]"]),
        item("fig11", "Deformation velocities", _models("deformation-velocity", runs),
             [f"{contact}.deformation_velocity" for contact in _CONTACTS],
             ["deformation_velocity_b12 [m/s]", "deformation_velocity_b23 [m/s]"]),
        item("fig12", "Hysteresis loops: force against deformation", _models("hysteresis", runs),
             loops, ["deformation_b12 [m]", "force_b12 [N]", "deformation_b23 [m]",
                     "force_b23 [N]"])]


def chain_tables(solve: Solve) -> list[Item]:
    """table2, table3."""
    scenarios = [*map(_as_published, _MODELS.values()), *map(_converged, _MODELS.values())]
    for scenario in scenarios:
        record_ledger_only(scenario)
    runs = solve(scenarios)
    return [_table_2(runs[:3], runs[3:]), _table_3(solve)]


def _as_published(damping: int) -> Scenario:
    scenario = triple_chain(0.8, 0.7)
    if damping == Contact.ENERGY_RESTITUTION:
        use_reference_velocity(scenario, _VELOCITY)
    else:
        use_law(scenario, damping, 0.8, _VELOCITY)
    solve_as_paper(scenario, Solver.PAPER_RATIO, 0.01)
    split_at_peak_force(scenario)
    return scenario


def _converged(damping: int) -> Scenario:
    scenario = triple_chain(0.8, 0.7)
    if damping != Contact.ENERGY_RESTITUTION:
        use_law(scenario, damping, 0.8, _VELOCITY)
    return scenario


def _velocities(run: Result) -> Figure:
    """B1 solid, B2 dashed, B3 dotted."""
    figure = preset_figure("velocity", run)
    for curve in figure.panels[0].curves:
        if curve.mark is Mark.LINE:
            curve.mark = _MARKS[curve.colour]
    return figure


def _models(preset: str, runs: Sequence[Result]) -> Figure:
    """A preset of several runs over each other, a colour for each run; the first contact is solid, the
    second dashed. Bands and μ/k are those of the last run."""
    drawn = [preset_figure(preset, run) for run in runs[:len(_MODELS)]]
    figure = drawn[-1]
    panel = figure.panels[0]
    curves = [_of_model(curve, name, colour)
              for colour, (name, one) in enumerate(zip(_MODELS, drawn))
              for curve in one.panels[0].curves
              if curve.mark is not Mark.DASHED]  # External forces would hide the others.
    labels = [dataclasses.replace(label, y=max(  # Above all peaks.
                  one.panels[0].labels[i].y for one in drawn if i < len(one.panels[0].labels)))
              for i, label in enumerate(panel.labels)]
    figure.panels = [dataclasses.replace(panel, curves=curves, labels=labels, dashed="")]
    figure.sources = [source for one in drawn for source in one.sources]
    return figure


def _of_model(curve: Curve, name: str, colour: int) -> Curve:
    second = curve.mark is Mark.LINE and curve.colour == 1
    return dataclasses.replace(curve, label=f"{name}, {curve.label}" if curve.label else "",
                               colour=colour, mark=Mark.DASHED if second else curve.mark)


def _table_2(published: Sequence[Result], converged: Sequence[Result]) -> Item:
    numbers = [Number(f"{model}, ε_out {contact}", printed,
                      cycles_of(paper, contact)[0].restitution_out,
                      cycles_of(best, contact)[0].restitution_out, 7e-4,
                      "published with the phases split at the largest force, not at δ̇ = 0")
               for model, row, paper, best in zip(_MODELS, _PUBLISHED, published, converged)
               for contact, printed in zip(_CONTACTS, row)]
    ours, exact = (1.0 + cycles_of(runs[2], "B1-B2")[0].iterations for runs in (published, converged))
    numbers.append(Number("Described method, passes", 6.0, ours, exact, limit=0.0))
    return Item("table2", "Restitution that each model delivers", numbers)


def _table_3(solve: Solve) -> Item:
    cells = [(v / 10.0, e / 100.0) for v in range(1, 6) for e in range(95, 49, -5)]
    runs = solve([scenario for cell in cells for scenario in _table_3_scenarios(*cell)])
    rows = [(*cell, _passes(paper), _passes(ours))
            for cell, paper, ours in zip(cells, runs[::2], runs[1::2])]
    columns = ["velocity [m/s]", "restitution", "passes_published_process", "passes_converged"]
    numbers = [Number(f"v {velocity:.1f} m/s, ε {restitution:.2f}", process=paper, converged=ours)
               for velocity, restitution, paper, ours in rows]
    return Item("table3", "Passes until the chain's restitutions are met: published process to 1 %, "
                "ours to 1e-8", numbers, [Data("table3", columns, rows)], note=_TABLE_3,
                map=_map_of(rows))


def _map_of(rows: Sequence[tuple[float, ...]]) -> HeatMap:
    """The passes of the published process, as the table has them: a row a velocity, a column an ε."""
    velocities, restitutions = (list(dict.fromkeys(row[i] for row in rows)) for i in (0, 1))
    passes = np.array([row[2] for row in rows]).reshape(len(velocities), len(restitutions))
    words = np.where(np.isnan(passes), "not converged", "").astype(object)
    none = dict.fromkeys(("failed", "CUT", "no contact", "<= 0", "none"), 0)
    return HeatMap("Passes by the published process", "restitution asked for [1]", "velocity of B1 [m/s]",
                   "passes", [f"{e:.2f}" for e in restitutions], [f"{v:.1f}" for v in velocities],
                   passes, words, False, none, [])


def _table_3_scenarios(velocity: float, restitution: float) -> tuple[Scenario, Scenario]:
    """By the process of the paper, and by the default solver."""
    exact = triple_chain(restitution, restitution, velocity)
    exact.end_time_s = 1e-2
    record_ledger_only(exact)
    paper = Scenario()
    paper.CopyFrom(exact)
    use_reference_velocity(paper, velocity)
    solve_as_paper(paper, Solver.PAPER_RATIO, 0.01)
    split_at_peak_force(paper)
    return paper, exact


def _passes(run: Result) -> float:
    """Passes that a run took; NaN if a cycle did not converge."""
    done = all(cycle.status == job_pb2.Cycle.CONVERGED for cycle in run.job.cycles)
    passes: float = 1.0 + run.job.cycles[0].iterations if done else math.nan
    return passes
