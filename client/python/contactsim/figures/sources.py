"""Where figures come from, in words."""

from __future__ import annotations

from typing import Sequence

from contact.v1 import job_pb2

from .figure import Source

_MOST_JOBS = 3  # In a caption.
_DIGITS = 12  # Of a hash in a caption.


def source_of(job: job_pb2.Job) -> Source:
    """What makes a run or a sweep repeatable."""
    scenario = job.sweep.base if job.HasField("sweep") else job.scenario
    return {"title": scenario.title, "job": job.name, "scenario_sha256": job.spec_sha256,
            "version": job.server_version, "revision": job.server_revision}


def caption(sources: Sequence[Source]) -> str:
    """The jobs with their scenarios, and the servers, in a line."""
    jobs = [f"{source.get('job') or 'scenario'} ({source['scenario_sha256'][:_DIGITS]})"
            for source in sources if source.get("scenario_sha256")]
    if len(jobs) > _MOST_JOBS:
        jobs[_MOST_JOBS:] = [f"{len(sources) - _MOST_JOBS} more"]
    servers = sorted({f"contactd {source['version']} {source['revision'][:_DIGITS]}"
                      for source in sources})
    return ", ".join([*jobs, *servers])


def lines(sources: Sequence[Source], prefix: str = "") -> str:
    """All that is known of each source, a line each, which begins with `prefix`."""
    blocks = ["".join(f"{prefix}{name}: {printable(value)}\n" for name, value in source.items())
              for source in sources]
    return f"{prefix.rstrip()}\n".join(blocks)


def printable(text: str, kept: str = "") -> str:
    """Without what steers a terminal, and in one line unless ends of lines are `kept`: in a second line
    a text of a user could become a command."""
    return "".join(c if c.isprintable() or c in kept else " " for c in text)
