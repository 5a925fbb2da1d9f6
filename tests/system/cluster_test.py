"""Fronts and workers that share a database: any front serves any job, and workers come and go."""

import concurrent.futures
import contextlib
import os
import pathlib
import subprocess
import threading
import time
import unittest

import grpc
from contact.v1 import job_service_pb2, scenario_pb2
from contactd import (BINARY, ENDED, PATIENCE_S, Job, Server, ServerTest, cluster, endless,
                      endless_and_slow, is_cycle, spring_wall, three_ball_chain, to_bytes,
                      wait_for)
from shared import LEASE_S, Shared

# Jobs of a worker that died run elsewhere so long after its last word; on an idle machine, a second
# after its lease.
TAKE_OVER_S = LEASE_S + 5
# A worker that was only slow runs other jobs after so long; on an idle machine, after its next word,
# a fifth of its lease later.
BACK_S = 10


def result_of(job):
    """What the physics gave."""
    return [to_bytes(part) for part in (*job.cycles, *job.groups, *job.final_bodies)]


def cpu_seconds(pid, thread):
    """What the threads of this name have used."""
    ticks = 0
    for stat in pathlib.Path(f"/proc/{pid}/task").glob("*/stat"):
        name, _, fields = stat.read_text().split(" ", 1)[1].partition(") ")
        if name == "(" + thread:
            ticks += sum(map(int, fields.split()[11:13]))
    return ticks / os.sysconf("SC_CLK_TCK")


class ClusterTest(ServerTest):
    def wide_sweep(self, wall_s, cells=200):
        """One that takes a single thread so long here."""
        pace = self.server.run(spring_wall(1.0)).summary.wall_time_s
        axis = scenario_pb2.Sweep.Axis(field="contacts[0].stiffness",
                                       values=[1.8e7 * (1 + i / 1000) for i in range(cells)])
        return scenario_pb2.Sweep(base=spring_wall(wall_s / cells / pace), axes=[axis],
                                  metrics=["iterations"])

    def setUp(self):
        super().setUp()  # The server of ServerTest has a directory: it is what others are compared with.
        self.shared = Shared(self)

    def make_server(self):
        return Server(self.folder / "data", store="")

    def running(self, front, scenario=None):
        name = front.create(scenario or endless()).name
        wait_for(lambda: front.get(name).state == Job.RUNNING)
        return name


