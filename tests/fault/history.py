"""What clients asked and saw, and whether the service may have answered so.

A client notes every call before and after it; a call whose outcome it cannot know may have had
its effect or not. `violations` compares the notes with what the service holds in the end.
"""

import collections
import contextlib
import dataclasses
import hashlib
import json
import threading
import time

import grpc
from contact.v1 import job_pb2

Job = job_pb2.Job
ENDED = (Job.SUCCEEDED, Job.FAILED, Job.CANCELLED)
LOSSY = ("progress", "bookmark", "gap")  # Not stored: each watcher has its own.

# After these nothing was done; after all others nobody knows.
REFUSALS = {grpc.StatusCode.INVALID_ARGUMENT, grpc.StatusCode.ALREADY_EXISTS,
            grpc.StatusCode.NOT_FOUND, grpc.StatusCode.FAILED_PRECONDITION,
            grpc.StatusCode.RESOURCE_EXHAUSTED, grpc.StatusCode.OUT_OF_RANGE}


def digest(message):
    """SHA-256 over the canonical bytes of a message."""
    return hashlib.sha256(message.SerializeToString(deterministic=True)).hexdigest()


def result_digest(job):
    """Of what the physics gave, without what depends on the day and the machine."""
    result = Job(state=job.state, state_reason=job.state_reason, convergence=job.convergence,
                 cycles=job.cycles, groups=job.groups, final_bodies=job.final_bodies,
                 warnings=job.warnings)
    result.summary.CopyFrom(job.summary)
    result.summary.ClearField("wall_time_s")
    return digest(result)


def outcome_digest(job, events):
    """What the physics gave: of a scenario its result, of a sweep its cells."""
    if not job.HasField("sweep"):
        return result_digest(job)
    cells = {event.sweep_cell.index: digest(event.sweep_cell) for event in events
             if event.WhichOneof("payload") == "sweep_cell"}
    return hashlib.sha256(repr(sorted(cells.items())).encode()).hexdigest()


@dataclasses.dataclass
class Call:
    """One call: `unknown` until it is told otherwise."""
    op: str
    args: dict
    start: float
    end: float = None
    outcome: str = "unknown"
    answer: dict = dataclasses.field(default_factory=dict)

    def ok(self, **answer):
        self.outcome = "ok"
        self.answer = answer


def _unnumbered(event):
    copy = event.__class__()
    copy.CopyFrom(event)
    copy.ClearField("sequence")
    return copy


@dataclasses.dataclass
class Entry:
    """A stored event as a watcher or the final log has it."""
    sequence: int
    kind: str
    digest: str
    state: int = None  # Of state_changed.
    attempt: int = None  # Of attempt_started.
    samples: tuple = None  # First and number, of frame_chunk.
    cell: int = None  # Of sweep_cell.
    content: str = None  # Digest of all but the sequence: no two of an attempt have the same.

    @staticmethod
    def of(event):
        kind = event.WhichOneof("payload")
        entry = Entry(event.sequence, kind, digest(event), content=digest(_unnumbered(event)))
        if kind == "state_changed":
            entry.state = event.state_changed.state
        elif kind == "attempt_started":
            entry.attempt = event.attempt_started.attempt
        elif kind == "frame_chunk":
            entry.samples = event.frame_chunk.first_sample, event.frame_chunk.samples
        elif kind == "sweep_cell":
            entry.cell = event.sweep_cell.index
        return entry


class Watch:
    """What one watcher of one job got, over all its connections."""

    def __init__(self, job, after=0, kinds=()):
        self.job, self.after, self.kinds = job, after, frozenset(kinds)
        self.entries = []
        self.spared = []  # First and last sequence of each gap: frame chunks left out.
        self.position = after
        self.ended = False

    def add(self, event):
        kind = event.WhichOneof("payload")
        if kind == "gap":
            self.spared.append((event.gap.first_sequence, event.gap.last_sequence))
        if kind not in LOSSY:
            self.entries.append(Entry.of(event))
        if kind != "progress":
            self.position = max(self.position, event.sequence)

    def wants(self, kind):
        return not self.kinds or kind in self.kinds or kind == "state_changed"


