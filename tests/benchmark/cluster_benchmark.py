"""What several contactd on one PostgreSQL database do, beside one with a directory. One machine stands
for several. Prints one table.

  CONTACTD=build/release/server/contactd PYTHONPATH=build/release/python:tests/system \\
    /usr/bin/python3 tests/benchmark/cluster_benchmark.py

--tiny only shows that it runs.
"""

import concurrent.futures
import pathlib
import shutil
import signal
import sys
import tempfile
import threading
import time

import grpc
from contact.v1 import job_service_pb2, scenario_pb2
from contactd import ENDED, PATIENCE_S, Job, Server, endless_and_slow, spring_wall, three_ball_chain
from shared import LEASE_S, Shared

TINY = "--tiny" in sys.argv[1:]
JOBS = 40 if TINY else 2000
CLIENTS = 16
WATCHERS = 6 if TINY else 300  # On three fronts together; Python's clients take the most time.
SWEEP_S = 2 if TINY else 12
FLAGS = ("--max-creates-per-second=1e6", "--max-create-burst=100000")
ROWS = []


class Ground:
    """Has what Shared asks of a test."""

    def __init__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="contact-bench-"))
        self.ends = []

    def addCleanup(self, end, *arguments):  # pylint: disable=invalid-name
        self.ends.append(lambda: end(*arguments))

    def clean(self):
        for end in reversed(self.ends):
            end()
        shutil.rmtree(self.folder, ignore_errors=True)


def tell(what, figure):
    ROWS.append((what, figure))
    print(f"{what:<62} {figure}", flush=True)


def percentile(values, percent):
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(len(ordered) * percent / 100))]


def submit_all(fronts):
    """Seconds that it takes to create JOBS jobs, and names."""
    start = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(max_workers=CLIENTS) as pool:
        names = list(pool.map(lambda i: fronts[i % len(fronts)].create(three_ball_chain()).name,
                              range(JOBS)))
    return time.monotonic() - start, names


def await_all(front):
    """Seconds until no job is unfinished."""
    start = time.monotonic()
    while front.list(states=[Job.QUEUED, Job.RUNNING], page_size=1).jobs:
        time.sleep(0.02)
    return time.monotonic() - start


def jobs(name, fronts, start_workers):
    """Created without workers, then run by them."""
    took, _ = submit_all(fronts)
    tell(f"{name}: jobs created a second, {CLIENTS} clients", f"{JOBS / took:.0f}")
    start_workers()
    tell(f"{name}: 1-ms jobs run a second", f"{JOBS / await_all(fronts[0]):.0f}")


def sweep_seconds(server, sweep):
    start = time.monotonic()
    name = server.stub.CreateJob(job_service_pb2.CreateJobRequest(job=Job(sweep=sweep)),
                                 timeout=PATIENCE_S).name
    while server.get(name).state not in ENDED:
        time.sleep(0.05)
    return time.monotonic() - start


def sweep_of(pace, cells=400):
    axis = scenario_pb2.Sweep.Axis(field="contacts[0].stiffness",
                                   values=[1.8e7 * (1 + i / 1000) for i in range(cells)])
    return scenario_pb2.Sweep(base=spring_wall(SWEEP_S / cells / pace), axes=[axis])


def watch_latency(fronts, name):
    """Of cycles, from the moment they are recorded to that a client has them [s]."""
    late, lock = [], threading.Lock()
    deadline = time.monotonic() + (2 if TINY else 8)

    def watch(front):
        call = front.watch(name, live_only=True, kinds=["cycle"])
        try:
            for message in call:
                now = time.time()
                with lock:
                    late.extend(now - event.event_time.ToMicroseconds() / 1e6
                                for event in message.events if event.HasField("cycle"))
                if time.monotonic() > deadline:
                    call.cancel()
        except grpc.RpcError:
            pass

    threads = [threading.Thread(target=watch, args=(fronts[i % 3],)) for i in range(WATCHERS)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return late


def main():
    ground = Ground()
    try:
        embedded = Server(ground.folder / "data", "--workers=2", *FLAGS, store="")
        ground.addCleanup(embedded.kill)
        embedded.start()
        pace = embedded.run(spring_wall(1.0)).summary.wall_time_s
        took, _ = submit_all([embedded])
        tell(f"directory: jobs created a second while they run, {CLIENTS} clients",
             f"{JOBS / took:.0f}")
        await_all(embedded)
        alone = sweep_seconds(embedded, sweep_of(pace))
        tell("directory: cells a second, 2 threads", f"{400 / alone:.0f}")
        embedded.terminate()

        shared = Shared(ground)
        fronts = [shared.front(*FLAGS) for _ in range(3)]
        workers = []
        jobs("3 fronts, 2 workers", fronts,
             lambda: workers.extend(shared.worker("--workers=1") for _ in range(2)))
        both = sweep_seconds(fronts[0], sweep_of(pace))
        workers.pop().end()
        one = sweep_seconds(fronts[0], sweep_of(pace))
        tell("cells a second, 1 and 2 workers of 1 thread", f"{400 / one:.0f}, {400 / both:.0f}")

        name = fronts[0].create(endless_and_slow()).name
        while fronts[0].get(name).state != Job.RUNNING:
            time.sleep(0.05)
        late = watch_latency(fronts, name)
        tell(f"cycle to {WATCHERS} watchers on 3 fronts, p50 and p99 [ms]",
             f"{1e3 * percentile(late, 50):.0f}, {1e3 * percentile(late, 99):.0f}")

        workers.append(shared.worker("--workers=1"))
        workers[0].end(signal.SIGKILL)
        died = time.monotonic()
        while fronts[0].get(name).attempt < 2:
            time.sleep(0.02)
        tell(f"a job runs again after kill -9, lease {LEASE_S} s [s]", f"{time.monotonic() - died:.1f}")
        fronts[0].kill()
        died = time.monotonic()
        next(iter(fronts[1].watch(name, live_only=True, kinds=["cycle"])))
        tell("a watcher has events of another front [s]", f"{time.monotonic() - died:.2f}")
        fronts[1].cancel(name)
    finally:
        ground.clean()


if __name__ == "__main__":
    main()