class ServingTest(ClusterTest):
    def test_any_front_serves_any_job(self):
        one, two = self.shared.front(), self.shared.front()
        self.shared.worker("--workers=2")
        name = one.create(three_ball_chain(), request_id="once").name
        self.assertEqual(two.create(three_ball_chain(), request_id="once").name, name)
        events = two.events(name)
        self.assertWholeLog(events)
        embedded = self.server.run(three_ball_chain())
        self.assertEqual(result_of(two.get(name)), result_of(embedded))
        self.assertEqual(two.list().jobs[0].name, name)
        one.delete(name)
        with self.assertRaises(grpc.RpcError) as caught:
            two.get(name)
        self.assertEqual(caught.exception.code(), grpc.StatusCode.NOT_FOUND)

    def test_page_of_one_front_is_continued_by_another(self):
        one, two = self.shared.front(), self.shared.front()
        names = [one.create(endless()).name for _ in range(2)]
        token = one.list(page_size=1).next_page_token
        self.assertEqual(two.list(page_token=token).jobs[0].name, names[0])

    def test_watcher_follows_a_run_that_is_elsewhere(self):
        one, two = self.shared.front(), self.shared.front()
        self.shared.worker("--workers=1")
        name = self.running(one, endless_and_slow())
        arrived = []
        for message in two.watch(name, live_only=True):
            arrived += [event for event in message.events if is_cycle(event)]
            if len(arrived) > 10:  # ThreadSanitizer leaves one a second.
                break
        sequences = [event.sequence for event in arrived]
        self.assertEqual(sequences, sorted(set(sequences)))
        late = [time.time() - e.event_time.ToMicroseconds() / 1e6 for e in arrived[-5:]]
        self.assertLess(min(late), 5)

    def test_progress_of_a_sweep_reaches_watchers_and_readers_elsewhere(self):
        front = self.shared.front()
        self.shared.worker("--workers=1")
        name = front.stub.CreateJob(
            job_service_pb2.CreateJobRequest(job=Job(sweep=self.wide_sweep(20))),
            timeout=PATIENCE_S).name
        for message in front.watch(name, kinds=["progress"]):
            if any(e.WhichOneof("payload") == "progress" and e.progress.cells_done > 3
                   for e in message.events):
                break
        wait_for(lambda: front.get(name).progress.cells_done > 3)
        front.cancel(name)
        wait_for(lambda: front.get(name).state == Job.CANCELLED)

    def test_list_is_followed_across_fronts(self):
        one, two = self.shared.front(), self.shared.front()
        seen = {}
        call = two.stub.WatchJobs(job_service_pb2.WatchJobsRequest(), timeout=PATIENCE_S)
        ready, done = threading.Event(), threading.Event()

        def follow():
            try:
                for message in call:
                    for job in message.jobs:
                        seen.setdefault(job.name, []).append(job.state)
                        if job.state == Job.SUCCEEDED:
                            done.set()
                    if message.snapshot_complete:
                        ready.set()
            except grpc.RpcError:
                pass

        thread = threading.Thread(target=follow)
        thread.start()
        self.assertTrue(ready.wait(PATIENCE_S))
        name = one.create(three_ball_chain()).name
        wait_for(lambda: Job.QUEUED in seen.get(name, []))
        self.shared.worker()
        self.assertTrue(done.wait(PATIENCE_S))
        call.cancel()
        thread.join()

    def test_labels_of_a_run_change_at_any_front_and_outlast_it(self):
        one, two = self.shared.front(), self.shared.front()
        self.shared.worker()
        name = self.running(one)
        call = two.stub.WatchJobs(job_service_pb2.WatchJobsRequest(labels={"law": "x"}),
                                  timeout=PATIENCE_S)
        one.stub.UpdateJob(job_service_pb2.UpdateJobRequest(
            job=Job(name=name, labels={"law": "x"}, note="good")), timeout=PATIENCE_S)
        heard = next(job for message in call for job in message.jobs)
        self.assertEqual((heard.name, heard.note), (name, "good"))
        two.cancel(name)  # The worker writes what it knew of the job before.
        wait_for(lambda: one.get(name).state == Job.CANCELLED)
        self.assertEqual((one.get(name).labels, one.get(name).note), ({"law": "x"}, "good"))
        self.assertEqual([job.name for job in one.list(labels={"law": "x"}).jobs], [name])
        call.cancel()

    def test_server_tells_of_the_whole_cluster(self):
        front = self.shared.front()
        for threads in 1, 3:
            self.shared.worker(f"--workers={threads}")
        info = lambda: front.stub.GetServerInfo(job_service_pb2.GetServerInfoRequest(),
                                                timeout=PATIENCE_S)
        wait_for(lambda: info().workers == 4)
        self.running(front)
        wait_for(lambda: info().running_jobs == 1)

    def test_limits_hold_across_fronts(self):
        fronts = [self.shared.front("--max-queued-jobs=5", "--admin-slots=0") for _ in range(3)]

        def create(i):
            try:
                fronts[i % 3].create(three_ball_chain())
                return "created"
            except grpc.RpcError as error:
                return error.code()

        with concurrent.futures.ThreadPoolExecutor(max_workers=12) as pool:
            outcomes = list(pool.map(create, range(12)))
        self.assertEqual(outcomes.count("created"), 5, outcomes)
        self.assertEqual(outcomes.count(grpc.StatusCode.RESOURCE_EXHAUSTED), 7, outcomes)
        self.assertFails(grpc.StatusCode.RESOURCE_EXHAUSTED, "QUEUE_FULL", fronts[0].create,
                         three_ball_chain())