@dataclasses.dataclass
class Final:
    """A job as the service holds it in the end."""
    state: int
    attempt: int
    spec: str
    request: str
    result: str
    log: list

    @staticmethod
    def of(job, events):
        spec = Job(scenario=job.scenario) if job.HasField("scenario") else Job(sweep=job.sweep)
        return Final(job.state, job.attempt, digest(spec), job.labels.get("request", ""),
                     outcome_digest(job, events), [Entry.of(e) for e in events
                                          if e.WhichOneof("payload") not in LOSSY])


class History:
    """Written by any number of threads, also to a file that outlives the test."""

    def __init__(self, path=None):
        self.calls, self.watches = [], []
        self._mutex = threading.Lock()
        self._file = open(path, "a", encoding="utf-8") if path else None

    @contextlib.contextmanager
    def call(self, op, **args):
        """The call is made in the body, which tells `ok`; a refusal is `fail`. Errors pass on."""
        call = Call(op, args, time.monotonic())
        with self._mutex:
            self.calls.append(call)
            self._write(call)
        try:
            yield call
        except grpc.RpcError as error:
            call.outcome = "fail" if error.code() in REFUSALS else "unknown"
            call.answer = {"code": error.code().name}
            raise
        finally:
            with self._mutex:
                call.end = time.monotonic()
                self._write(call)

    def watch(self, job, **options):
        watch = Watch(job, **options)
        with self._mutex:
            self.watches.append(watch)
        return watch

    def close(self):
        if self._file:
            self._file.close()

    def _write(self, call):
        if self._file:
            self._file.write(json.dumps(dataclasses.asdict(call)) + "\n")
            self._file.flush()


def violations(history, final, golden=None, max_attempts=None, resources=None):
    """All promises broken, in words; `final` has the jobs of the service by name.

    golden: outcome digest of a spec digest; max_attempts: of a job; resources: name -> (before,
    after) of what must be given back, such as streams and descriptors.
    """
    found = []
    for check in _acknowledged, _one_job_per_request, _watches, _life:
        found += check(history, final)
    for name, job in final.items():
        found += _log(name, job)
        expected = (golden or {}).get(job.spec)
        if job.state == Job.SUCCEEDED and expected not in (None, job.result):
            found.append(f"I6: {name} has another result than its scenario has")
        if max_attempts is not None and job.attempt > max_attempts:
            found.append(f"I7: {name} was attempted {job.attempt} times of {max_attempts}")
    for what, (before, after) in (resources or {}).items():
        if after > before:
            found.append(f"I8: {what}: {before} before, {after} after")
    return found


def _done(history, op, outcomes=("ok",)):
    return [call for call in history.calls if call.op == op and call.outcome in outcomes]


def _acknowledged(history, final):
    """I1: what was acknowledged is there, from then on, until it is deleted."""
    deletes = collections.defaultdict(list)
    for call in _done(history, "delete", ("ok", "unknown")):
        deletes[call.args["name"]].append(call)
    created = {call.answer["name"]: call.end for call in reversed(_done(history, "submit"))}
    for name in created.keys() - final.keys() - deletes.keys():
        yield f"I1: {name} was acknowledged and is lost"
    for call in _done(history, "get", ("fail",)):
        name = call.args["name"]
        gone = any(delete.start < call.end for delete in deletes[name])
        if call.answer["code"] == "NOT_FOUND" and created.get(name, call.end) < call.start \
                and not gone:
            yield f"I1: {name} was not found after it was acknowledged"
    for call in _done(history, "delete"):
        if call.args["name"] in final:
            yield f"I1: {call.args['name']} was deleted and is there"


