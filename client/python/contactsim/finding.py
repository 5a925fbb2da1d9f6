"""How people name jobs: by an ID, by its beginning, or as `last`; and the table of those there are."""

from __future__ import annotations

import datetime
import re
from typing import Any, Iterable, Mapping, Protocol, Union

import grpc
import pandas as pd
from contact.v1 import job_pb2, job_service_pb2

from .errors import AmbiguousJob, JobNotFound
from .spelling import expected, shown

_WHOLE = 10  # Characters of the IDs that a server gives.
_MOST_BACK = 999  # One page of a list has so many jobs and one more.
_CANDIDATES = 10
_LAST = re.compile(r"last(?:~(.*))?", re.S)
_COLUMNS = ("title", "kind", "state", "convergence", "reason", "created", "ended", "owner", "labels",
            "note")


class Named(Protocol):
    """A Job, a Result or SweepResult, a JobChange, or a row of `list()`."""

    @property
    def name(self) -> str: ...


#: What names a job: `jobs/ID`, `ID` or its beginning, `last`, `last~2`, or what has its name.
JobLike = Union[str, Named]


def job_name(job: JobLike) -> str:
    """`jobs/ID` for a job, a result, a row of a list, `jobs/ID` or `ID`."""
    name = job if isinstance(job, str) else getattr(job, "name", None)
    if not isinstance(name, str) or not name:
        raise TypeError("a job is named by its ID or the beginning of it, by 'last', or by a Job, a "
                        f"Result or a row of list(), and not by {shown(job)}")
    return name if name.startswith("jobs/") else f"jobs/{name}"


def state_of(word: str) -> job_pb2.Job.State:
    """The state of a word in any case. Raises ValueError with those there are."""
    states = dict(job_pb2.Job.State.items()[1:])
    if word.upper() not in states:
        raise ValueError(f"{word!r} is no state of a job" + expected(word.upper(), states))
    found: job_pb2.Job.State = states[word.upper()]
    return found


def list_request(states: Iterable[str], labels: Mapping[str, str] | None, name_prefix: str = "",
                 page_size: int = 0) -> job_service_pb2.ListJobsRequest:
    """A page of the jobs of a filter; `name_prefix` may be without `jobs/`."""
    if isinstance(states, str):
        states = (states,)
    return job_service_pb2.ListJobsRequest(
        states=[state_of(state) for state in states], labels=labels, page_size=page_size,
        name_prefix=job_name(name_prefix) if name_prefix else "")


class Search:
    """For the job that a text means. `request` asks the server for it; None: `name` is its name."""

    def __init__(self, job: JobLike) -> None:
        self.name = job_name(job)
        self._back = _steps_back(job) if isinstance(job, str) else None
        self.request: job_service_pb2.ListJobsRequest | None = None
        if not isinstance(job, str):
            return
        if self._back is not None:
            self.request = job_service_pb2.ListJobsRequest(page_size=self._back + 1)
        elif 0 < len(self.name) - len("jobs/") < _WHOLE:
            self.request = job_service_pb2.ListJobsRequest(name_prefix=self.name,
                                                           page_size=_CANDIDATES)

    def found(self, answer: job_service_pb2.ListJobsResponse) -> str:
        """The name of the job. A text with which no ID begins is taken for an ID, so that the server
        says that there is no such job."""
        if self._back is not None:
            return self._before_last(answer, self._back)
        names = [str(job.name) for job in answer.jobs if job.name.startswith(self.name)]
        if not names or self.name in names:
            return self.name
        if len(names) == 1:
            return names[0]
        raise AmbiguousJob(self.name, answer.jobs, bool(answer.next_page_token))

    def _before_last(self, answer: job_service_pb2.ListJobsResponse, back: int) -> str:
        count = len(answer.jobs)
        if count > back:
            return str(answer.jobs[back].name)
        there = f"the server has {count} job{'s' * (count != 1)}" if count else "the server has no jobs"
        raise JobNotFound(f"there is no {f'last~{back}' if back else 'last'}: {there}",
                          grpc.StatusCode.NOT_FOUND, "JOB_NOT_FOUND")


def _steps_back(text: str) -> int | None:
    """N of `last~N`, 0 for `last`; None for another text."""
    match = _LAST.fullmatch(text)
    if match is None:
        return None
    steps = "0" if match[1] is None else match[1]
    if not re.fullmatch(r"\d{1,3}", steps):
        raise ValueError(f"{text}: N of last~N is a whole number from 0 to {_MOST_BACK}")
    return int(steps)


def job_frame(jobs: Iterable[job_pb2.Job]) -> pd.DataFrame:
    """A row a job, indexed by its name."""
    jobs = list(jobs)
    frame = pd.DataFrame([_row(job) for job in jobs], columns=list(_COLUMNS),
                         index=pd.Index([job.name for job in jobs], name="name", dtype=object))
    for column in ("created", "ended"):
        frame[column] = pd.to_datetime(frame[column], utc=True)
    return frame


def _row(job: job_pb2.Job) -> tuple[Any, ...]:
    return (job.title, _kind(job), job_pb2.Job.State.Name(job.state),
            job_pb2.Job.Convergence.Name(job.convergence) if job.convergence else "",
            job.state_reason, _time(job, "create_time"), _time(job, "end_time"), job.owner,
            dict(job.labels), job.note)


def _kind(job: job_pb2.Job) -> str:
    """Lists leave the spec out, but of a sweep they have the number of its cells."""
    return "sweep" if job.HasField("sweep") or job.progress.cells else "scenario"


def _time(job: job_pb2.Job, field: str) -> datetime.datetime | None:
    if not job.HasField(field):
        return None
    moment: datetime.datetime = getattr(job, field).ToDatetime(datetime.timezone.utc)
    return moment