class SweepTest(ClusterTest):
    """Cells of one sweep on several workers."""

    def submit(self, front, sweep):
        return front.stub.CreateJob(job_service_pb2.CreateJobRequest(job=Job(sweep=sweep)),
                                    timeout=PATIENCE_S).name

    def cells_of(self, events):
        """What each cell gave, by number; each stands in the log once."""
        cells = [e.sweep_cell for e in events if e.WhichOneof("payload") == "sweep_cell"]
        found = {cell.index: to_bytes(cell) for cell in cells}
        self.assertEqual(len(found), len(cells), "a cell was stored twice")
        return found

    def golden(self, sweep):
        return self.cells_of(self.server.events(self.submit(self.server, sweep)))

    def loans(self):
        return int(self.shared.ask("SELECT count(*) FROM contactd.loans WHERE done"))

    def test_idle_workers_compute_cells_of_a_sweep(self):
        front, sweep = self.shared.front(), self.wide_sweep(8)
        for _ in range(2):
            self.shared.worker("--workers=1")
        name = self.submit(front, sweep)
        wait_for(lambda: self.loans() > 0)
        events = front.events(name)
        self.assertWholeLog(events)
        self.assertEqual(self.cells_of(events), self.golden(sweep))
        job = front.get(name)
        self.assertEqual((job.state, job.convergence), (Job.SUCCEEDED, Job.FULL))
        self.assertEqual((job.progress.cells, job.progress.cells_done), (200, 200))

    def test_cells_of_a_killed_borrower_and_of_a_killed_lender_are_computed_by_others(self):
        front, sweep = self.shared.front(), self.wide_sweep(8)
        workers = [self.shared.worker("--workers=1") for _ in range(3)]
        name = self.submit(front, sweep)
        wait_for(lambda: self.loans() > 0)
        lender = self.shared.ask(f"SELECT worker FROM contactd.jobs WHERE name = '{name}'")
        borrower = next(worker for worker in workers if f"job={name}" not in worker.log())
        self.assertTrue(lender)
        borrower.kill()
        time.sleep(1.5 * LEASE_S)
        next(worker for worker in workers if f"job={name}" in worker.log()).kill()
        events = front.events(name)
        self.assertWholeLog(events)
        self.assertEqual(self.cells_of(events), self.golden(sweep))
        self.assertEqual(front.get(name).progress.cells_done, 200)

    def test_sweep_with_loans_is_cancelled_and_handed_back(self):
        front = self.shared.front()
        first, second = (self.shared.worker("--workers=1") for _ in range(2))
        name = self.submit(front, self.wide_sweep(30))
        wait_for(lambda: self.loans() > 0)
        owner = first if f"job={name}" in first.log() else second
        self.assertEqual(owner.end()[0], 0)
        wait_for(lambda: front.get(name).state == Job.RUNNING)
        owner.start()
        front.cancel(name)
        self.assertLess(wait_for(lambda: front.get(name).state == Job.CANCELLED), 5)
        self.assertWholeLog(front.events(name))


class CancelTest(ClusterTest):
    def test_job_without_a_worker_is_cancelled(self):
        front = self.shared.front()
        name = front.create(endless()).name
        self.assertEqual(front.cancel(name).state, Job.CANCELLED)
        self.assertWholeLog(front.events(name))

    def test_run_elsewhere_is_cancelled_soon(self):
        front = self.shared.front()
        self.shared.worker()
        name = self.running(front)
        front.cancel(name)
        self.assertLess(wait_for(lambda: front.get(name).state == Job.CANCELLED), 5)


