"""What several contactd on one PostgreSQL database do, beside one with a directory and beside libpq
that sends the same statements. One machine stands for several. Prints one table; rates are medians.

  CONTACTD=build/release/server/contactd PEER=build/release/tests/benchmark/cluster_peer \\
    PYTHONPATH=build/release/python:tests/system:client/python \\
    /usr/bin/python3 tests/benchmark/cluster_benchmark.py

The database syncs as in use; POSTGRES_SETTINGS=fsync=off shows what that costs. --apart: jobs alone,
with a core for PostgreSQL, as on a machine of its own, and the others for all else, also beside
libpq. --tiny only shows that it runs.
"""

import concurrent.futures
import contextlib
import os
import pathlib
import resource
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time

os.environ.setdefault("POSTGRES_SETTINGS", "fsync=on")

# pylint: disable=wrong-import-position
from contact.v1 import job_service_pb2, scenario_pb2
from contactsim import Client
from contactd import (ENDED, PATIENCE_S, Job, Server, cluster, endless_and_slow, spring_wall,
                      three_ball_chain)
from shared import LEASE_S, Shared

TINY = "--tiny" in sys.argv[1:]
APART = "--apart" in sys.argv[1:]
PEER = os.environ["PEER"]
JOBS = 40 if TINY else 3000
ROUNDS = 1 if TINY else 7 if APART else 3  # Of libpq the first is faster than all others.
CLIENTS = 64
FRONTS = 3
WATCHERS = 6 if TINY else 999
WATCH_S = 2 if TINY else 10
RETURNING = 3 if TINY else 30  # Watchers whose front is killed.
SWEEP_S = 2 if TINY else 12
FLAGS = ("--max-creates-per-second=1e6", "--max-create-burst=100000",
         "--max-watchers-per-peer=1000")


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
    print(f"{what:<72} {figure}", flush=True)


def peer(*words):
    """The figures that cluster_peer prints."""
    told = subprocess.run([PEER, *map(str, words)], check=True, stdout=subprocess.PIPE, text=True)
    return [float(word) for word in told.stdout.split()]


def addresses(servers):
    return [server.address for server in servers]


def await_all(front):
    """Waits until no job is unfinished."""
    while front.list(states=[Job.QUEUED, Job.RUNNING], page_size=1).jobs:
        time.sleep(0.1)


def run_seconds(front):
    """From the start of the first of the newest JOBS to the end of the last."""
    jobs, page = [], front.list(page_size=1000)
    while len(jobs) < JOBS:
        jobs += page.jobs
        page = front.list(page_size=1000, page_token=page.next_page_token)
    jobs = jobs[:JOBS]
    return (max(job.end_time.ToMicroseconds() for job in jobs)
            - min(job.start_time.ToMicroseconds() for job in jobs)) / 1e6


def submit_and_run(servers):
    """Jobs a second that are taken while they run, and from the first submit to the last result."""
    start = time.monotonic()
    taken, = peer("submit", JOBS, CLIENTS, *addresses(servers))
    await_all(servers[0])
    return taken, JOBS / (time.monotonic() - start)


def times_of(pid):
    """Parent and processor times of a process and of its ended children, user's and system's."""
    stat = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(") ", 1)[1].split()
    return stat[1], [int(ticks) / os.sysconf("SC_CLK_TCK") for ticks in stat[11:15]]


def processor_seconds(servers):
    return sum(sum(times_of(server.process.pid)[1][:2]) for server in servers)


def database_processes():
    """Of PostgreSQL's children those that live: pid, and processor times as of times_of."""
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            parent, times = times_of(folder.name)
        except OSError:
            continue
        if parent == str(cluster().pid):
            yield int(folder.name), times


def database_seconds():
    """Processor time of PostgreSQL, also of its processes that are gone."""
    return (sum(times_of(cluster().pid)[1])
            + sum(sum(times[:2]) for _, times in database_processes()))


def set_apart():
    """A core for PostgreSQL, and the others for all that this process starts from here on."""
    core, *others = sorted(os.sched_getaffinity(0))
    os.sched_setaffinity(cluster().pid, {core})
    for pid, _ in database_processes():
        with contextlib.suppress(ProcessLookupError):  # It has ended meanwhile.
            os.sched_setaffinity(pid, {core})
    os.sched_setaffinity(0, others)


