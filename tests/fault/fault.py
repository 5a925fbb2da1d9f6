"""What the fault tests share: clients that note what they do, and looks into a server's process."""

import concurrent.futures
import contextlib
import os
import pathlib
import random
import sys
import time

import grpc
from contact.v1 import job_service_pb2, scenario_pb2
from contactd import PATIENCE_S, Job, Server, ServerTest, details_of, spring_wall, wait_for
from history import (ENDED, Final, History, digest, outcome_digest, result_digest,
                     violations)

# A promise is for an idle machine and an optimised build; here it may take so many times longer.
SLACK = float(os.environ.get("FAULT_SLACK", "5"))

# What a client meets while its server is away.
AWAY = (grpc.RpcError, ValueError)  # ValueError: the channel was closed meanwhile.


class FaultTest(ServerTest):
    """Has a seed, which FAULT_SEED repeats, a history, and says its figures in one line."""

    def setUp(self):
        self.seed = int(os.environ.get("FAULT_SEED", random.randrange(2**32)))
        self.random = random.Random(self.seed)
        super().setUp()
        self.history = History(self.folder / "history.jsonl")
        self.addCleanup(self.history.close)
        self.figures = {}
        self.addCleanup(self._say)

    def _say(self):
        figures = " ".join(f"{name}={value}" for name, value in self.figures.items())
        print(f"\n{self.id().split('.', 1)[1]}: seed={self.seed} {figures}", file=sys.stderr)

    def golden(self, *specs):
        """Outcome digests by spec digest, from a server with a directory that nobody disturbs."""
        server = Server(self.folder / "undisturbed", store="")
        self.addCleanup(server.kill)
        server.start()
        return {spec_digest(spec): outcome(server, spec) for spec in specs}

    def end_time(self, wall_s):
        """Of a spring_wall that takes about so long here; at least wall_s itself."""
        server = Server(self.folder / "pace")
        self.addCleanup(server.kill)
        server.start()
        summary = server.run(spring_wall(1.0)).summary
        server.kill()
        return max(1.0, 1 / summary.wall_time_s) * wall_s

    def assertKept(self, what, figure, promise, unit="s", slack=SLACK):
        """Notes a figure beside its promise."""
        self.figures[what] = f"{figure:.3g}{unit}(≤{promise}{unit})"
        self.assertLessEqual(figure, promise * slack, what)

    def assertPromises(self, server, **options):
        """Checks the history against all that the server holds once every job has ended."""
        final = everything(server)
        found = violations(self.history, final, **options)
        self.assertEqual(found, [], f"seed {self.seed}")
        return final


def everything(server):
    """Each job with its log, by name; waits until it has ended."""
    names = [job.name for job in all_jobs(server)]
    logs = {name: server.events(name) for name in names}
    return {name: Final.of(server.get(name), logs[name]) for name in names}


def all_jobs(server, **request):
    page = server.list(page_size=1000, **request)
    jobs = list(page.jobs)
    while page.next_page_token:
        page = server.list(page_size=1000, page_token=page.next_page_token, **request)
        jobs += page.jobs
    return jobs


def job_of(spec):
    """What to ask for: a scenario or a sweep."""
    return Job(sweep=spec) if isinstance(spec, scenario_pb2.Sweep) else Job(scenario=spec)


def spec_digest(spec):
    return digest(job_of(spec))


def outcome(server, spec):
    """Runs the job to its end; the digest of what it gave."""
    request = job_service_pb2.CreateJobRequest(job=job_of(spec))
    name = server.stub.CreateJob(request, timeout=PATIENCE_S).name
    events = server.events(name)
    return outcome_digest(server.get(name), events)


@contextlib.contextmanager
def clients():
    """`start(function, *arguments)` runs a client beside the test; all end, and none fails."""
    with concurrent.futures.ThreadPoolExecutor(max_workers=64) as pool:
        futures = []
        yield lambda function, *arguments: futures.append(pool.submit(function, *arguments))
        for future in futures:
            future.result(PATIENCE_S)


def patient(call):
    """Calls until it is answered, OK or not, by whichever server there is."""
    deadline = time.monotonic() + PATIENCE_S
    while True:
        try:
            return call()
        except AWAY as error:
            away = isinstance(error, ValueError) or error.code() in (
                grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.CANCELLED)
            if not away or time.monotonic() > deadline:
                raise
            time.sleep(0.02)


def submit(server, history, spec, request, **fields):
    """One CreateJob, noted; `request` names it for retries and in the job's labels."""
    asked = job_of(spec)
    asked.MergeFrom(Job(labels={"request": request}, **fields))
    with history.call("submit", request=request, spec=spec_digest(spec)) as call:
        job = server.stub.CreateJob(
            job_service_pb2.CreateJobRequest(job=asked, request_id=request), timeout=PATIENCE_S)
        call.ok(name=job.name)
        return job


def get(server, history, name):
    with history.call("get", name=name) as call:
        job = server.get(name)
        call.ok(state=job.state)
        return job


def watch_once(server, watch, on_event=lambda event: None):
    """Watches on where the watch is, to the end of the job or of the connection."""
    request = job_service_pb2.WatchJobRequest(
        name=watch.job, after_sequence=watch.position, kinds=sorted(watch.kinds))
    for message in server.stub.WatchJob(request, timeout=PATIENCE_S):
        for event in message.events:
            watch.add(event)
            on_event(event)
    watch.ended = True


def follow(server, watch, on_event=lambda event: None):
    """Watches to the end of the job, over as many connections as it takes."""
    patient(lambda: watch_once(server, watch, on_event))


def status_of(server, field):
    """A line of /proc/PID/status, such as VmRSS, in MB."""
    for line in pathlib.Path(f"/proc/{server.process.pid}/status").read_text().splitlines():
        if line.startswith(field + ":"):
            return int(line.split()[1]) / 1024
    raise KeyError(field)


def descriptors(server):
    return len(os.listdir(f"/proc/{server.process.pid}/fd"))


def cpu_by_thread(server):
    """Seconds that each thread has run."""
    seconds = {}
    for task in pathlib.Path(f"/proc/{server.process.pid}/task").iterdir():
        words = (task / "stat").read_text().rsplit(")", 1)[1].split()
        seconds[task.name] = (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")
    return seconds


def percentile(values, percent):
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(len(ordered) * percent / 100))]


__all__ = [name for name in dir() if not name.startswith("_")]
