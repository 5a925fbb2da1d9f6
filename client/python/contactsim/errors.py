"""What can go wrong, as exceptions that tell where and what to do."""

from __future__ import annotations

import dataclasses
from typing import Any, Iterable, Mapping

import grpc
from contact.rpc import error_details_pb2, status_pb2
from contact.v1 import job_pb2


@dataclasses.dataclass(frozen=True)
class Violation:
    """A field of a scenario or request that is not as it must be."""

    field: str  #: Path of the field, such as `contacts[0].restitution`.
    description: str
    hint: str = ""

    def __str__(self) -> str:
        return f"{self.field}: {self.description}" + (f" — {self.hint}" if self.hint else "")


class ContactError(Exception):
    """Base of all exceptions of this package."""


class CallError(ContactError):
    """A call that the server, or the way to it, refused."""

    def __init__(self, message: str, code: grpc.StatusCode, reason: str = "",
                 metadata: Mapping[str, str] | None = None,
                 violations: Iterable[Violation] = ()) -> None:
        self.code = code
        self.reason = reason  #: ErrorInfo.reason, such as `JOB_NOT_FOUND`; may be empty.
        self.metadata = dict(metadata or {})
        self.violations = list(violations)
        super().__init__("\n".join([message, *(f"  {v}" for v in self.violations)]))


class InvalidScenario(CallError):
    """The scenario breaks rules; `violations` names them all."""

    def __init__(self, violations: Iterable[Violation],
                 metadata: Mapping[str, str] | None = None) -> None:
        super().__init__("the scenario is invalid", grpc.StatusCode.INVALID_ARGUMENT,
                         "SCENARIO_INVALID", metadata, violations)


class Unreachable(CallError):
    """There is no server at the address, or none that takes work now."""


class JobNotFound(CallError):
    """The server has no such job, or the job has no such artifact; `reason` tells which."""


class AmbiguousJob(ContactError, LookupError):
    """Several jobs have names that begin so; `jobs` are the newest of them."""

    def __init__(self, begin: str, jobs: Iterable[job_pb2.Job], more: bool) -> None:
        self.jobs = list(jobs)
        lines = [f"several jobs begin with {begin.removeprefix('jobs/')!r}:"]
        for job in self.jobs:
            lines.append(f"  {job.name.removeprefix('jobs/')}  {job.create_time.ToJsonString()}  "
                         f"{job_pb2.Job.State.Name(job.state)}  {job.title}".rstrip())
        super().__init__("\n".join(lines + ["  … and more"] * more))


class NotAllowed(CallError):
    """The server does not know who calls, or the caller may not do that; `reason` tells which."""


class Overloaded(CallError):
    """The server has too much to do; try again later."""


class Timeout(CallError, TimeoutError):
    """The time given was too short. The job itself goes on."""


class RunFailed(ContactError):
    """The job ended FAILED or CANCELLED; `job` holds what it recorded."""

    def __init__(self, job: job_pb2.Job) -> None:
        self.job = job
        state = job_pb2.Job.State.Name(job.state)
        words = job.error.message or job.state_reason
        super().__init__(f"{job.name} {state}: {words}")


class DownloadFailed(ContactError):
    """What lies in the file is not the artifact that the server has."""


_KINDS: dict[grpc.StatusCode, type[CallError]] = {
    grpc.StatusCode.UNAVAILABLE: Unreachable,
    grpc.StatusCode.NOT_FOUND: JobNotFound,
    grpc.StatusCode.RESOURCE_EXHAUSTED: Overloaded,
    grpc.StatusCode.UNAUTHENTICATED: NotAllowed,
    grpc.StatusCode.PERMISSION_DENIED: NotAllowed,
    grpc.StatusCode.DEADLINE_EXCEEDED: Timeout,
}


def from_rpc(error: grpc.RpcError, address: str) -> CallError:
    """The exception for a failed call, with what its trailers tell."""
    code = error.code()
    info, request = _details(error)
    violations = [_violation(v) for v in request.field_violations]
    if info.reason == "SCENARIO_INVALID":
        return InvalidScenario(violations, info.metadata)
    message = error.details() or code.name
    if code == grpc.StatusCode.UNAVAILABLE and not info.reason:
        message = (f"cannot reach contactd at {address} ({message})\n"
                   f"  start one here:  contactd --listen {address} --data-dir DIR\n"
                   "  or choose one:   Client('HOST:PORT'), or the variable CONTACT_SERVER")
    if code == grpc.StatusCode.DEADLINE_EXCEEDED:
        message = f"{address} did not answer in time; timeout_s gives it longer"
    return _KINDS.get(code, CallError)(message, code, info.reason, info.metadata, violations)


def _details(error: grpc.RpcError) -> tuple[Any, Any]:
    info, request = error_details_pb2.ErrorInfo(), error_details_pb2.BadRequest()
    trailers = error.trailing_metadata() or ()
    packed = next((value for key, value in trailers if key == "grpc-status-details-bin"), b"")
    for detail in status_pb2.Status.FromString(packed).details:
        if detail.Is(info.DESCRIPTOR):
            detail.Unpack(info)
        if detail.Is(request.DESCRIPTOR):
            detail.Unpack(request)
    return info, request


def _violation(sent: Any) -> Violation:
    """The server sends paths from the job and appends the hint; the scenario is the root here."""
    field = sent.field.removeprefix("job.").removeprefix("scenario.")
    description, _, hint = sent.description.partition(" — ")
    return Violation(field, description, hint)