class Cost:
    """What PostgreSQL takes from here on for each job of one database: `<what>_ms` and so on."""

    def __init__(self, shared):
        shared.ask("CHECKPOINT")  # So that nobody pays for what others have written.
        self.shared = shared
        self.before = self.now()

    def now(self):
        log, size = self.shared.ask(
            "SELECT pg_current_wal_lsn() - '0/0', pg_database_size(current_database())").split("|")
        return database_seconds(), float(log), float(size)

    def of(self, what):
        seconds, log, size = ((b - a) / JOBS for a, b in zip(self.before, self.now()))
        return {what + "_ms": 1e3 * seconds, what + "_log": log / 1e3, what + "_disk": size / 1e3}


class Rates:
    """Of several rounds, by name."""

    def __init__(self):
        self.rates = {}

    def add(self, **rates):
        for name, rate in rates.items():
            self.rates.setdefault(name, []).append(rate)

    def of(self, name):
        return statistics.median(self.rates[name])

    def tell(self, what, name, *others):
        text = f"{self.of(name):.0f}"
        for other in others:
            shares = [a / b for a, b in zip(self.rates[name], self.rates[other])]
            text += f"; {other} {self.of(other):.0f}: {100 * statistics.median(shares):.0f} %"
        tell(what, text)

    def tell_costs(self, what):
        tell(f"PostgreSQL's time for a {what} job, and libpq's [ms]",
             f"{self.of(what + '_ms'):.2f}, {self.of('libpq_' + what + '_ms'):.2f}")
        tell(f"its log and disk for a {what} job [kB]",
             f"{self.of(what + '_log'):.1f}, {self.of(what + '_disk'):.1f}")


class Cluster:
    """Fronts, and a worker or two of one thread."""

    def __init__(self, ground, name):
        self.shared = Shared(ground, name)
        self.fronts = [self.shared.front(*FLAGS) for _ in range(FRONTS)]
        self.workers = []

    def work(self, count):
        """With so many workers from here on."""
        while len(self.workers) > count:
            self.workers.pop().end()
        while len(self.workers) < count:
            self.workers.append(self.shared.worker("--workers=1"))

    def sample(self):
        """A job that has ended."""
        self.work(1)
        name = self.fronts[0].run(three_ball_chain()).name
        self.work(0)
        return name


def stored_events(shared):
    return int(shared.ask("SELECT sum(last_sequence) FROM contactd.jobs"))


def run_ours(ours, rates):
    """Jobs are created without workers, then run by two."""
    cost, before = Cost(ours.shared), processor_seconds(ours.fronts)
    clients = resource.getrusage(resource.RUSAGE_CHILDREN)
    submits, = peer("submit", JOBS, CLIENTS, *addresses(ours.fronts))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    rates.add(submits=submits, **cost.of("created"),
              fronts_ms=1e3 * (processor_seconds(ours.fronts) - before) / JOBS,
              clients_ms=1e3 * (after.ru_utime + after.ru_stime - clients.ru_utime
                                - clients.ru_stime) / JOBS)
    cost, events = Cost(ours.shared), stored_events(ours.shared)
    ours.work(2)
    await_all(ours.fronts[0])
    seconds = run_seconds(ours.fronts[0])
    rates.add(runs=JOBS / seconds, events=(stored_events(ours.shared) - events) / seconds,
              **cost.of("run"),
              workers_ms=1e3 * processor_seconds(ours.workers) / JOBS)
    ours.work(0)


@contextlib.contextmanager
def bare_fronts(database, sample):
    """gRPC and libpq alone: the addresses of so many as there are fronts."""
    with contextlib.ExitStack() as stack:
        fronts = [stack.enter_context(subprocess.Popen(
            [PEER, "libpq-front", database, sample], stdin=subprocess.PIPE,
            stdout=subprocess.PIPE, text=True)) for _ in range(FRONTS)]
        yield [front.stdout.readline().strip() for front in fronts]
        for front in fronts:
            front.stdin.close()


