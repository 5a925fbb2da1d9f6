"""A page about runs that needs no network: ledger, figures, balances, how to repeat them."""

from __future__ import annotations

import json
import math
from typing import Any, Sequence

import yaml
from contact.v1 import event_pb2, job_pb2
from google.protobuf.json_format import MessageToDict

from .comparing import Comparison, compare
from .figures import PRESETS, Figure, FigureError, preset_figure
from .figures.figure import thin
from .figures.overlay import overlay_figure
from .figures.words import WORDS
from .html import Row, escape, page, table
from .model import solver_in_full
from .result import Result

_MOST_ROWS = 200  # Of a table; the rest is for export.
_POINTS = 500  # Of a curve, so that the page of a long run stays small.
_MISSED = (job_pb2.Cycle.NOT_CONVERGED, job_pb2.Cycle.INFEASIBLE)
_SILENT = (job_pb2.Cycle.SETTLED, job_pb2.Cycle.RELEASED)


def report_page(runs: Sequence[Result], server: str, draw: bool = True) -> str:
    """The page of runs, the first of which is the baseline; without figures if not `draw`."""
    title = (f"Report of {len(runs)} runs" if len(runs) > 1 else
             runs[0].scenario.title or runs[0].name)
    differences = _differences(runs, draw) if len(runs) > 1 else ""
    sections = "".join(_section(run, place, server, draw) for place, run in enumerate(runs))
    return page(title, _contents(runs) + differences + sections + (_script() if draw else ""))


def _contents(runs: Sequence[Result]) -> str:
    """Every run in a line: how it went, and where on the page what of it is."""
    lines = []
    for run in runs:
        job = run.job
        links = [_link(f"{part}-{run.name}", words) for part, words in (
            ("ledger", "ledger"), ("figures", "figures"), ("iteration", "iteration of μ"),
            ("repeat", "how to repeat it"))]
        count = job.summary.cycles
        lines.append(f"{_link(f'run-{run.name}', _title(run))}: {_state(job)}, {count} "
                     f"cycle{'s' * (count != 1)}; {', '.join(links)}")
    if len(runs) > 1:
        lines.append(_link("differences", "where they differ"))
    return f"<nav><ul>\n{''.join(f'<li>{line}</li>' + chr(10) for line in lines)}</ul></nav>\n"


def _section(run: Result, place: int, server: str, draw: bool) -> str:
    job = run.job
    return "".join([
        _heading(2, f"run-{run.name}", _title(run)), f"<p>{_state(job)}.</p>\n", _warnings(job),
        _heading(3, f"ledger-{run.name}", "Ledger"), _ledger(job), _groups(job), _bodies(job),
        "<h3>Balances</h3>\n", _balances(job.summary),
        _heading(3, f"figures-{run.name}", "Figures"), _figures(run, place) if draw else "",
        _heading(3, f"iteration-{run.name}", "Iteration of μ"), _iterations(run),
        _heading(3, f"repeat-{run.name}", "How to repeat it"), _repeat(run, server)])


# The page has positions and maps.
_LEFT_OUT = ("displacement", "force-waterfall", "velocity-waterfall")
_FOR_MANY = ("force-map", "velocity-map")


def _figures(run: Result, place: int) -> str:
    """Those of all presets for which the run has data; the page names their source."""
    shown = []
    many = len(run.job.scenario.contacts) > Figure.most_colours
    for preset in PRESETS:
        if preset in _LEFT_OUT or (preset in _FOR_MANY and not many):
            continue
        try:
            figure = preset_figure(preset, run)
        except FigureError:
            continue
        figure.title = WORDS["titles"][preset]
        shown.append(_inline(figure, f"f{place}-{preset}"))
    return "".join(shown)


def _inline(figure: Figure, name: str) -> str:
    from .figures.living import living  # Only figures need matplotlib.

    thin(_POINTS, figure)
    figure.sources = []
    return living(figure, name)


def _script() -> str:
    from .figures.living import SCRIPT

    return f"<p>Drag in a figure to zoom, double-click to see all of it; + − 0 and arrows do so, too. A point tells its " \
           f"values, read off the drawing.</p>\n{SCRIPT}"


