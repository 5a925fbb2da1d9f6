"""What differs between runs, and whether it matters."""

from __future__ import annotations

import dataclasses
import html
import math
from typing import TYPE_CHECKING, Any, Iterator, Union

import pandas as pd
from contact.v1 import job_pb2
from google.protobuf.json_format import MessageToDict

if TYPE_CHECKING:
    from .result import Result

Value = Union[float, str, None]


@dataclasses.dataclass(frozen=True)
class Comparison:
    """Runs beside each other; the first is the baseline. True if every result holds."""

    #: The fields of the scenarios that differ, by path: a column a run, None where one is not set.
    parameters: pd.DataFrame
    #: The results by name: `unit`, a column a run, `deviation` of the run that is furthest from the
    #: baseline, relative to it, and `holds`. What a run cost is not judged: `holds` is True there.
    results: pd.DataFrame

    def __bool__(self) -> bool:
        return bool(self.results.holds.all())

    @property
    def differing(self) -> pd.DataFrame:
        """The results that do not hold."""
        return self.results[~self.results.holds]

    def _repr_html_(self) -> str:
        verdict = "all results hold" if self else f"{len(self.differing)} results differ"
        shown = self.results if self else self.differing
        return (f"<p><b>{html.escape(verdict)}</b></p>{self.parameters.to_html(max_rows=20)}"
                f"{shown.to_html(max_rows=40)}")


def compare(first: Result, *others: Result, abs_tol: float = 1e-12,
            rel_tol: float = 1e-6) -> Comparison:
    """What differs between the first run, the baseline, and others.

    A number may be `max(abs_tol, rel_tol · |baseline|)` from that of the baseline; words, such as
    a status, must be equal. A result that a run has not differs.
    """
    if not others:
        raise TypeError("compare() needs two results or more")
    runs = (first, *others)
    names = [run.name for run in runs]
    rows: dict[str, dict[str, Any]] = {}
    for place, run in enumerate(runs):
        for name, unit, value, judged in _results(run.job):
            row = rows.setdefault(name, {"unit": unit, "judged": judged,
                                         "values": [None] * len(runs)})
            row["values"][place] = value
    return Comparison(_parameters(runs, names), _table(rows, names, abs_tol, rel_tol))


def _table(rows: dict[str, dict[str, Any]], names: list[str], abs_tol: float,
           rel_tol: float) -> pd.DataFrame:
    lines = []
    for row in rows.values():
        base, *values = row["values"]
        holds = not row["judged"] or all(_near(base, value, abs_tol, rel_tol) for value in values)
        deviations = [_deviation(base, value) for value in values]
        lines.append([row["unit"], base, *values, max(deviations, key=_size), holds])
    index = pd.Index(list(rows), name="result")
    return pd.DataFrame(lines, columns=["unit", *names, "deviation", "holds"], index=index)


def _near(base: Value, value: Value, abs_tol: float, rel_tol: float) -> bool:
    if not isinstance(base, float) or not isinstance(value, float):
        return base == value
    if math.isnan(base) or math.isnan(value):
        return math.isnan(base) and math.isnan(value)
    return abs(value - base) <= max(abs_tol, rel_tol * abs(base)) or value == base


def _deviation(base: Value, value: Value) -> float:
    """Relative to the baseline, or absolute where that is 0; NaN unless both are numbers."""
    if not isinstance(base, float) or not isinstance(value, float):
        return math.nan
    return (value - base) / abs(base) if base else value


def _size(deviation: float) -> float:
    return -1.0 if math.isnan(deviation) else abs(deviation)


def _parameters(runs: tuple[Result, ...], names: list[str]) -> pd.DataFrame:
    fields = [dict(_flat(MessageToDict(run.scenario, preserving_proto_field_name=True)))
              for run in runs]
    paths = sorted({path for of_run in fields for path in of_run})
    table = {path: [of_run.get(path) for of_run in fields] for path in paths}
    different = {path: values for path, values in table.items()
                 if any(value != values[0] for value in values[1:])}
    return pd.DataFrame(list(different.values()), columns=names,
                        index=pd.Index(list(different), name="parameter"), dtype=object)


def _flat(value: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """The fields of a message by their paths, as in a scenario file."""
    if isinstance(value, dict):
        for name, part in value.items():
            yield from _flat(part, f"{path}.{name}" if path else name)
    elif isinstance(value, list):
        for index, part in enumerate(value):
            yield from _flat(part, f"{path}[{index}]")
    else:
        yield path, value


def _restitution(cycle: job_pb2.Cycle) -> float:
    """ε of a cycle; NaN where it says nothing, whatever an earlier server wrote."""
    silent = cycle.status in (job_pb2.Cycle.SETTLED, job_pb2.Cycle.RELEASED)
    return math.nan if silent else cycle.restitution_out


def _results(job: job_pb2.Job) -> Iterator[tuple[str, str, Value, bool]]:
    """Name, unit, value of each result, and whether it is judged."""
    yield "state", "", job_pb2.Job.State.Name(job.state), True
    yield "convergence", "", job_pb2.Job.Convergence.Name(job.convergence), True
    yield "cycles", "1", float(len(job.cycles)), True
    for cycle in job.cycles:
        name = f"{cycle.contact} #{cycle.number}"
        yield f"{name} status", "", job_pb2.Cycle.Status.Name(cycle.status), True
        yield f"{name} end", "", job_pb2.Cycle.End.Name(cycle.end), True
        yield f"{name} μ", "N·s/m^(n+1)", cycle.mu, True
        yield f"{name} ε out", "1", _restitution(cycle), True
        yield f"{name} peak force", "N", cycle.peak_force_n, True
        yield f"{name} δ max", "m", cycle.delta_max_m, True
        yield f"{name} t end", "s", cycle.end_time_s, True
    for group in job.groups:
        if group.cycles == 1:
            continue  # The row of the cycle tells all.
        name = f"{group.contact} group {group.number}"
        last = group.first_cycle + group.cycles - 1
        yield f"{name} cycles", "", f"{group.first_cycle} to {last}", True
        yield f"{name} ε out", "1", group.restitution_out, True
        yield f"{name} t end", "s", group.end_time_s, True
    for body in job.final_bodies:
        yield f"{body.name} final position", "m", body.position_m, True
        yield f"{body.name} final velocity", "m/s", body.velocity_m_per_s, True
    summary = job.summary
    yield "kinetic energy at the end", "J", summary.kinetic_energy_j, True
    yield "iterations", "1", float(summary.iterations), False
    yield "steps", "1", float(summary.steps), False
    yield "wall time", "s", summary.wall_time_s, False