def run_libpq(other, sample, rates):
    """The same by libpq, which repeats what one job has stored; and again, computing each."""
    database = other.shared.store
    with bare_fronts(database, sample) as fronts:
        served, = peer("submit", JOBS, CLIENTS, *fronts)
    rates.add(libpq_behind_grpc=served)
    peer("libpq-run", database, sample, 2)
    cost = Cost(other.shared)
    submits, = peer("libpq-submit", database, sample, JOBS, FRONTS)
    rates.add(libpq_submits=submits, **cost.of("libpq_created"))
    cost = Cost(other.shared)
    runs, events = peer("libpq-run", database, sample, 2)
    rates.add(libpq_runs=runs, libpq_events=events, **cost.of("libpq_run"))
    peer("libpq-submit", database, sample, JOBS, FRONTS)
    other.shared.ask("CHECKPOINT")
    runs, events = peer("libpq-run", database, sample, 2, "solve")
    rates.add(libpq_that_computes=runs, events_of_libpq_that_computes=events)


def run_small(ours, rates):
    """As run_ours, with jobs that record no trajectory."""
    peer("submit-small", JOBS, CLIENTS, *addresses(ours.fronts))
    cost = Cost(ours.shared)
    ours.work(2)
    await_all(ours.fronts[0])
    rates.add(small=JOBS / run_seconds(ours.fronts[0]), **cost.of("small"))
    ours.work(0)


def run_at_once(ours, rates):
    ours.work(2)
    taken, done = submit_and_run(ours.fronts)
    rates.add(taken=taken, done=done)
    ours.work(0)


def job_rates(ground):
    """Of a cluster, and of libpq on a database of its own, in turns."""
    ours, other = Cluster(ground, "ours"), Cluster(ground, "libpq")
    ours.sample()
    sample = other.sample()
    for front in other.fronts:
        front.kill()
    rates = Rates()
    for _ in range(ROUNDS):
        run_ours(ours, rates)
        run_libpq(other, sample, rates)
        run_small(ours, rates)
        run_at_once(ours, rates)
        for shared in ours.shared, other.shared:
            shared.ask("ANALYZE")  # As autovacuum does it each minute.
    rates.tell(f"{FRONTS} fronts: jobs created a second, {CLIENTS} calls at a time", "submits",
               "libpq_behind_grpc", "libpq_submits")
    tell("time of fronts and clients for a created job [ms]",
         f"{rates.of('fronts_ms'):.2f}, {rates.of('clients_ms'):.2f}")
    rates.tell_costs("created")
    rates.tell("2 workers: 1-ms jobs run a second", "runs", "libpq_that_computes",
               "libpq_runs")
    rates.tell("the same: events stored a second", "events", "events_of_libpq_that_computes",
               "libpq_events")
    tell("time of workers for a run job [ms]", f"{rates.of('workers_ms'):.2f}")
    rates.tell_costs("run")
    rates.tell("the same without a trajectory: jobs run a second", "small")
    tell("PostgreSQL's time [ms], its log and disk for one [kB]",
         f"{rates.of('small_ms'):.2f}, {rates.of('small_log'):.1f}, {rates.of('small_disk'):.1f}")
    rates.tell("both at once: created a second", "taken")
    rates.tell("both at once: from first submit to last result", "done")
    return ours


def embedded_rates(ground, pace):
    rates = Rates()
    with_directory = Server(ground.folder / "data", "--workers=2", *FLAGS, store="")
    ground.addCleanup(with_directory.kill)
    with_directory.start()
    for _ in range(ROUNDS):
        taken, done = submit_and_run([with_directory])
        rates.add(taken=taken, done=done)
    rates.tell("directory, both at once: created a second", "taken")
    rates.tell("directory, both at once: from first submit to last result", "done")
    tell("directory: cells a second, 2 threads", f"{cell_rate(with_directory, pace):.0f}")
    with_directory.cancel(watch("directory: ", [with_directory]))
    with_directory.terminate()


def cell_rate(server, pace, cells=400):
    axis = scenario_pb2.Sweep.Axis(field="contacts[0].stiffness",
                                   values=[1.8e7 * (1 + i / 1000) for i in range(cells)])
    sweep = scenario_pb2.Sweep(base=spring_wall(SWEEP_S / cells / pace), axes=[axis])
    start = time.monotonic()
    name = server.stub.CreateJob(job_service_pb2.CreateJobRequest(job=Job(sweep=sweep)),
                                 timeout=PATIENCE_S).name
    while server.get(name).state not in ENDED:
        time.sleep(0.05)
    return cells / (time.monotonic() - start)