def _warnings(job: job_pb2.Job) -> str:
    said = ([job.error.message] if job.HasField("error") else []) + list(job.warnings)
    items = "".join(f"<li>{escape(line)}</li>" for line in said)
    return f"<h3>Warnings</h3>\n<ul>{items}</ul>\n" if said else ""


def _ledger(job: job_pb2.Job) -> str:
    headers = ("Contact", "#", "Group", "Kind", "End", "Status", "n", "μ", "α, or μ/k", "ε in",
               "ε out", "Error", "Peak force [N]", "Start [s]", "End [s]")
    rows = []
    for c in job.cycles:
        alpha = (_digits(c.alpha, 7) if c.kind == job_pb2.Cycle.COLLISION else
                 f"{_digits(c.mu_over_k_s_per_m, 5)} s/m")
        out = math.nan if c.status in _SILENT else c.restitution_out
        rows.append(Row((c.contact, str(c.number), str(c.group or "-"),
                         job_pb2.Cycle.Kind.Name(c.kind), job_pb2.Cycle.End.Name(c.end),
                         job_pb2.Cycle.Status.Name(c.status), str(c.iterations), _digits(c.mu, 7),
                         alpha, _digits(c.restitution_in, 6), _digits(out, 8),
                         _error(out, c.restitution_in), _digits(c.peak_force_n, 7),
                         _digits(c.start_time_s, 7), _digits(c.end_time_s, 7)),
                        c.status in _MISSED))
    return _first(headers, rows, "cycle", "cycles")


def _groups(job: job_pb2.Job) -> str:
    """The groups of which the ledger does not tell all."""
    told = (job_pb2.Cycle.JUMP, job_pb2.Cycle.INFEASIBLE, job_pb2.Cycle.LIMITED,
            job_pb2.Cycle.RELEASED, job_pb2.Cycle.UNFINISHED)
    headers = ("Contact", "Group", "Cycles", "End", "Status", "Grew", "μ", "ε in", "ε out", "Error",
               "Residual", "Start [s]", "End [s]", "ε at too little μ", "ε at too much μ", "Other μ")
    rows = []
    for g in job.groups:
        if g.cycles <= 1 and g.status not in told and not g.other_roots:
            continue
        last = g.first_cycle + g.cycles - 1
        cycles = f"{g.first_cycle} to {last}" if g.cycles > 1 else str(g.first_cycle)
        few = [_reached(g, name) for name in ("too_much", "too_little")]
        rows.append(Row((g.contact, str(g.number), cycles, job_pb2.Cycle.End.Name(g.end),
                         job_pb2.Cycle.Status.Name(g.status), job_pb2.Group.Growth.Name(g.growth),
                         _digits(g.mu, 7), _digits(g.restitution_in, 6),
                         _digits(g.restitution_out, 8), _error(g.restitution_out, g.restitution_in),
                         _power(g.residual), _digits(g.start_time_s, 7), _digits(g.end_time_s, 7),
                         *few, ", ".join(_digits(mu, 7) for mu in g.other_roots)), g.status in _MISSED))
    return "<h3>Groups of cycles</h3>\n" + _first(headers, rows, "group", "groups") if rows else ""


def _reached(group: job_pb2.Group, name: str) -> str:
    """What the search reached of a group that no μ solves, such as `0.71 at μ = 2.1e8`."""
    if not group.HasField(f"{name}_mu"):
        return "-"
    restitution, mu = getattr(group, f"{name}_restitution"), getattr(group, f"{name}_mu")
    return f"{_digits(restitution, 6)} at μ = {_digits(mu, 6)}"


def _bodies(job: job_pb2.Job) -> str:
    rows = [Row((body.name, _digits(body.position_m, 10), _digits(body.velocity_m_per_s, 10)))
            for body in job.final_bodies]
    headers = ("Body", "Final position [m]", "Final velocity [m/s]")
    return _first(headers, rows, "body", "bodies")


def _balances(summary: job_pb2.RunSummary) -> str:
    rows = [Row((name, _power(value))) for name, value in (
        ("Momentum", summary.momentum_residual), ("Energy", summary.energy_residual),
        ("Worst cycle identity", summary.worst_identity_residual))]
    return (table(("Balance", "Relative residual"), rows)
            + f"<p>{summary.time_reached_s:g} s simulated; {summary.steps} steps, "
            f"{summary.evaluations} evaluations, {summary.iterations} iterations in "
            f"{summary.episodes} episodes; {summary.wall_time_s:.3g} s wall time.</p>\n")


