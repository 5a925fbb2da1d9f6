"""What both clients say and hear: addresses, requests, and what follows from answers."""

from __future__ import annotations

import os
import pathlib
import stat
import time
import uuid
from typing import Any, Mapping, Sequence

import grpc
from contact.v1 import job_pb2, job_service_pb2

from .errors import RunFailed
from .recording import Recording
from .result import Result
from .scenario import ScenarioLike, load_scenario
from .spelling import shown

OPTIONS: Sequence[tuple[str, int]] = (
    ("grpc.max_receive_message_length", 256 << 20),  # A ledger has no limit but this.
    ("grpc.initial_reconnect_backoff_ms", 100),
    ("grpc.min_reconnect_backoff_ms", 1000),  # How long an attempt may take on a busy machine.
    ("grpc.max_reconnect_backoff_ms", 5000),
    ("grpc.keepalive_time_ms", 30_000),
    ("grpc.keepalive_timeout_ms", 20_000),
    ("grpc.http2.max_pings_without_data", 0),
    ("grpc.enable_http_proxy", 0),  # A proxy for the web does not know contactd.
)
TRIES = 3  # Of a unary call.
PAGE = 500  # Jobs of a list that come at once.


def address_of(address: str | None) -> str:
    """The address given, else that of the environment, else the default."""
    return address or os.environ.get("CONTACT_SERVER") or "127.0.0.1:7070"


def open_channel(library: Any, address: str, files: Mapping[str, str | None]) -> Any:
    """A channel of grpc or grpc.aio. `files`: see Client; the environment has the others."""
    paths = {name: given or os.environ.get(f"CONTACT_{name.upper()}")
             for name, given in files.items()}
    token = _secret(paths["token_file"]).decode().strip()
    if paths["tls_ca"] or paths["cert"]:
        credentials = grpc.ssl_channel_credentials(
            _bytes(paths["tls_ca"]), _secret(paths["key"]) or None, _bytes(paths["cert"]))
    elif not token:
        return library.insecure_channel(address, options=OPTIONS)
    elif address.startswith("unix:"):
        credentials = grpc.local_channel_credentials(grpc.LocalConnectionType.UDS)
    else:
        raise ValueError("the token would go unencrypted; tls_ca names the authority of the "
                         "server's certificate")
    if token:
        credentials = grpc.composite_channel_credentials(
            credentials, grpc.access_token_call_credentials(token))
    return library.secure_channel(address, credentials, options=OPTIONS)


def _bytes(path: str | None) -> bytes | None:
    return pathlib.Path(path).read_bytes() if path else None


def _secret(path: str | None) -> bytes:
    """The content of a file that only its owner and group may read."""
    if not path:
        return b""
    if os.stat(path).st_mode & (stat.S_IWGRP | stat.S_IRWXO):
        raise PermissionError(f"{path} can be read or changed by others; chmod 600 it")
    return pathlib.Path(path).read_bytes()


def create_request(scenario: ScenarioLike, set_: Mapping[str, Any] | None,
                   variables: Mapping[str, Any] | None, labels: Mapping[str, str] | None,
                   request_id: str | None) -> job_service_pb2.CreateJobRequest:
    """The request that submits a scenario."""
    job = job_pb2.Job(scenario=load_scenario(scenario, variables, set=set_), labels=labels_of(labels))
    return job_service_pb2.CreateJobRequest(job=job, request_id=request_id or str(uuid.uuid4()))


def update_request(name: str, labels: Mapping[str, str] | None,
                   note: str | None) -> job_service_pb2.UpdateJobRequest:
    """The request that changes what is not None. Raises ValueError if that is nothing."""
    if labels is None and note is None:
        raise ValueError("say what to change: labels, note or both")
    job = job_pb2.Job(name=name, labels=labels_of(labels), note=note or "")
    paths = [path for path, value in (("labels", labels), ("note", note)) if value is not None]
    return job_service_pb2.UpdateJobRequest(job=job, update_mask={"paths": paths})


def labels_of(labels: Mapping[str, str] | None) -> Mapping[str, str] | None:
    """The labels of a job. Raises TypeError unless they are texts by texts."""
    if labels is not None and not isinstance(labels, Mapping):
        raise TypeError(f'labels are a dict such as {{"study": "chain"}}, and not {shown(labels)}')
    for key, value in (labels or {}).items():
        if not isinstance(key, str) or not isinstance(value, str):
            raise TypeError(f"labels are texts, and {key!r}: {value!r} is not; "
                            f"write {{{str(key)!r}: {str(value)!r}}}")
    return labels


def ended(job: job_pb2.Job, recording: Recording, failed: bool = False) -> Result:
    """The result of a job that has ended; raises RunFailed if it did not succeed, unless `failed`."""
    if job.state != job_pb2.Job.SUCCEEDED and not failed:
        raise RunFailed(job)
    # An answer has not the end of a long list.
    if len(job.cycles) < len(recording.cycles):
        del job.cycles[:]
        job.cycles.extend(recording.cycles.values())
    if len(job.groups) < len(recording.groups):
        del job.groups[:]
        job.groups.extend(recording.groups.values())
    return Result(job, recording)


def deadline_of(timeout_s: float | None) -> float | None:
    """When a call that may take so long must end, by time.monotonic()."""
    return None if timeout_s is None else time.monotonic() + timeout_s