def cells(ours, pace):
    rates = []
    for count in 1, 2:
        ours.work(count)
        rates.append(cell_rate(ours.fronts[0], pace))
    tell("cells a second, 1 and 2 workers of 1 thread", f"{rates[0]:.0f}, {rates[1]:.0f}")


def database_milliseconds():
    """Of each second."""
    before = database_seconds()
    time.sleep(WATCH_S)
    return 1e3 * (database_seconds() - before) / WATCH_S


def standing_costs(ours):
    """Of processes, and of a job that nobody watches."""
    ours.work(2)
    time.sleep(2)
    idle = database_milliseconds()
    name = ours.fronts[0].create(endless_and_slow()).name
    time.sleep(2)
    runs = database_milliseconds()
    ours.fronts[0].cancel(name)
    tell(f"PostgreSQL's time in a second, {FRONTS} fronts and 2 workers that idle [ms]",
         f"{idle:.0f}")
    tell("the same with one job that runs [ms]", f"{runs:.0f}")


def watch(where, servers):
    """Returns the job that is watched, which runs."""
    name = servers[0].create(endless_and_slow()).name
    while servers[0].get(name).state != Job.RUNNING:
        time.sleep(0.05)
    before = database_seconds()
    p50, p99, events = peer("watch", name, WATCHERS, WATCH_S, *addresses(servers))
    database = database_seconds() - before
    tell(f"{where}cycle to {WATCHERS} watchers, p50 and p99 [ms]", f"{p50:.0f}, {p99:.0f}")
    tell("the same: events received a second", f"{events / WATCH_S:.0f}")
    tell("the same: PostgreSQL's time in a second [ms]", f"{1e3 * database / WATCH_S:.0f}")
    return name


def take_over(ours, name):
    ours.work(2)
    ours.workers[0].end(signal.SIGKILL)
    died = time.monotonic()
    while ours.fronts[0].get(name).attempt < 2:
        time.sleep(0.02)
    tell(f"a job runs again after kill -9, lease {LEASE_S} s [s]",
         f"{time.monotonic() - died:.1f}")
    back = watchers_back(ours.fronts, name)
    tell(f"{RETURNING} watchers are back after kill -9 of their front, median and last [s]",
         f"{statistics.median(back):.2f}, {max(back):.2f}")
    ours.fronts[1].cancel(name)


def watched(ours):
    """Before all that leaves work for autovacuum, whose time would count."""
    standing_costs(ours)
    ours.work(1)
    take_over(ours, watch(f"{FRONTS} fronts: ", ours.fronts))
    ours.work(0)
    for front in ours.fronts:
        front.kill()


def watchers_back(fronts, name):
    """Seconds until clients, which know all fronts, have an event that is newer than the kill."""
    heard, died = set(), []

    def follow(number):
        with Client("ipv4:" + ",".join(addresses(fronts))) as client:
            for event in client.watch(name, live_only=True, kinds=["cycle"]):
                heard.add(number)
                if died and event.event_time.ToMicroseconds() / 1e6 > died[0]:
                    return time.time() - died[0]

    with concurrent.futures.ThreadPoolExecutor(RETURNING) as pool:
        back = [pool.submit(follow, number) for number in range(RETURNING)]
        while len(heard) < RETURNING:
            time.sleep(0.02)
        fronts[0].kill()
        died.append(time.time())
        return [future.result(PATIENCE_S) for future in back]


def main():
    ground = Ground()
    try:
        tell("load before", f"{os.getloadavg()[0]:.1f}")
        if APART:
            set_apart()
            job_rates(ground)
            tell("load after", f"{os.getloadavg()[0]:.1f}")
            return
        alone = Server(ground.folder / "pace", store="")
        ground.addCleanup(alone.kill)
        pace = alone.start().run(spring_wall(1.0)).summary.wall_time_s
        alone.terminate()
        embedded_rates(ground, pace)
        watched(Cluster(ground, "watched"))
        cells(job_rates(ground), pace)
        tell("load after", f"{os.getloadavg()[0]:.1f}")
    finally:
        ground.clean()


if __name__ == "__main__":
    main()
