"""The client for asyncio. client.py is made from this file by make_client.py: change this one."""

from __future__ import annotations

import asyncio
import pathlib
import uuid
from typing import Any, AsyncIterator, Callable, Iterable, Mapping

import grpc
import numpy as np
import pandas as pd
from contact.v1 import event_pb2, job_pb2, job_service_pb2, job_service_pb2_grpc

from . import pages
from .calls import (PAGE, TRIES, address_of, create_request, deadline_of, ended, labels_of,
                    open_channel, update_request)
from .downloading import Download
from .errors import CallError, RunFailed, from_rpc
from .finding import JobLike, Search, job_frame, list_request
from .keywords import hinted
from .pages import PathLike
from .progress import ProgressBar
from .recording import KINDS, Recording
from .result import Result, series_frame
from .scenario import ScenarioLike
from .sweeping import AxisValue, SweepResult, make_sweep
from .watching import WHOLE, JobChange, Position, Roster, delivery_options


class AsyncClient:
    """A connection to one contactd, as Client, for one event loop; an async context manager.

    `address` is HOST:PORT; by default the environment variable CONTACT_SERVER, or
    127.0.0.1:7070. `timeout_s` limits each call, not the run of a job. `tls_ca`, `cert`, `key` and
    `token_file` are files by which client and server know each other; by default those that the
    variables CONTACT_TLS_CA, CONTACT_CERT, CONTACT_KEY and CONTACT_TOKEN_FILE name.

    A scenario is a file, a template, a dict or a message, see load_scenario. `set` overrides its
    fields by their paths, `variables` those that a file declares.

    A job is named by its ID or the beginning of it that no other job has, by `last`, the newest job,
    by `last~2`, the second before it, or by what has its name: a Job, a Result, a row of `list()`.
    Raises JobNotFound, or AmbiguousJob with the jobs that a text may mean.
    """

    def __init__(self, address: str | None = None, *, timeout_s: float = 10.0,
                 tls_ca: str | None = None, cert: str | None = None, key: str | None = None,
                 token_file: str | None = None) -> None:
        self.address = address_of(address)
        self._timeout_s = timeout_s
        self._files = {"tls_ca": tls_ca, "cert": cert, "key": key, "token_file": token_file}
        self._channel = open_channel(grpc.aio, self.address, self._files)
        self._stub = job_service_pb2_grpc.JobServiceStub(self._channel)

    def __repr__(self) -> str:
        return f"<AsyncClient {self.address}>"

    async def close(self) -> None:
        """Ends the connection."""
        await self._channel.close()

    async def __aenter__(self) -> AsyncClient:
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.close()

    @hinted
    async def run(self, scenario: ScenarioLike, *, set: Mapping[str, Any] | None = None,
                  variables: Mapping[str, Any] | None = None,
                  labels: Mapping[str, str] | None = None,
                  on_event: Callable[[event_pb2.Event], None] | None = None,
                  progress: bool = False, timeout_s: float | None = None) -> Result:
        """Submits a scenario, follows it to its end and returns its result.

        `set` has values by path: `{"contacts[B1-B2].restitution": 0.7}`. `on_event` hears every
        event as it happens; `progress` shows a bar, for which tqdm must be installed. Raises
        InvalidScenario, RunFailed, and Timeout after `timeout_s`; the job then goes on.
        """
        deadline = deadline_of(timeout_s)
        with ProgressBar(progress) as bar:
            job = await self.submit(scenario, set=set, variables=variables, labels=labels)
            return await self._follow(job.name, on_event, deadline, bar)

    @hinted
    async def submit(self, scenario: ScenarioLike, *, set: Mapping[str, Any] | None = None,
                     variables: Mapping[str, Any] | None = None,
                     labels: Mapping[str, str] | None = None,
                     request_id: str | None = None) -> job_pb2.Job:
        """Submits a scenario and returns its job at once.

        The same `request_id` and scenario make one job, however often submitted.
        """
        request = create_request(scenario, set, variables, labels, request_id)
        job: job_pb2.Job = await self._call(self._stub.CreateJob, request)
        return job

    @hinted
    async def sweep(self, scenario: ScenarioLike, grid: Mapping[str, Iterable[AxisValue]],
                    metrics: Iterable[str] = ("iterations",), *,
                    set: Mapping[str, Any] | None = None,
                    variables: Mapping[str, Any] | None = None,
                    labels: Mapping[str, str] | None = None, progress: bool = False,
                    timeout_s: float | None = None) -> SweepResult:
        """Solves a scenario for every combination of values of its fields, as one job.

        `grid` has the values by path, such as `{"contacts[*].restitution": [0.9, 0.8]}`, or by
        variable, `var:NAME`; values of an enum may be its words. `metrics` are paths of numbers in
        the result, such as `cycles[B1-B2].last.alpha`. Cells that fail or do not converge do not
        raise: the result tells which. `progress` shows a bar, for which tqdm must be installed.
        Raises InvalidScenario, RunFailed if the whole sweep ended early, and Timeout after
        `timeout_s`; the job then goes on.
        """
        deadline = deadline_of(timeout_s)
        job = job_pb2.Job(sweep=make_sweep(scenario, grid, metrics, variables, set),
                          labels=labels_of(labels))
        request = job_service_pb2.CreateJobRequest(job=job, request_id=str(uuid.uuid4()))
        with ProgressBar(progress) as bar:
            created: job_pb2.Job = await self._call(self._stub.CreateJob, request)
            return await self._sweep(created.name, deadline, bar)

    async def sweep_result(self, job: JobLike, *, failed: bool = False,
                           timeout_s: float | None = None) -> SweepResult:
        """The cells of a sweep, once it has ended; raises RunFailed if it ended early, unless
        `failed`."""
        deadline = deadline_of(timeout_s)
        return await self._sweep(await self._find(job), deadline, ProgressBar(False), failed)

    async def _sweep(self, name: str, deadline: float | None, bar: ProgressBar,
                     failed: bool = False) -> SweepResult:
        position = Position(name, self.address, 0, ["sweep_cell", *bar.kinds], deadline)
        cells = []
        async for event in self._stream(self._stub.WatchJob, position):
            bar.hear(event)
            if event.WhichOneof("payload") == "sweep_cell":
                cells.append(event.sweep_cell)
        job = await self.get(name)
        if job.state != job_pb2.Job.SUCCEEDED and not failed:
            raise RunFailed(job)
        return SweepResult(job, cells)

    @hinted
    async def validate(self, scenario: ScenarioLike, *, set: Mapping[str, Any] | None = None,
                       variables: Mapping[str, Any] | None = None) -> job_pb2.Job:
        """Raises InvalidScenario unless the server would accept the scenario.

        Returns a job that was not submitted: its `warnings` tell what the scenario will probably
        not show, its `estimate` what it would take.
        """
        request = create_request(scenario, set, variables, None, None)
        request.validate_only = True
        job: job_pb2.Job = await self._call(self._stub.CreateJob, request)
        return job

    def watch(self, job: JobLike, *, after_sequence: int = 0, kinds: Iterable[str] = (),
              live_only: bool = False, min_frame_interval_s: float = 0.0,
              timeout_s: float | None = None) -> AsyncIterator[event_pb2.Event]:
        """The events of a job: those stored, then new ones as they happen, until it has ended.

        Reconnects with growing pauses when the link breaks; no durable event is missed or
        repeated. `kinds` are names of Event.payload, such as `cycle`; state_changed always comes.
        `live_only` begins after the newest event. Of frame chunks that follow each other within
        `min_frame_interval_s` only the newest comes, and a gap for the others.
        """
        position = Position("", self.address, after_sequence, kinds, deadline_of(timeout_s),
                            live_only=live_only, delivery=delivery_options(min_frame_interval_s))
        return self._watch(Search(job), position)

    async def _watch(self, search: Search, position: Position) -> AsyncIterator[event_pb2.Event]:
        position.name = await self._search(search)
        async for event in self._stream(self._stub.WatchJob, position):
            yield event

    def watch_jobs(self, *, states: Iterable[str] = (), labels: Mapping[str, str] | None = None,
                   timeout_s: float | None = None) -> AsyncIterator[JobChange]:
        """What becomes of all jobs of a filter: those there are, then each change as it happens.

        Never ends by itself; raises Timeout after `timeout_s`. Reconnects as watch does. Of
        changes that follow each other quickly only the newest may come; none comes twice.
        """
        roster = Roster(self.address, states, labels, deadline_of(timeout_s))
        return self._stream(self._stub.WatchJobs, roster)

    async def download(self, job: JobLike, artifact: str, path: PathLike | None = None, *,
                       timeout_s: float | None = None) -> pathlib.Path:
        """Fetches an artifact of an ended job, one of `get(job).artifacts`, into a file.

        By default that of the last part of its name, in the current folder. Goes on where it was
        when the link breaks, and with PATH.part where an earlier try has left it. Raises
        JobNotFound, DownloadFailed, and Timeout after `timeout_s`; the part then stays.
        """
        target = pathlib.Path(path or pathlib.PurePosixPath(artifact).name)
        deadline = deadline_of(timeout_s)
        name = await self._find(job)
        with Download(name, artifact, target, self.address, deadline) as download:
            async for _ in self._stream(self._stub.ReadArtifact, download):
                pass
        return target

    async def _stream(self, method: Any, link: Any) -> AsyncIterator[Any]:
        """What the messages of a stream bring, across connections."""
        while not link.finished:
            call = method(link.request(), timeout=link.time_left())
            error = None
            try:
                async for message in call:
                    for heard in link.take(message):
                        yield heard
                    if link.finished:
                        return
            except grpc.RpcError as caught:
                error = caught
            finally:
                call.cancel()
            await asyncio.sleep(link.lost(error))

    async def wait(self, job: JobLike, *, timeout_s: float | None = None) -> job_pb2.Job:
        """The job once it has ended, however it did."""
        deadline = deadline_of(timeout_s)
        name = await self._find(job)
        position = Position(name, self.address, 0, ["state_changed"], deadline)
        async for _ in self._stream(self._stub.WatchJob, position):
            pass
        return await self.get(name)

    async def result(self, job: JobLike, *, failed: bool = False,
                     timeout_s: float | None = None) -> Result:
        """The result of a job: waits for its end and fetches all that it recorded. Raises RunFailed if
        it did not succeed, unless `failed`."""
        deadline = deadline_of(timeout_s)
        return await self._follow(await self._find(job), None, deadline, ProgressBar(False), failed)

    async def series(self, job: JobLike, channels: Iterable[str] = (), *,
                     start_time_s: float | None = None, end_time_s: float | None = None,
                     max_points: int = 1000) -> pd.DataFrame:
        """The recorded motion of a job, thinned so that no peak is lost, as `Result.series` has it: of
        some channels, by default all, and of a part of the time. Also while the job runs."""
        request = job_service_pb2.GetSeriesRequest(
            name=await self._find(job), channels=channels, start_time_s=start_time_s,
            end_time_s=end_time_s, max_points=max_points)
        answer: job_service_pb2.Series = await self._call(self._stub.GetSeries, request)
        arrays = {column.name: np.frombuffer(column.values, dtype="<f8") for column in answer.columns}
        return series_frame(arrays, {column.name: column.unit for column in answer.columns})

    async def get(self, job: JobLike) -> job_pb2.Job:
        """The job as it is now, with its ledger so far."""
        request = job_service_pb2.GetJobRequest(name=await self._find(job))
        answer: job_pb2.Job = await self._call(self._stub.GetJob, request)
        return answer

    async def list(self, *, states: Iterable[str] = (), labels: Mapping[str, str] | None = None,
                   name_prefix: str = "", limit: int | None = None) -> pd.DataFrame:
        """The jobs, newest first: a row a job, indexed by its name; by default all.

        Columns: `title`, `kind` (scenario or sweep), `state`, `convergence`, `reason`, `created` and
        `ended` in UTC, `owner`, `labels`, `note`. `states` are words such as `SUCCEEDED`; jobs
        have one of them, all the labels, and a name that begins so. A row names its job:
        `client.result(client.list().iloc[0])`.
        """
        jobs: list[job_pb2.Job] = []
        async for job in self._pages(list_request(states, labels, name_prefix), limit):
            jobs.append(job)
        return job_frame(jobs)

    def jobs(self, *, states: Iterable[str] = (), labels: Mapping[str, str] | None = None,
             name_prefix: str = "") -> AsyncIterator[job_pb2.Job]:
        """The jobs of `list` as messages, page by page; without specs and ledgers."""
        return self._pages(list_request(states, labels, name_prefix), None)

    async def last(self, back: int = 0) -> job_pb2.Job:
        """The newest job, or that which is so many before it."""
        return await self.get(f"last~{back}")

    async def _pages(self, request: job_service_pb2.ListJobsRequest,
                     limit: int | None) -> AsyncIterator[job_pb2.Job]:
        left = float("inf") if limit is None else limit
        while left > 0:
            request.page_size = int(min(left, PAGE))
            page: job_service_pb2.ListJobsResponse = await self._call(self._stub.ListJobs, request)
            for job in page.jobs:
                yield job
            left -= len(page.jobs)
            request.page_token = page.next_page_token
            if not request.page_token:
                return

    async def _find(self, job: JobLike) -> str:
        """The name of a job."""
        return await self._search(Search(job))

    async def _search(self, search: Search) -> str:
        if search.request is None:
            return search.name
        return search.found(await self._call(self._stub.ListJobs, search.request))

    async def cancel(self, job: JobLike) -> job_pb2.Job:
        """Asks a job to stop; what it recorded is kept."""
        request = job_service_pb2.CancelJobRequest(name=await self._find(job))
        answer: job_pb2.Job = await self._call(self._stub.CancelJob, request)
        return answer

    async def update(self, job: JobLike, *, labels: Mapping[str, str] | None = None,
                     note: str | None = None) -> job_pb2.Job:
        """Gives a job, in whatever state, these labels in place of all that it has, and this note;
        what is None stays. `client.update(job, labels={**job.labels, "law": "x"})` adds one."""
        request = update_request(await self._find(job), labels, note)
        answer: job_pb2.Job = await self._call(self._stub.UpdateJob, request)
        return answer

    async def delete(self, job: JobLike) -> None:
        """Removes an ended job and its events."""
        request = job_service_pb2.DeleteJobRequest(name=await self._find(job))
        await self._call(self._stub.DeleteJob, request)

    async def server_info(self) -> job_service_pb2.ServerInfo:
        """What the server is and accepts."""
        request = job_service_pb2.GetServerInfoRequest()
        info: job_service_pb2.ServerInfo = await self._call(self._stub.GetServerInfo, request)
        return info

    async def report(self, jobs: Iterable[JobLike], path: PathLike = "report.html") -> pathlib.Path:
        """Writes a page about jobs that needs no network: ledger, figures, balances.

        Without matplotlib it has no figures.
        """
        names = [await self._find(job) for job in jobs]
        return await asyncio.to_thread(pages.report, self._files, self.address, names, path)

    async def paper(self, folder: PathLike = "paper", items: Iterable[str] = ("all",)) -> bool:
        """Makes figures and tables of the paper again in a folder, with index.html of all.

        True if no number deviates by more than documented. Without matplotlib there are no
        figures.
        """
        return await asyncio.to_thread(pages.paper, self._files, self.address, items, folder)

    async def _follow(self, name: str, on_event: Callable[[event_pb2.Event], None] | None,
                      deadline: float | None, bar: ProgressBar, failed: bool = False) -> Result:
        recording = Recording()
        kinds = () if on_event else (*KINDS, *bar.kinds)
        position = Position(name, self.address, 0, kinds, deadline, delivery=WHOLE)
        async for event in self._stream(self._stub.WatchJob, position):
            recording.add(event)
            bar.hear(event)
            if on_event:
                on_event(event)
        return ended(await self.get(name), recording, failed)

    async def _call(self, method: Any, request: Any) -> Any:
        """A unary call, tried again while the server cannot be reached."""
        failure: CallError | None = None
        for attempt in range(TRIES):
            if attempt > 0:
                await asyncio.sleep(0.05 * 2**attempt)
            try:
                return await method(request, timeout=self._timeout_s)
            except grpc.RpcError as error:
                failure = from_rpc(error, self.address)
                failure.__cause__ = error
            if failure.code != grpc.StatusCode.UNAVAILABLE:
                break
        assert failure is not None
        raise failure