class WorkerTest(ClusterTest):
    def long(self):
        """Of a second or two, with checkpoints."""
        pace = self.server.run(spring_wall(1.0)).summary.wall_time_s
        return spring_wall(max(3.0, 3.0 / pace))

    def test_job_of_a_killed_worker_is_taken_over_within_its_lease(self):
        front = self.shared.front()
        scenario = self.long()
        first = self.shared.worker("--workers=1", "--checkpoint-interval=100ms")
        name = self.running(front, scenario)
        events, watcher = [], None

        def watch():
            events.extend(front.events(name))

        watcher = threading.Thread(target=watch)
        watcher.start()
        time.sleep(0.5)
        first.kill()
        died = time.monotonic()
        self.shared.worker("--workers=1")
        wait_for(lambda: front.get(name).attempt == 2)
        self.assertLess(time.monotonic() - died, TAKE_OVER_S)
        watcher.join(PATIENCE_S)
        self.assertWholeLog(events)
        job = front.get(name)
        self.assertEqual(job.state, Job.SUCCEEDED)
        self.assertEqual(result_of(job), result_of(self.server.run(scenario)))

    def test_stale_worker_is_fenced(self):
        stale = self.shared.worker("--workers=1", "--checkpoint-interval=100ms")
        self.assertFenced(stale, stale.freeze, stale.thaw)

    def test_worker_that_cannot_reach_the_database_is_fenced(self):
        """What it computes meanwhile comes when another one has its job."""
        way, address = self.shared.way()
        stale = self.shared.worker("--workers=1", "--checkpoint-interval=100ms", store=address)
        self.assertFenced(stale, way.pause, way.resume)

    def assertFenced(self, stale, go, come_back):
        """The worker goes for longer than its lease while it runs a job, and comes back."""
        front, scenario = self.shared.front(), self.long()
        name = self.running(front, scenario)
        with concurrent.futures.ThreadPoolExecutor() as pool:
            watch = pool.submit(front.events, name)
            go()
            other = self.shared.worker("--workers=1")
            time.sleep(1.5 * LEASE_S)
            wait_for(lambda: front.get(name).attempt == 2)
            come_back()
            wait_for(lambda: "has another worker" in stale.log() or "cannot store" in stale.log())
            events = watch.result(PATIENCE_S)
        self.assertWholeLog(events)
        starts = [e for e in events if e.WhichOneof("payload") == "attempt_started"]
        self.assertEqual([e.attempt_started.attempt for e in starts], [1, 2])
        self.assertEqual(sum(e.state_changed.state in ENDED for e in events), 1)
        job = front.get(name)
        self.assertEqual(result_of(job), result_of(self.server.run(scenario)))
        other.kill()
        alone = time.monotonic()
        self.assertEqual(front.run(three_ball_chain()).state, Job.SUCCEEDED)
        self.assertLess(time.monotonic() - alone, BACK_S)

    def test_worker_hands_its_jobs_back_when_it_is_asked_to_end(self):
        front = self.shared.front()
        scenario = self.long()
        first = self.shared.worker("--workers=1", "--checkpoint-interval=100ms")
        name = self.running(front, scenario)
        time.sleep(0.5)
        code, took = first.end()
        self.assertEqual(code, 0)
        self.assertLess(took, 5)
        self.assertEqual(front.get(name).state, Job.QUEUED)
        self.assertEqual(self.shared.ask("SELECT count(*) FROM contactd.workers"), "0")
        self.shared.worker("--workers=1")
        self.assertWholeLog(front.events(name))
        job = front.get(name)
        self.assertEqual((job.state, job.attempt), (Job.SUCCEEDED, 1), "the attempt goes on")
        self.assertEqual(result_of(job), result_of(self.server.run(scenario)))

    def test_idle_worker_leaves(self):
        front = self.shared.front()
        worker = self.shared.worker("--exit-when-idle=1s")
        front.run(three_ball_chain())
        self.assertEqual(worker.process.wait(PATIENCE_S), 0)
        self.assertIn("no job came", worker.log())

    def test_worker_leaves_before_its_time_is_over(self):
        front = self.shared.front()
        worker = self.shared.worker("--stop-after=2s", "--workers=1")
        name = self.running(front)
        self.assertEqual(worker.process.wait(PATIENCE_S), 0)
        self.assertEqual(front.get(name).state, Job.QUEUED)

    def test_waiting_jobs_are_shared_by_all_workers(self):
        front = self.shared.front()
        workers = [self.shared.worker("--workers=1") for _ in range(2)]
        names = [front.create(spring_wall(2.0)).name for _ in range(8)]
        for name in names:
            front.events(name, kinds=["state_changed"])
        ran = [sum(f"job={name} state=RUNNING" in worker.log() for name in names)
               for worker in workers]
        self.assertEqual(sum(ran), 8)
        self.assertGreaterEqual(min(ran), 2, ran)


    def test_worker_rests_while_jobs_wait_for_its_threads(self):
        front = self.shared.front()
        worker = self.shared.worker("--workers=1")
        self.running(front)
        for _ in range(3):
            front.create(endless())
        before, start = cpu_seconds(worker.process.pid, "claimer"), time.monotonic()
        time.sleep(2)
        share = (cpu_seconds(worker.process.pid, "claimer") - before) / (time.monotonic() - start)
        self.assertLess(share, 0.2)