def _iterations(run: Result) -> str:
    rows = [Row((str(one.episode), str(one.number), f"{u.contact} #{u.number}", _digits(u.mu, 9),
                 _digits(u.restitution_out, 8), _power(u.residual),
                 "accepted" if one.accepted else event_pb2.Iteration.Update.Name(u.update)))
            for one in run.passes for u in one.unknowns]
    headers = ("Episode", "Pass", "Cycle", "μ", "ε out", "Residual", "Next")
    return (_first(headers, rows, "row", "rows") if rows else "<p>Nothing was iterated.</p>\n")


def _repeat(run: Result, server: str) -> str:
    job = run.job
    told = {"title": run.scenario.title, "job": run.name, "scenario_sha256": job.spec_sha256,
            "version": job.server_version, "revision": job.server_revision,
            "solver": json.dumps(solver_in_full(run.scenario)),
            "convergence": job_pb2.Job.Convergence.Name(job.convergence)}
    how = (f"# while {server} has {run.name}:\ncontactctl --server {server} run --like {run.name}\n"
           "# anywhere: save the scenario below as scenario.yaml, then\n"
           "contactctl run scenario.yaml\n\n")
    lines = "".join(f"{name}: {value}\n" for name, value in told.items())
    scenario = yaml.safe_dump(MessageToDict(run.scenario, preserving_proto_field_name=True),
                              sort_keys=False, allow_unicode=True)
    return (f"<pre>{escape(how + lines)}</pre>\n<h3>Scenario</h3>\n"
            f"<pre>{escape(scenario)}</pre>\n")


def _differences(runs: Sequence[Result], draw: bool) -> str:
    try:
        figure = _inline(overlay_figure(runs), "together") if draw else ""
    except FigureError:
        figure = ""
    return (_heading(2, "differences", "Where they differ") + _compared(compare(*runs)) + figure)


def _compared(comparison: Comparison) -> str:
    parameters = [Row([path, *map(_cell, values)])
                  for path, values in zip(comparison.parameters.index,
                                          comparison.parameters.to_numpy())]
    names = list(comparison.parameters.columns)
    results = [Row([name, *map(_cell, values[1:-2]), _power(values[-2])], not values[-1])
               for name, values in zip(comparison.results.index, comparison.results.to_numpy())]
    same = "<p>The scenarios are the same.</p>\n"
    return ((table(["Parameter", *names], parameters) if parameters else same)
            + table(["Result", *names, "Deviation"], results)
            + "<p>Marked: not equal within 1e-12 or 1e-06 of the baseline.</p>\n")


def _first(headers: Sequence[str], rows: Sequence[Row], one: str, many: str) -> str:
    """A table of the first rows."""
    more = len(rows) - _MOST_ROWS
    rest = f"<p>{more} more {one if more == 1 else many}; contactctl export has all.</p>\n"
    return table(headers, rows[:_MOST_ROWS]) + (rest if more > 0 else "")


def _cell(value: Any) -> str:
    return "not set" if value is None else _digits(value, 9) if isinstance(value, float) else str(value)


def _digits(value: float, digits: int) -> str:
    return "-" if math.isnan(value) else f"{value:.{digits}g}"


def _power(value: float) -> str:
    return "-" if math.isnan(value) else f"{value:.1e}"


def _error(out: float, asked: float) -> str:
    return _power(abs(out - asked) / asked if asked else math.nan)


def _state(job: job_pb2.Job) -> str:
    return (f"{job_pb2.Job.State.Name(job.state)}, convergence "
            f"{job_pb2.Job.Convergence.Name(job.convergence)}")


def _title(run: Result) -> str:
    return escape(f"{run.name}: {run.scenario.title}" if run.scenario.title else run.name)


def _heading(level: int, id_: str, markup: str) -> str:
    return f'<h{level} id="{escape(id_)}">{markup}</h{level}>\n'


def _link(id_: str, markup: str) -> str:
    return f'<a href="#{escape(id_)}">{markup}</a>'
