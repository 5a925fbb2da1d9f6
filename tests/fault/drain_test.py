"""A server that is asked to end hands over: no attempt is burned, no watcher misses anything."""

import fcntl
import pathlib
import struct
import tempfile
import termios
import threading
import time
import unittest

import http2
from contactd import endless_and_slow, spring_wall
from fault import *

WATCHERS = 50
WATCH = "/contact.v1.JobService/WatchJob"


class DrainTest(FaultTest):
    """F23."""

    flags = ("--workers=4",)

    def test_the_next_server_goes_on(self):
        """Whenever the end comes, two jobs run; of the others some do, some wait, some are done."""
        end_time = self.end_time(0.5)
        finite = [spring_wall(end_time + 0.1 * i) for i in range(4)]
        golden = self.golden(*finite)
        names = [submit(self.server, self.history, scenario, f"{i}").name
                 for i, scenario in enumerate([endless_and_slow(), endless_and_slow(), *finite])]
        watching = threading.Semaphore(0)

        def watch(name):
            heard = iter([watching.release])
            follow(self.server, self.history.watch(name), lambda _: next(heard, lambda: None)())

        with clients() as start:
            for i in range(WATCHERS):
                start(watch, names[i % len(names)])
            for _ in range(WATCHERS):
                self.assertTrue(watching.acquire(timeout=PATIENCE_S))
            code, elapsed = self.server.terminate()
            self.assertEqual(code, 0, self.server.log())
            self.server.start()
            for name in names[:2]:
                wait_for(lambda: self.server.get(name).state == Job.RUNNING)
                self.server.cancel(name)
        final = self.assertPromises(self.server, golden=golden, max_attempts=1)
        starts = sum(entry.kind == "attempt_started" for job in final.values() for entry in job.log)
        self.assertGreaterEqual(starts, len(names) + 2, "the end met no running job")
        self.figures |= dict(jobs=len(names), watchers=WATCHERS, starts=starts)
        self.assertKept("exit", elapsed, 5, slack=1)


class StuckTest(FaultTest):
    """A client whose system has taken all it can, and who reads nothing."""

    flags = ("--workers=1", "--write-stall-seconds=6")

    def setUp(self):
        super().setUp()
        scenario = spring_wall(0.4)  # 11 MB of events: more than sockets keep.
        scenario.output.sample_interval_s = 2e-6
        self.name = self.server.run(scenario).name
        self.base = descriptors(self.server)
        self.client = self.connect()
        self.addCleanup(self.client.close)
        request = job_service_pb2.WatchJobRequest(name=self.name).SerializeToString()
        for stream in (1, 3, 5, 7):
            self.client.sendall(http2.headers(stream, WATCH) + http2.message(stream, request))
        wait_for(self.stuck)

    def connect(self):
        return http2.greet(self.server.port, window=http2.LARGEST_WINDOW)

    def stuck(self):
        return self.unsent() > 1 << 20

    def unsent(self):
        """Bytes in the server's socket that the client's does not take."""
        local = f"0100007F:{self.server.port:04X}"
        remote = f"0100007F:{self.client.getsockname()[1]:04X}"
        for line in pathlib.Path("/proc/net/tcp").read_text().splitlines():
            words = line.split()
            if words[1:3] == [local, remote]:
                return int(words[4].split(":")[0], 16)
        return 0

    def test_it_does_not_hold_up_the_end(self):
        code, elapsed = self.server.terminate()
        self.assertEqual(code, 0, self.server.log())
        self.assertKept("exit", elapsed, 5, slack=1)

    def test_it_is_cut(self):
        freed = wait_for(lambda: descriptors(self.server) <= self.base)
        self.assertKept("cut_after", freed, 10)


class StuckCrowdTest(FaultTest):
    """Ten thousand readers of streams, a hundred on each connection, who never read."""

    flags = ("--workers=1", "--max-watchers=10001", "--max-watchers-per-peer=10001")

    def job(self):
        """The name of a job with 11 MB of events."""
        scenario = spring_wall(0.4)
        scenario.output.sample_interval_s = 2e-6
        return self.server.run(scenario).name

    def assertCheap(self, method, request):
        base = status_of(self.server, "VmRSS")
        path = f"/contact.v1.JobService/{method}"
        for _ in range(100):
            client = http2.greet(self.server.port)
            self.addCleanup(client.close)
            client.sendall(b"".join(
                http2.headers(stream, path) + http2.message(stream, request.SerializeToString())
                for stream in range(1, 201, 2)))
        each = (self.settled() - base) / 10_000 * 1000
        # 28 kB are gRPC's two calls within the process; two messages or pieces of the trajectory wait.
        self.assertKept("kilobytes_a_stream", each, 96, "kB", slack=1)
        code, elapsed = self.server.terminate()
        self.assertEqual(code, 0, self.server.log())
        self.assertKept("exit", elapsed, 5, slack=1)

    def test_watchers_of_a_job(self):
        self.assertCheap("WatchJob", job_service_pb2.WatchJobRequest(name=self.job()))

    def test_watchers_of_all_jobs(self):
        labels = {f"label-{i:02}": "x" * 60 for i in range(16)}
        for _ in range(300):
            self.server.create(endless_and_slow(), labels=labels)
        self.assertCheap("WatchJobs", job_service_pb2.WatchJobsRequest())

    def test_readers_of_an_artifact(self):
        self.assertCheap("ReadArtifact", job_service_pb2.ReadArtifactRequest(
            name=self.job(), artifact="trajectory.csv"))

    def settled(self):
        """Memory once it has grown by less than a megabyte in a second, in MB."""
        before, now = 0, status_of(self.server, "VmRSS")
        while now > before + 1:
            time.sleep(1)
            before, now = now, status_of(self.server, "VmRSS")
        return now


class StuckOnFileTest(StuckTest):
    """The same through a socket file, where the system itself cuts nobody."""

    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.file = pathlib.Path(place.name) / "socket"
        self.flags = (*StuckTest.flags, f"--listen=unix:{self.file}")
        super().setUp()

    def connect(self):
        return http2.greet(None, window=http2.LARGEST_WINDOW, file=self.file)

    def stuck(self):
        waiting = fcntl.ioctl(self.client, termios.FIONREAD, bytes(4))
        return struct.unpack("i", waiting)[0] > 100_000


if __name__ == "__main__":
    unittest.main()