def _one_job_per_request(history, final):
    """I2: a request makes one job at most, one that fails makes none."""
    specs, names, made = (collections.defaultdict(set) for _ in range(3))
    for call in _done(history, "submit"):
        specs[call.args["request"]].add(call.args["spec"])
        names[call.args["request"]].add(call.answer["name"])
    for name, job in final.items():
        made[job.request].add(name)
    for request in specs:
        if len(specs[request]) > 1:
            yield f"I2: request {request} was accepted with two specs"
    for request in names.keys() | made.keys():
        if request and len(names[request] | made[request]) > 1:
            yield f"I2: request {request} made {sorted(names[request] | made[request])}"
    possible = {call.args["request"] for call in _done(history, "submit", ("ok", "unknown"))}
    for request in made.keys() - possible:
        yield f"I2: {sorted(made[request])} of request {request!r}, which nobody made or all failed"


def _watches(history, final):
    """I3: a watcher sees the log, from where it began to where it is, once and in order."""
    for watch in history.watches:
        if watch.job not in final:
            continue
        seen = [(entry.sequence, entry.digest) for entry in watch.entries]
        last = final[watch.job].log[-1].sequence if watch.ended else watch.position
        spared = {sequence for first, last_spared in watch.spared
                  for sequence in range(first, last_spared + 1)}
        received = {entry.sequence for entry in watch.entries}
        expected = [(entry.sequence, entry.digest) for entry in final[watch.job].log
                    if watch.after < entry.sequence <= last and watch.wants(entry.kind)
                    and not (entry.kind == "frame_chunk" and entry.sequence in spared - received)]
        if seen != expected:
            wrong = next((i for i, (s, e) in enumerate(zip(seen, expected)) if s != e),
                         min(len(seen), len(expected)))
            yield (f"I3: a watcher of {watch.job} saw {len(seen)} events of {len(expected)}; "
                   f"they part at {seen[wrong:wrong + 1]} of {expected[wrong:wrong + 1]}")


def _log(name, job):
    """I3, I4, I5 and I7 of what is stored; I4, too: an attempt stores nothing twice."""
    if [entry.sequence for entry in job.log] != list(range(1, len(job.log) + 1)):
        yield f"I3: the log of {name} is not 1, 2, 3, …"
    attempt, samples, contents = 0, 0, set()
    for entry in job.log:
        if entry.content and entry.content in contents:
            yield f"I4: event {entry.sequence} of {name} repeats one of the same attempt"
        contents.add(entry.content)
        if entry.kind == "attempt_started":
            contents.clear()
            if entry.attempt not in (attempt, attempt + 1):
                yield f"I4: attempt {entry.attempt} of {name} came after {attempt}"
            attempt, samples = entry.attempt, 0
        elif entry.kind == "frame_chunk":
            if entry.samples[0] != samples:
                kinds = [(e.sequence, e.kind, e.attempt or e.samples or e.state)
                         for e in job.log[max(entry.sequence - 20, 0):entry.sequence + 3]]
                yield (f"I4: {name} mixes attempts at event {entry.sequence}: its samples begin at "
                       f"{entry.samples[0]}, those before end at {samples}; {kinds}")
            samples = sum(entry.samples)
    cells = [entry.cell for entry in job.log if entry.kind == "sweep_cell"]
    for cell in {cell for cell in cells if cells.count(cell) > 1}:
        yield f"I4: cell {cell} of {name} stands {cells.count(cell)} times in its log"
    ends = [entry.sequence for entry in job.log if entry.state in ENDED]
    if job.state in ENDED and ends != [len(job.log)] or job.state not in ENDED and ends:
        yield f"I5: {name} ends at events {ends} of {len(job.log)}"
    states = [entry.state for entry in job.log if entry.kind == "state_changed"]
    if states[-1:] not in ([job.state], []):
        yield f"I5: {name} is {job.state}, its log says {states[-1]}"
    if attempt and job.attempt not in (attempt, attempt - 1):  # One back: a drain burns none.
        yield f"I7: {name} counts {job.attempt} attempts, its log {attempt}"


def _life(history, final):
    """I5: a state that was seen to be final stays."""
    for call in _done(history, "get"):
        name, state = call.args["name"], call.answer["state"]
        if state in ENDED and name in final and final[name].state != state:
            yield f"I5: {name} was {state} and is {final[name].state}"
