"""Power cuts and failing writes: what was answered is on the disk, whatever became of the rest."""

import os
import threading
import unittest

import power_cut
from contactd import spring_wall, stored, three_ball_chain
from fault import *
from history import Call, Entry

IMAGES = 12
WRITES, SYNCS = range(1, 201), range(1, 31)
SAMPLE = 200 if os.environ.get("FAULT_WHOLE") else 15  # Of each.


class PowerTest(FaultTest):
    """A server on a disk that notes what is done to it."""

    def make_server(self, name="data", **options):
        self.notes = self.folder / f"{name}-notes"
        environment = power_cut.environment(self.folder / name, self.notes, **options)
        return Server(self.folder / name, "--workers=2", environment=environment)

    def size(self):
        return self.notes.stat().st_size

    def image(self, disk, name, kept=None):
        """A server on what a power cut left."""
        disk.image(self.folder / name, kept)
        server = Server(self.folder / name)
        self.addCleanup(server.kill)
        return server.start()


class PowerCutTest(PowerTest):
    """F3b."""

    def setUp(self):
        super().setUp()
        self.greeted = self.size()
        self.acknowledged = {}  # Size of the notes after the answer, by name of the job.
        self.seen = []  # The same of the events that the watcher got, with the events.

    def test_acknowledged_jobs_and_seen_events_survive(self):
        self.work()
        points = sorted(self.random.randrange(self.greeted, self.size()) for _ in range(IMAGES))
        for number, disk in enumerate(power_cut.cuts(self.notes, points)):
            server = self.image(disk, f"image-{number}", self.random if number % 3 else None)
            for job in all_jobs(server, labels={"request": "long"}):
                server.cancel(job.name)
            found = violations(self.before(points[number]), everything(server))
            self.assertEqual(found, [], f"seed {self.seed}, image {number}")
            server.kill()
        self.figures |= dict(images=IMAGES, acknowledged=len(self.acknowledged),
                             seen=len(self.seen))

    def test_a_disk_that_lies_loses_jobs(self):
        """The control: without its syncs the server would fail the test above."""
        self.work()
        *_, disk = power_cut.cuts(self.notes, [self.greeted, self.size()], honest=False)
        there = {job.name for job in all_jobs(self.image(disk, "image"))}
        lost = self.acknowledged.keys() - there
        self.figures |= dict(acknowledged=len(self.acknowledged), lost=len(lost))
        self.assertGreaterEqual(len(lost), 1)

    def test_a_cut_at_the_first_start_leaves_a_directory_that_starts(self):
        self.server.kill()
        points = sorted(self.random.randrange(self.greeted) for _ in range(IMAGES))
        for number, disk in enumerate(power_cut.cuts(self.notes, points)):
            server = self.image(disk, f"image-{number}", self.random)
            server.run(three_ball_chain())
            server.kill()

    def work(self):
        """Jobs from four clients beside a long one that is watched, until the power goes."""
        self.submit(spring_wall(100), "long")
        self.watch = self.history.watch(next(iter(self.acknowledged)))
        done = threading.Event()
        with clients() as start:
            start(self.keep_watching, done)
            with clients() as start_submitting:
                for client in range(4):
                    start_submitting(self.submit_some, client)
            done.set()
            self.server.kill()

    def submit(self, scenario, request):
        name = submit(self.server, self.history, scenario, request).name
        self.acknowledged[name] = self.size()

    def submit_some(self, client):
        for i in range(20):
            self.submit(three_ball_chain(), f"{client}-{i}")

    def keep_watching(self, done):
        try:
            for message in self.server.watch(self.watch.job):
                size = self.size()
                self.seen += [(size, Entry.of(event)) for event in message.events if stored(event)]
        except grpc.RpcError:
            self.assertTrue(done.is_set())

    def before(self, point):
        """The history as it was when the power went: what was not yet answered is unknown."""
        history = History()
        for call in self.history.calls:
            answered = self.acknowledged[call.answer["name"]] <= point
            history.calls.append(call if answered else Call(call.op, call.args, call.start))
        entries = [entry for size, entry in self.seen if size <= point]
        if entries:
            watch = history.watch(self.watch.job)
            watch.entries, watch.position = entries, entries[-1].sequence
        return history


class FailingDiskTest(PowerTest):
    """F5."""

    def test_no_failed_write_is_answered_with_success(self):
        self.fail_at("fail_write", WRITES)

    def test_no_failed_sync_is_answered_with_success(self):
        self.fail_at("fail_sync", SYNCS)

    def fail_at(self, what, positions):
        sample = sorted(self.random.sample(positions, min(SAMPLE, len(positions))))
        ends = {}
        for position in sample:
            with self.subTest(position=position):
                end = self.fail_once(**{what: position})
                ends[end] = ends.get(end, 0) + 1
        self.figures |= dict(positions=len(sample)) | ends

    def fail_once(self, **failure):
        """Works until that fails, cuts the power, and looks for what was acknowledged."""
        position = next(iter(failure.values()))
        history = History()
        server = self.make_server(f"data-{position}", **failure)
        self.addCleanup(server.kill)
        end = self.work(server, history)
        *_, disk = power_cut.cuts(self.notes, [self.size()])
        server = self.image(disk, f"image-{position}", self.random)
        self.assertEqual(violations(history, everything(server)), [])
        server.run(three_ball_chain())
        server.kill()
        return end

    def work(self, server, history):
        """What the failure led to."""
        try:
            server.start()
        except RuntimeError as error:
            self.assertIn("contactd: ", str(error), "a start that fails says why")
            return "refused"
        for i in range(8):
            try:
                name = submit(server, history, three_ball_chain(), f"{i}").name
                watch_once(server, history.watch(name))
                get(server, history, name)
            except grpc.RpcError as error:
                self.assertNotEqual(error.code(), grpc.StatusCode.DEADLINE_EXCEEDED)
                if server.process.poll() is not None:
                    break
        code, _ = server.terminate()
        self.assertIn(code, (0, 1), "it ends as told, or because the disk failed")
        return f"ended_with_{code}"


if __name__ == "__main__":
    unittest.main()
