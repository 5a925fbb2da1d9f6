"""The client: submits scenarios, watches jobs, fetches results."""

from __future__ import annotations

import os
import pathlib
import time
import uuid
from typing import Any, Callable, Iterable, Iterator, Mapping, Union

import grpc
from contact.v1 import event_pb2, job_pb2, job_service_pb2, job_service_pb2_grpc

from .downloading import Download, PathLike
from .errors import RunFailed, from_rpc
from .progress import ProgressBar
from .recording import KINDS, Recording
from .result import Result
from .scenario import ScenarioLike, load_scenario
from .sweeping import SweepResult, make_sweep
from .watching import WHOLE, JobChange, Position, Roster, delivery_options

JobLike = Union[str, job_pb2.Job, Result]

DEFAULT_ADDRESS = "127.0.0.1:7070"
OPTIONS = (
    ("grpc.max_receive_message_length", 256 << 20),  # A ledger has no limit but this.
    ("grpc.initial_reconnect_backoff_ms", 100),
    ("grpc.min_reconnect_backoff_ms", 100),
    ("grpc.max_reconnect_backoff_ms", 5000),
    ("grpc.keepalive_time_ms", 30_000),
    ("grpc.keepalive_timeout_ms", 20_000),
    ("grpc.http2.max_pings_without_data", 0),
    ("grpc.enable_http_proxy", 0),  # A proxy for the web does not know contactd.
)
_TRIES = 3


