"""The client for asyncio: the same calls, awaited."""

from __future__ import annotations

import asyncio
import os
import time
from typing import Any, AsyncIterator, Iterable, Mapping

import grpc
from contact.v1 import event_pb2, job_pb2, job_service_pb2, job_service_pb2_grpc

from .client import DEFAULT_ADDRESS, OPTIONS, JobLike, create_request, ended, job_name
from .errors import from_rpc
from .recording import KINDS, Recording
from .result import Result
from .scenario import ScenarioLike
from .watching import WHOLE, Position, delivery_options


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
        deadline = None if timeout_s is None else time.monotonic() + timeout_s
        position = Position(job_name(job), self.address, after_sequence, kinds, deadline,
                            live_only=live_only, delivery=delivery_options(min_frame_interval_s))
        async for event in self._watch(position):
            yield event

    async def _watch(self, position: Position) -> AsyncIterator[event_pb2.Event]:
        while not position.finished:
            call = self._stub.WatchJob(position.request(), timeout=position.time_left())
            error = None
            try:
                async for message in call:
                    for event in position.take(message):
                        yield event
                    if position.finished:
                        return
            except grpc.RpcError as caught:
                error = caught
            finally:
                call.cancel()
            await asyncio.sleep(position.lost(error))

    async def result(self, job: JobLike, *, timeout_s: float | None = None) -> Result:
        """The result of a job: waits for its end and fetches all that it recorded."""
        recording = Recording()
        deadline = None if timeout_s is None else time.monotonic() + timeout_s
        position = Position(job_name(job), self.address, 0, KINDS, deadline, delivery=WHOLE)
        async for event in self._watch(position):
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
