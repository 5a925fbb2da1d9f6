"""The result of a job."""

from __future__ import annotations

import functools
import html
from typing import TYPE_CHECKING, Any, Mapping

import numpy as np
import pandas as pd
from contact.v1 import event_pb2, job_pb2, scenario_pb2
from google.protobuf.descriptor import FieldDescriptor

from .comparing import Comparison, compare
from .measured import MeasuredLike, SignalComparison, compare_measured
from .model import Array
from .plotting import Plots
from .recording import Recording
from .spelling import expected

if TYPE_CHECKING:
    import xarray

_LEDGER = ("contact", "number", "group", "kind", "end", "status", "mu", "restitution_in",
           "restitution_out", "start_time_s", "end_time_s", "peak_force_n")
# Quantities of the system as a whole.
_OF_SYSTEM = ("kinetic_energy", "contact_energy", "support_energy", "dissipated_energy", "load_work")


class NoChannel(KeyError):
    """The run recorded no such column; the text names those that are near."""

    def __str__(self) -> str:  # That of KeyError is in quotes.
        return str(self.args[0])


class Result:
    """What an ended job computed. Everything is made when it is first asked for, and kept."""

    def __init__(self, job: job_pb2.Job, recording: Recording) -> None:
        self.job = job  #: The Job message, with its spec, ledger and summary.
        self._recording = recording

    @property
    def name(self) -> str:
        """Format: `jobs/{id}`."""
        return self.job.name

    @property
    def scenario(self) -> scenario_pb2.Scenario:
        """What was computed."""
        return self.job.scenario

    @property
    def converged(self) -> bool:
        """True if no cycle misses the restitution asked for. Those that the end of the run cuts do
        not count; `job.summary.cycles_cut` tells how many they are."""
        return self.job.convergence == job_pb2.Job.FULL

    @property
    def arrays(self) -> dict[str, Array]:
        """The trajectory as read-only arrays by name, such as `B1.velocity`; `time` is first."""
        return self._recording.columns

    @property
    def units(self) -> dict[str, str]:
        """The unit of each array."""
        return self._recording.units

    def __getitem__(self, name: str) -> Array:
        """One column of the trajectory, such as `B1-B2.contact_force`."""
        try:
            return self.arrays[name]
        except KeyError:
            raise NoChannel(f"there is no channel {name!r}" + expected(str(name), self.arrays)) from None

    @functools.cached_property
    def series(self) -> pd.DataFrame:
        """The trajectory: a row a sample, indexed by `time [s]`, columns such as
        `B1.velocity [m/s]`.

        It is a copy of `arrays`, made once, and may be changed.
        """
        return series_frame(self.arrays, self.units)

    @functools.cached_property
    def xr(self) -> xarray.Dataset:
        """The trajectory over `time` and `body`, `contact` or `support`, with units as attributes:
        `xr.velocity.sel(body="B1")`, `xr.contact_force.sel(contact="B1-B2")`; energies of the system over
        `time`. A copy, as `series` is. Needs xarray."""
        import xarray  # Only who asks for it needs it.

        bodies = {body.name for body in self.scenario.bodies}
        named = [name.rpartition(".") for name in self.arrays if name != "time"]
        variables: dict[str, Any] = {}
        for quantity in dict.fromkeys(quantity for _, _, quantity in named):
            owners = [owner for owner, _, other in named if other == quantity]
            if owners == ["system"] and quantity in _OF_SYSTEM:
                variables[quantity] = ("time", self[f"system.{quantity}"], {"units": "J"})
                continue
            if quantity == "support_energy":  # That of the system is their sum.
                owners.remove("system")
            dimension = "body" if bodies.issuperset(owners) else \
                "support" if quantity.startswith("support_") else "contact"
            columns = [f"{owner}.{quantity}" for owner in owners]
            variables[quantity] = xarray.DataArray(
                np.column_stack([self.arrays[column] for column in columns]),
                {"time": self["time"], dimension: owners}, ("time", dimension),
                attrs={"units": self.units[columns[0]]})
        data = xarray.Dataset(variables, {"time": np.array(self.arrays.get("time", ()))},
                              self.provenance)
        data.time.attrs["units"] = "s"
        return data

    @functools.cached_property
    def cycles(self) -> pd.DataFrame:
        """The ledger: a row a cycle. `mu` is in N·s/m^(n+1), n the exponent of its contact. What the
        end of the run hides of a cut cycle is NaN."""
        return _frame(job_pb2.Cycle.DESCRIPTOR, self.job.cycles)

    @functools.cached_property
    def newton(self) -> pd.DataFrame:
        """Why Newton's restitution e_N, the ratio of the speeds after and before, is not ε: a row for each
        collision that separates. `external_force_n` is the mean of F_e over the compression, the load P
        that presses where loads are constant; NaN where F_e gives back another work than it takes, so
        that it is no constant. `predicted` is √(ε² − (1 − ε²) 2 P δ_m/(m_e v²)), with m_e v²/2 =
        W_c − P δ_m."""
        cycles = self.cycles
        cycles = cycles[cycles["newton_restitution"] > 0]
        work, back = cycles["external_work_compression_j"], cycles["external_work_restitution_j"]
        steady = (work + back).abs() <= 1e-6 * cycles["work_compression_j"]
        work = work.where(steady)
        e_squared = cycles["restitution_out"]**2
        square = e_squared - (1 - e_squared) * work / (cycles["work_compression_j"] - work)
        return pd.DataFrame({
            "contact": cycles["contact"], "number": cycles["number"],
            "restitution_out": cycles["restitution_out"],
            "newton_restitution": cycles["newton_restitution"],
            "external_force_n": work / cycles["delta_max_m"],
            "predicted": square.clip(lower=0)**0.5}).reset_index(drop=True)

    @functools.cached_property
    def groups(self) -> pd.DataFrame:
        """The groups of cycles that share one μ: a row a group. `mu` as in `cycles`."""
        return _frame(job_pb2.Group.DESCRIPTOR, self.job.groups)

    @functools.cached_property
    def bodies(self) -> pd.DataFrame:
        """The bodies at the end of the run."""
        return _frame(job_pb2.FinalBody.DESCRIPTOR, self.job.final_bodies)

    @property
    def passes(self) -> list[event_pb2.Iteration]:
        """The passes of the search for μ, in their order."""
        return [one for _, one in sorted(self._recording.iterations.items())]

    @functools.cached_property
    def iterations(self) -> pd.DataFrame:
        """The search for μ: a row for each cycle in each pass. `mu` and the bracket are in
        N·s/m^(n+1)."""
        rows = [{"episode": one.episode, "pass": one.number, "start_time_s": one.start_time_s,
                 **_row(unknown), "accepted": one.accepted}
                for one in self.passes for unknown in one.unknowns]
        fields = [field.name for field in event_pb2.Iteration.Unknown.DESCRIPTOR.fields]
        return pd.DataFrame(
            rows, columns=["episode", "pass", "start_time_s", *fields, "accepted"])

    @property
    def plot(self) -> Plots:
        """Plots by preset, such as `plot.hysteresis()`; each returns its matplotlib Axes."""
        return Plots(self)

    @property
    def provenance(self) -> dict[str, str]:
        """What makes the result repeatable."""
        return {"job": self.name, "server_version": self.job.server_version,
                "server_revision": self.job.server_revision,
                "scenario_sha256": self.job.spec_sha256}

    def compare(self, *others: Result, abs_tol: float = 1e-12,
                rel_tol: float = 1e-6) -> Comparison:
        """What differs between this run, the baseline, and others; see compare."""
        return compare(self, *others, abs_tol=abs_tol, rel_tol=rel_tol)

    def compare_measured(self, measured: MeasuredLike, **options: Any) -> SignalComparison:
        """This run beside measured data; see compare_measured for the options."""
        return compare_measured(self, measured, **options)

    def __repr__(self) -> str:
        return f"<Result {self._headline()}>"

    def _headline(self) -> str:
        job = self.job
        convergence = job_pb2.Job.Convergence.Name(job.convergence)
        title = f" '{self.scenario.title}'" if self.scenario.title else ""
        cut = f" ({job.summary.cycles_cut} cut by the end)" if job.summary.cycles_cut else ""
        return (f"{job.name}{title}: {job_pb2.Job.State.Name(job.state)}, convergence "
                f"{convergence}, {len(job.cycles)} cycles{cut}, "
                f"{job.summary.iterations} iterations")

    def _repr_html_(self) -> str:
        ledger = self.cycles[list(_LEDGER)].to_html(index=False, max_rows=20)
        bodies = self.bodies.to_html(index=False, max_rows=20)
        return f"<p><b>{html.escape(self._headline())}</b></p>{ledger}{bodies}"


def series_frame(arrays: Mapping[str, Array], units: Mapping[str, str]) -> pd.DataFrame:
    """Columns such as `B1.velocity [m/s]` over an index of `time [s]`; copies."""
    named = {f"{name} [{units[name]}]": values for name, values in arrays.items()}
    time = named.pop("time [s]", np.empty(0))
    return pd.DataFrame(named, index=pd.Index(np.array(time), name="time [s]"), copy=True)


def _row(message: Any) -> dict[str, Any]:
    return {field.name: _value(field, getattr(message, field.name))
            if not field.has_presence or message.HasField(field.name) else float("nan")
            for field in message.DESCRIPTOR.fields}


def _value(field: FieldDescriptor, value: Any) -> Any:
    """Enum values by name; the unspecified one is empty. Of a list a list."""
    if field.label == field.LABEL_REPEATED:
        return list(value)
    if not field.enum_type:
        return value
    return field.enum_type.values_by_number[value].name if value else ""


def _frame(type_: Any, messages: Any) -> pd.DataFrame:
    return pd.DataFrame([_row(message) for message in messages],
                        columns=[field.name for field in type_.fields])
