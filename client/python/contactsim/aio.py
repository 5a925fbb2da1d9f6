"""The client for asyncio: the same calls, awaited."""

from __future__ import annotations

import asyncio
import os
import pathlib
from typing import Any, AsyncIterator, Iterable, Mapping

import grpc
from contact.v1 import event_pb2, job_pb2, job_service_pb2, job_service_pb2_grpc

from .client import (DEFAULT_ADDRESS, OPTIONS, JobLike, create_request, deadline_of, ended,
                     job_name)
from .downloading import Download, PathLike
from .errors import from_rpc
from .recording import KINDS, Recording
from .result import Result
from .scenario import ScenarioLike
from .watching import WHOLE, JobChange, Position, Roster, delivery_options


class AsyncClient:
    """As Client, for use in one event loop; an asynchronous context manager."""

    def __init__(self, address: str | None = None, *, timeout_s: float = 10.0) -> None:
        self.address = address or os.environ.get("CONTACT_SERVER", DEFAULT_ADDRESS)
        self._timeout_s = timeout_s
        self._channel = grpc.aio.insecure_channel(self.address, options=OPTIONS)
        self._stub = job_service_pb2_grpc.JobServiceStub(self._channel)

    async def close(self) -> None:
        await self._channel.close()

    async def __aenter__(self) -> AsyncClient:
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.close()

    async def run(self, scenario: ScenarioLike, *, labels: Mapping[str, str] | None = None,
                  timeout_s: float | None = None) -> Result:
        """Submits a scenario, follows it to its end and returns its result."""
        job = await self.submit(scenario, labels=labels)
        return await self.result(job, timeout_s=timeout_s)

    async def submit(self, scenario: ScenarioLike, *, labels: Mapping[str, str] | None = None,
                     request_id: str | None = None) -> job_pb2.Job:
        """Submits a scenario and returns its job at once."""
        return await self._call(self._stub.CreateJob,
                                create_request(scenario, labels, request_id))

    async def watch(self, job: JobLike, *, after_sequence: int = 0, kinds: Iterable[str] = (),
                    live_only: bool = False, min_frame_interval_s: float = 0.0,
                    timeout_s: float | None = None) -> AsyncIterator[event_pb2.Event]:
        """The events of a job until it has ended, across connections; see Client.watch."""
        position = Position(job_name(job), self.address, after_sequence, kinds,
                            deadline_of(timeout_s), live_only=live_only,
                            delivery=delivery_options(min_frame_interval_s))
        async for event in self._stream(self._stub.WatchJob, position):
            yield event

    async def watch_jobs(self, *, states: Iterable[str] = (),
                         labels: Mapping[str, str] | None = None,
                         timeout_s: float | None = None) -> AsyncIterator[JobChange]:
        """What becomes of all jobs of a filter, without end; see Client.watch_jobs."""
        roster = Roster(self.address, states, labels, deadline_of(timeout_s))
        async for change in self._stream(self._stub.WatchJobs, roster):
            yield change

    async def download(self, job: JobLike, artifact: str, path: PathLike | None = None, *,
                       timeout_s: float | None = None) -> pathlib.Path:
        """Fetches an artifact of an ended job into a file; see Client.download."""
        target = pathlib.Path(path or pathlib.PurePosixPath(artifact).name)
        with Download(job_name(job), artifact, target, self.address,
                      deadline_of(timeout_s)) as download:
            async for _ in self._stream(self._stub.ReadArtifact, download):
                pass
        return target

    async def _stream(self, method: Any, link: Any) -> AsyncIterator[Any]:
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

    async def result(self, job: JobLike, *, timeout_s: float | None = None) -> Result:
        """The result of a job: waits for its end and fetches all that it recorded."""
        recording = Recording()
        position = Position(job_name(job), self.address, 0, KINDS, deadline_of(timeout_s),
                            delivery=WHOLE)
        async for event in self._stream(self._stub.WatchJob, position):
            recording.add(event)
        return ended(await self.get(job), recording)

    async def get(self, job: JobLike) -> job_pb2.Job:
        """The job as it is now, with its ledger so far."""
        return await self._call(self._stub.GetJob,
                                job_service_pb2.GetJobRequest(name=job_name(job)))

    async def cancel(self, job: JobLike) -> job_pb2.Job:
        """Asks a job to stop; what it recorded is kept."""
        return await self._call(self._stub.CancelJob,
                                job_service_pb2.CancelJobRequest(name=job_name(job)))

    async def _call(self, method: Any, request: Any) -> Any:
        try:
            return await method(request, timeout=self._timeout_s)
        except grpc.RpcError as error:
            raise from_rpc(error, self.address) from error