class RolesTest(ClusterTest):
    """Front, worker and launcher connect as roles that own nothing and may read no table."""

    ROLES = "a_front", "a_worker", "a_launcher"

    def setUp(self):
        super().setUp()
        for role in self.ROLES:
            cluster().run(f"DROP ROLE IF EXISTS {role}; CREATE ROLE {role} LOGIN")
            self.addCleanup(cluster().run, f"DROP ROLE {role}")
        store = self.shared.store
        self.migrate = lambda: subprocess.run(
            [BINARY, "migrate", f"--store={store}",
             *(f"--grant-{role[2:]}={role}" for role in self.ROLES)],
            check=True, stdout=subprocess.DEVNULL)
        self.migrate()
        self.addCleanup(self.shared.ask, f"DROP OWNED BY {', '.join(self.ROLES)}")
        self.as_role = lambda role: store.replace("contactd@", f"{role}@")

    def may(self, role, sql):
        done = subprocess.run([cluster().bin / "psql", "-XAtq", "-c", sql, self.as_role(role)],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            self.assertRegex(done.stderr, "permission denied|must be owner")
        return done.returncode == 0

    def test_jobs_and_sweeps_run_and_are_deleted(self):
        front = self.shared.front("--max-stored-bytes-per-owner=1GiB", "--retain-for=1h",
                                  store=self.as_role("a_front"))
        for _ in range(2):
            self.shared.worker("--workers=1", store=self.as_role("a_worker"))
        job = front.run(three_ball_chain(), labels={"a": "b"})
        self.assertEqual(job.state, Job.SUCCEEDED)
        [listed] = front.list(labels={"a": "b"}).jobs
        self.assertEqual(listed.name, job.name)
        front.delete(job.name)
        name = front.stub.CreateJob(job_service_pb2.CreateJobRequest(job=Job(sweep=self.wide_sweep(3))),
                                    timeout=PATIENCE_S).name
        front.events(name)
        self.assertEqual(front.get(name).state, Job.SUCCEEDED)
        endless_job = self.running(front)
        front.cancel(endless_job)
        wait_for(lambda: front.get(endless_job).state == Job.CANCELLED)
        log = front.log() + "".join(path.read_text() for path in self.folder.glob("*worker*/*.log"))
        self.assertNotIn("permission denied", log)

    def test_nobody_reads_or_writes_but_by_the_functions_of_his_role(self):
        for role, sql in [
                ("a_front", "SELECT contactd.list_jobs(9, '', '{}', '{}', '{}', '', 9)"),
                ("a_front", "SELECT contactd.keep('name', 'value', true)"),
                ("a_worker", "SELECT contactd.leave('nobody')"),
                ("a_launcher", "SELECT * FROM contactd.demand()")]:
            with self.subTest(role=role, sql=sql):
                self.assertTrue(self.may(role, sql))
        for role in self.ROLES:
            for table in self.shared.ask("SELECT tablename FROM pg_tables"
                                         " WHERE schemaname = 'contactd'").split():
                for sql in f"SELECT FROM contactd.{table}", f"DELETE FROM contactd.{table}":
                    with self.subTest(role=role, sql=sql):
                        self.assertFalse(self.may(role, sql))
        for role, sql in [
                ("a_front", "UPDATE contactd.jobs SET state = 3"),
                ("a_worker", "INSERT INTO contactd.workers VALUES('w', 'h', 1, '', now())"),
                ("a_front", "SELECT contactd.leave('nobody')"),
                ("a_worker", "SELECT contactd.keep('page-secret', '', false)"),
                ("a_worker", "SELECT contactd.remove_job('jobs/a', '')"),
                ("a_worker", "SELECT contactd.remark_job('jobs/a', '', 0, '', '{}', '{}', 0, '')"),
                ("a_worker", "SELECT contactd.list_jobs(9, '', '{}', '{}', '{}', '', 9)"),
                ("a_launcher", "SELECT contactd.read_job('jobs/a', '', true, true, true)"),
                ("a_launcher", "SELECT contactd.purge(1)"),
                ("a_worker", "DROP TABLE contactd.jobs"),
                ("a_front", "CREATE TABLE contactd.mine(i int)")]:
            with self.subTest(role=role, sql=sql):
                self.assertFalse(self.may(role, sql))

    def test_nobody_else_may_connect(self):
        cluster().run("DROP ROLE IF EXISTS a_stranger; CREATE ROLE a_stranger LOGIN")
        self.addCleanup(cluster().run, "DROP ROLE a_stranger")
        self.assertFalse(self.may("a_stranger", "LISTEN contactd"))
        self.assertTrue(self.may("a_launcher", "SELECT"))

    def test_role_that_meets_older_tables_is_told_to_migrate(self):
        self.shared.ask("UPDATE contactd.version SET version = 1")
        for role in "front", "worker":
            done = subprocess.run([BINARY, f"--role={role}", f"--store={self.as_role('a_' + role)}"],
                                  capture_output=True, text=True, timeout=PATIENCE_S, check=False)
            with self.subTest(role=role):
                self.assertEqual(done.returncode, 2)
                self.assertRegex(done.stderr, r"\Acontactd: .* has tables of an older version; "
                                 r"run contactd migrate as their owner\n\Z")
        self.migrate()
        self.assertTrue(self.may("a_front", "SELECT contactd.schema_version()"))

    def test_rights_of_an_earlier_version_are_taken_back(self):
        self.shared.ask("GRANT SELECT ON contactd.jobs TO a_front;"
                        "GRANT EXECUTE ON FUNCTION contactd.leave TO a_launcher")
        self.migrate()
        self.assertFalse(self.may("a_front", "SELECT FROM contactd.jobs"))
        self.assertFalse(self.may("a_launcher", "SELECT contactd.leave('nobody')"))


class NotesTest(ClusterTest):
    """Notes that somebody makes up who may connect to the database."""

    def tell(self, line):
        self.shared.ask(f"SELECT pg_notify('contactd', E'{line}\\n')")

    def test_one_that_asks_for_a_cancellation_cancels_nothing(self):
        front = self.shared.front()
        self.shared.worker("--workers=1")
        name = self.running(front, endless_and_slow())
        for _ in range(3):
            self.tell(f"2 {name}  0 0 ")
            time.sleep(0.3)
        self.assertEqual(front.get(name).state, Job.RUNNING)
        front.cancel(name)
        wait_for(lambda: front.get(name).state == Job.CANCELLED)

    def test_one_that_tells_of_events_that_are_not_there_keeps_nobody_busy(self):
        front = self.shared.front()
        self.shared.worker("--workers=1")
        waiting = [self.running(front, endless_and_slow()), front.create(endless()).name]
        heard = iter(front.watch(waiting[1]))
        next(heard)
        used = lambda: sum(map(int, pathlib.Path(
            f"/proc/{front.process.pid}/stat").read_text().split()[13:15])) / os.sysconf("SC_CLK_TCK")
        time.sleep(1)
        before = used()
        self.tell(f"1 {waiting[1]} bG9jYWw= {2**64 - 1} 0 ")
        time.sleep(2)
        self.assertLess((used() - before) / 2, 0.3)
        for name in waiting:
            front.cancel(name)
        for message in heard:
            end = message
        self.assertEqual(end.events[-1].state_changed.state, Job.CANCELLED)


class FrontTest(ClusterTest):
    def test_watchers_are_soon_back_at_another_front_and_miss_nothing(self):
        fronts = [self.shared.front() for _ in range(2)]
        self.shared.worker("--workers=1")
        name = self.running(fronts[0], endless_and_slow())
        watches = [([], []) for _ in range(20)]  # What each hears of the first, and of the second.

        def follow(watch):
            for front, events in zip(fronts, watch):
                after = max((event.sequence for event in watch[0]), default=0)
                with contextlib.suppress(grpc.RpcError, ValueError):
                    for message in front.watch(name, after_sequence=after):
                        events.extend(message.events)

        with concurrent.futures.ThreadPoolExecutor(len(watches)) as pool:
            done = pool.map(follow, watches)
            wait_for(lambda: all(first for first, _ in watches))
            died = time.monotonic()
            fronts[0].kill()
            wait_for(lambda: all(second for _, second in watches))
            self.assertLess(time.monotonic() - died, 10)  # Promised: 3 s, on an idle machine.
            fronts[1].cancel(name)
            list(done)
        for first, second in watches:
            self.assertWholeLog(first + second)


if __name__ == "__main__":
    unittest.main()
