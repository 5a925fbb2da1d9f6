"""Where a stream stands, across connections."""

from __future__ import annotations

import dataclasses
import random
import time
from typing import Iterable, Mapping

import grpc
from contact.v1 import event_pb2, job_pb2, job_service_pb2

from .errors import from_rpc
from .finding import state_of
from .spelling import expected

FINAL = (job_pb2.Job.SUCCEEDED, job_pb2.Job.FAILED, job_pb2.Job.CANCELLED)

_FIRST_PAUSE_S = 0.2
_LONGEST_PAUSE_S = 10.0
_GIVE_UP_AFTER_S = 300.0
_GIVE_UP_AT_FIRST_S = 3.0  # Without any message yet: there may be no server at all.

# What an event can be about.
_PAYLOADS = [field.name for field in event_pb2.Event.DESCRIPTOR.oneofs_by_name["payload"].fields]

# Ends of a stream after which the same question may be asked again.
_PASSING = (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.CANCELLED, grpc.StatusCode.UNKNOWN,
            grpc.StatusCode.INTERNAL, grpc.StatusCode.ABORTED,
            grpc.StatusCode.DEADLINE_EXCEEDED, grpc.StatusCode.RESOURCE_EXHAUSTED)


# For those who record: nothing is left out, however slow they are.
WHOLE = job_service_pb2.DeliveryOptions(overflow=job_service_pb2.DeliveryOptions.LAG)


def delivery_options(min_frame_interval_s: float) -> job_service_pb2.DeliveryOptions:
    options = job_service_pb2.DeliveryOptions()
    options.min_frame_interval.FromNanoseconds(round(min_frame_interval_s * 1e9))
    return options


class Link:
    """When a stream that broke off is asked for again, and when no more."""

    finished = False  #: All was heard.

    def __init__(self, address: str, deadline: float | None) -> None:
        self._address = address
        self._deadline = deadline  # Of time.monotonic().
        self._pause_s = _FIRST_PAUSE_S
        self._connected = False  # Ever.
        self._lost_since: float | None = None

    def time_left(self) -> float | None:
        """Seconds until the stream must end; None for ever."""
        return None if self._deadline is None else max(0.0, self._deadline - time.monotonic())

    def heard(self) -> None:
        """A message came."""
        self._connected, self._lost_since, self._pause_s = True, None, _FIRST_PAUSE_S

    def lost(self, error: grpc.RpcError | None) -> float:
        """How long to wait before another try, in seconds; `error` is None for an early end.

        Raises CallError if another try is hopeless.
        """
        if error is not None:
            self._require_hope(error)
        # From half the pause to all of it: watchers of a restarted server do not come at once.
        pause = self._pause_s * random.uniform(0.5, 1.0)
        self._pause_s = min(2 * self._pause_s, _LONGEST_PAUSE_S)
        left = self.time_left()
        return pause if left is None else min(pause, left)

    def _require_hope(self, error: grpc.RpcError) -> None:
        failure = from_rpc(error, self._address)
        now = time.monotonic()
        if self._lost_since is None:
            self._lost_since = now
        full = not self._connected and failure.code == grpc.StatusCode.RESOURCE_EXHAUSTED
        patience_s = _GIVE_UP_AFTER_S if self._connected else _GIVE_UP_AT_FIRST_S
        if (failure.code not in _PASSING or full or self.time_left() == 0
                or now - self._lost_since > patience_s):
            raise failure from error


class Position(Link):
    """In a job's log: takes what streams bring, so that each event is heard once and in order."""

    def __init__(self, name: str, address: str, after_sequence: int = 0,
                 kinds: Iterable[str] = (), deadline: float | None = None, *,
                 live_only: bool = False,
                 delivery: job_service_pb2.DeliveryOptions | None = None) -> None:
        super().__init__(address, deadline)
        kinds = tuple(kinds)
        for kind in kinds:
            if kind not in _PAYLOADS:
                raise ValueError(f"there is no kind of event {kind!r}" + expected(kind, _PAYLOADS))
        self.name, self._kinds = name, kinds
        self._sequence = after_sequence
        self._live_only = live_only  # Has not begun yet.
        self._delivery = delivery

    def request(self) -> job_service_pb2.WatchJobRequest:
        """What to ask now."""
        return job_service_pb2.WatchJobRequest(
            name=self.name, after_sequence=self._sequence, kinds=self._kinds,
            live_only=self._live_only, delivery=self._delivery)

    def take(self, message: job_service_pb2.WatchJobResponse) -> list[event_pb2.Event]:
        """The events of a message that were not heard before."""
        self.heard()
        if message.HasField("snapshot"):
            # Asked for events after the last one: nothing but the end of the stream will come.
            snapshot = message.snapshot
            if self._live_only:
                self._sequence, self._live_only = snapshot.last_sequence, False
            self.finished |= (snapshot.state in FINAL
                              and self._sequence >= snapshot.last_sequence)
        return [event for event in message.events if self._is_new(event)]

    def _is_new(self, event: event_pb2.Event) -> bool:
        kind = event.WhichOneof("payload")
        if 0 < event.sequence <= self._sequence and kind not in ("bookmark", "gap"):
            return False  # Heard before the connection was lost.
        self._sequence = max(self._sequence, event.sequence)
        self.finished |= kind == "state_changed" and event.state_changed.state in FINAL
        return True


@dataclasses.dataclass(frozen=True)
class JobChange:
    """What became of a job: its newest header, or None once it was deleted or matches no more."""

    name: str
    job: job_pb2.Job | None


class Roster(Link):
    """Of the jobs of a filter: takes what streams bring, so that each change is heard once."""

    def __init__(self, address: str, states: Iterable[str], labels: Mapping[str, str] | None,
                 deadline: float | None) -> None:
        super().__init__(address, deadline)
        self._request = job_service_pb2.WatchJobsRequest(
            states=[state_of(state) for state in states], labels=labels)
        self._known: dict[str, tuple[int, int]] = {}  # State and attempt of each job.
        self._unconfirmed: set[str] = set()  # Known, and not in the snapshot yet.

    def request(self) -> job_service_pb2.WatchJobsRequest:
        """What to ask now: a stream begins with a snapshot of all jobs."""
        self._unconfirmed = set(self._known)
        return self._request

    def take(self, message: job_service_pb2.WatchJobsResponse) -> list[JobChange]:
        """The changes in a message that were not heard before."""
        self.heard()
        changes = [JobChange(job.name, job) for job in message.jobs if self._is_new(job)]
        gone = list(message.gone)
        if message.snapshot_complete:
            gone += sorted(self._unconfirmed)
            self._unconfirmed = set()
        return changes + [JobChange(name, None) for name in gone if self._known.pop(name, None)]

    def _is_new(self, job: job_pb2.Job) -> bool:
        self._unconfirmed.discard(job.name)
        version = job.state, job.attempt
        before, self._known[job.name] = self._known.get(job.name), version
        return before != version