class Client:
    """A connection to one contactd. Thread-safe; also a context manager.

    `address` is HOST:PORT; by default the environment variable CONTACT_SERVER, or
    127.0.0.1:7070. `timeout_s` limits each call, not the run of a job.
    """

    def __init__(self, address: str | None = None, *, timeout_s: float = 10.0) -> None:
        self.address = address or os.environ.get("CONTACT_SERVER", DEFAULT_ADDRESS)
        self._timeout_s = timeout_s
        self._channel = grpc.insecure_channel(self.address, options=OPTIONS)
        self._stub = job_service_pb2_grpc.JobServiceStub(self._channel)

    def close(self) -> None:
        self._channel.close()

    def __enter__(self) -> Client:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def run(self, scenario: ScenarioLike, *, labels: Mapping[str, str] | None = None,
            on_event: Callable[[event_pb2.Event], None] | None = None,
            progress: bool = False, timeout_s: float | None = None) -> Result:
        """Submits a scenario, follows it to its end and returns its result.

        `on_event` hears every event as it happens; `progress` shows a bar, for which tqdm must be
        installed. Raises InvalidScenario, RunFailed, and Timeout after `timeout_s`; the job then
        goes on.
        """
        deadline = deadline_of(timeout_s)
        with ProgressBar(progress) as bar:
            return self._follow(self.submit(scenario, labels=labels).name, on_event, deadline, bar)

    def submit(self, scenario: ScenarioLike, *, labels: Mapping[str, str] | None = None,
               request_id: str | None = None) -> job_pb2.Job:
        """Submits a scenario and returns its job at once.

        The same `request_id` and scenario make one job, however often submitted.
        """
        return self._call(self._stub.CreateJob, create_request(scenario, labels, request_id))

    def sweep(self, scenario: ScenarioLike, grid: Mapping[str, Iterable[float]],
              metrics: Iterable[str] = ("iterations",), *,
              labels: Mapping[str, str] | None = None, progress: bool = False,
              timeout_s: float | None = None) -> SweepResult:
        """Solves a scenario for every combination of values of its fields, as one job.

        `grid` has the values by path, such as `{"contacts[*].restitution": [0.9, 0.8]}`; `metrics`
        are paths of numbers in the result, such as `cycles[B1-B2].alpha`. Cells that fail or do
        not converge do not raise: the result tells which. `progress` shows a bar, for which tqdm
        must be installed. Raises InvalidScenario, RunFailed if the
        whole sweep ended early, and Timeout after `timeout_s`; the job then goes on.
        """
        deadline = deadline_of(timeout_s)
        job = job_pb2.Job(sweep=make_sweep(scenario, grid, metrics), labels=labels)
        request = job_service_pb2.CreateJobRequest(job=job, request_id=str(uuid.uuid4()))
        with ProgressBar(progress) as bar:
            return self._sweep(self._call(self._stub.CreateJob, request).name, deadline, bar)

    def sweep_result(self, job: JobLike, *, timeout_s: float | None = None) -> SweepResult:
        """The cells of a sweep, once it has ended."""
        return self._sweep(job_name(job), deadline_of(timeout_s), ProgressBar(False))

    def _sweep(self, name: str, deadline: float | None, bar: ProgressBar) -> SweepResult:
        position = Position(name, self.address, 0, ["sweep_cell", *bar.kinds], deadline)
        cells = []
        for event in self._watch(position):
            bar.hear(event)
            if event.WhichOneof("payload") == "sweep_cell":
                cells.append(event.sweep_cell)
        job = self.get(name)
        if job.state != job_pb2.Job.SUCCEEDED:
            raise RunFailed(job)
        return SweepResult(job, cells)

    def validate(self, scenario: ScenarioLike) -> job_pb2.Job:
        """Raises InvalidScenario unless the server would accept the scenario.

        Returns a job that was not submitted: its `warnings` tell what the scenario will probably
        not show, its `estimate` what it would take.
        """
        request = create_request(scenario, None, None)
        request.validate_only = True
        return self._call(self._stub.CreateJob, request)

    def watch(self, job: JobLike, *, after_sequence: int = 0, kinds: Iterable[str] = (),
              live_only: bool = False, min_frame_interval_s: float = 0.0,
              timeout_s: float | None = None) -> Iterator[event_pb2.Event]:
        """The events of a job: those stored, then new ones as they happen, until it has ended.

        Reconnects with growing pauses when the link breaks; no durable event is missed or
        repeated. `kinds` are names of Event.payload, such as `cycle`; state_changed always comes.
        `live_only` begins after the newest event. Of frame chunks that follow each other within
        `min_frame_interval_s` only the newest comes, and a gap for the others.
        """
        return self._watch(Position(job_name(job), self.address, after_sequence, kinds,
                                    deadline_of(timeout_s), live_only=live_only,
                                    delivery=delivery_options(min_frame_interval_s)))

    def watch_jobs(self, *, states: Iterable[str] = (), labels: Mapping[str, str] | None = None,
                   timeout_s: float | None = None) -> Iterator[JobChange]:
        """What becomes of all jobs of a filter: those there are, then each change as it happens.

        Never ends by itself; raises Timeout after `timeout_s`. Reconnects as watch does. Of
        changes that follow each other quickly only the newest may come; none comes twice.
        """
        return self._stream(self._stub.WatchJobs,
                            Roster(self.address, states, labels, deadline_of(timeout_s)))

    def download(self, job: JobLike, artifact: str, path: PathLike | None = None, *,
                 timeout_s: float | None = None) -> pathlib.Path:
        """Fetches an artifact of an ended job, one of `get(job).artifacts`, into a file.

        By default that of the last part of its name, in the current folder. Goes on where it was
        when the link breaks, and with PATH.part where an earlier try has left it. Raises
        JobNotFound, DownloadFailed, and Timeout after `timeout_s`; the part then stays.
        """
        target = pathlib.Path(path or pathlib.PurePosixPath(artifact).name)
        with Download(job_name(job), artifact, target, self.address,
                      deadline_of(timeout_s)) as download:
            for _ in self._stream(self._stub.ReadArtifact, download):
                pass
        return target

    def _watch(self, position: Position) -> Iterator[event_pb2.Event]:
        return self._stream(self._stub.WatchJob, position)

    def _stream(self, method: Any, link: Any) -> Iterator[Any]:
        while not link.finished:
            call = method(link.request(), timeout=link.time_left())
            error = None
            try:
                for message in call:
                    yield from link.take(message)
                    if link.finished:
                        return
            except grpc.RpcError as caught:
                error = caught
            finally:
                call.cancel()
            time.sleep(link.lost(error))

    def wait(self, job: JobLike, *, timeout_s: float | None = None) -> job_pb2.Job:
        """The job once it has ended, however it did."""
        for _ in self.watch(job, kinds=["state_changed"], timeout_s=timeout_s):
            pass
        return self.get(job)

    def result(self, job: JobLike, *, timeout_s: float | None = None) -> Result:
        """The result of a job: waits for its end and fetches all that it recorded."""
        return self._follow(job_name(job), None, deadline_of(timeout_s), ProgressBar(False))

    def get(self, job: JobLike) -> job_pb2.Job:
        """The job as it is now, with its ledger so far."""
        return self._call(self._stub.GetJob, job_service_pb2.GetJobRequest(name=job_name(job)))

    def list(self, *, states: Iterable[str] = (),
             labels: Mapping[str, str] | None = None) -> Iterator[job_pb2.Job]:
        """Jobs, newest first, page by page; without specs and ledgers."""
        request = job_service_pb2.ListJobsRequest(
            states=[job_pb2.Job.State.Value(state) for state in states], labels=labels)
        while True:
            page = self._call(self._stub.ListJobs, request)
            yield from page.jobs
            request.page_token = page.next_page_token
            if not request.page_token:
                return

    def cancel(self, job: JobLike) -> job_pb2.Job:
        """Asks a job to stop; what it recorded is kept."""
        return self._call(self._stub.CancelJob,
                          job_service_pb2.CancelJobRequest(name=job_name(job)))

    def delete(self, job: JobLike) -> None:
        """Removes an ended job and its events."""
        self._call(self._stub.DeleteJob, job_service_pb2.DeleteJobRequest(name=job_name(job)))

    def server_info(self) -> job_service_pb2.ServerInfo:
        """What the server is and accepts."""
        return self._call(self._stub.GetServerInfo, job_service_pb2.GetServerInfoRequest())

    def _follow(self, name: str, on_event: Callable[[event_pb2.Event], None] | None,
                deadline: float | None, bar: ProgressBar) -> Result:
        recording = Recording()
        kinds = () if on_event else (*KINDS, *bar.kinds)
        for event in self._watch(Position(name, self.address, 0, kinds, deadline,
                                          delivery=WHOLE)):
            recording.add(event)
            bar.hear(event)
            if on_event:
                on_event(event)
        return ended(self.get(name), recording)

    def _call(self, method: Any, request: Any) -> Any:
        for attempt in range(_TRIES):
            try:
                return method(request, timeout=self._timeout_s)
            except grpc.RpcError as error:
                failure = from_rpc(error, self.address)
                if failure.code != grpc.StatusCode.UNAVAILABLE or attempt == _TRIES - 1:
                    raise failure from error
            time.sleep(0.1 * 2**attempt)


def ended(job: job_pb2.Job, recording: Recording) -> Result:
    """The result of a job that has ended; raises RunFailed if it did not succeed."""
    if job.state != job_pb2.Job.SUCCEEDED:
        raise RunFailed(job)
    # An answer has not the end of a long list.
    for kept, heard in (job.cycles, recording.cycles), (job.groups, recording.groups):
        if len(kept) < len(heard):
            del kept[:]
            kept.extend(heard.values())
    return Result(job, recording)


def create_request(scenario: ScenarioLike, labels: Mapping[str, str] | None,
                   request_id: str | None) -> job_service_pb2.CreateJobRequest:
    job = job_pb2.Job(scenario=load_scenario(scenario), labels=labels)
    return job_service_pb2.CreateJobRequest(job=job, request_id=request_id or str(uuid.uuid4()))


def job_name(job: JobLike) -> str:
    """`jobs/ID` for a job, a result, `jobs/ID` or `ID`."""
    if isinstance(job, Result):
        job = job.job
    name = job.name if isinstance(job, job_pb2.Job) else job
    return name if name.startswith("jobs/") else f"jobs/{name}"


def deadline_of(timeout_s: float | None) -> float | None:
    """When a call that may take so long must end, by time.monotonic()."""
    return None if timeout_s is None else time.monotonic() + timeout_s
