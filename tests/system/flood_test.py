"""Floods of connections and of frames: the server lives on, and serves who is honest.

FLOOD_SECONDS says how long a flood of frames lasts.
"""

import contextlib
import os
import resource
import socket
import statistics
import time
import unittest

import flooding
import grpc
from contact.v1 import job_service_pb2, job_service_pb2_grpc
from contactd import PATIENCE_S, ServerTest, endless_and_slow

DESCRIPTORS = 512  # Of the server.
SLACK = 5  # A machine so many times slower must pass too.
FLOOD_S = float(os.environ.get("FLOOD_SECONDS", "3"))
MOST_GROWTH = 256 << 20  # Of the server's memory [B].


def few_descriptors():
    resource.setrlimit(resource.RLIMIT_NOFILE, (DESCRIPTORS, DESCRIPTORS))


def connections_possible():
    """As many as this process may open, up to 3000."""
    _, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    soft = min(hard, 4096)
    resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))
    return min(3000, soft - 200)


class HonestTest(ServerTest):
    """Has an honest client beside others."""

    def honest_call(self):
        """Time until a new client has an answer, in seconds."""
        start = time.monotonic()
        options = [("grpc.use_local_subchannel_pool", 1), ("grpc.min_reconnect_backoff_ms", 100),
                   ("grpc.initial_reconnect_backoff_ms", 100)]
        with grpc.insecure_channel(f"127.0.0.1:{self.server.port}", options) as channel:
            job_service_pb2_grpc.JobServiceStub(channel).GetServerInfo(
                job_service_pb2.GetServerInfoRequest(), timeout=PATIENCE_S, wait_for_ready=True)
        return time.monotonic() - start

    def assertLivesOn(self):
        self.assertIsNone(self.server.process.poll())
        self.assertLess(self.server.log().count("\n"), 200)


class FloodTest(HonestTest):

    flags = ("--max-connections-per-peer=300",)

    def setUp(self):
        super().setUp()
        self.server.terminate()
        self.server.start(preexec_fn=few_descriptors)

    @contextlib.contextmanager
    def flood(self, source):
        """Silent connections, far more than the server has descriptors for."""
        sockets = []
        for _ in range(connections_possible()):
            connection = socket.socket()
            connection.setblocking(False)
            connection.bind((source, 0))
            connection.connect_ex(("127.0.0.1", self.server.port))
            sockets.append(connection)
        try:
            yield len(sockets)
        finally:
            for connection in sockets:
                connection.close()

    def test_server_answers_within_a_second_after_a_flood(self):
        for _ in range(3):
            with self.flood("127.0.0.1") as connections:
                self.assertGreater(connections, DESCRIPTORS)
            waited = self.honest_call()
            print(f"{connections} silent connections, then an answer after {waited:.3f} s")
            self.assertLess(waited, 1.0 * SLACK)
        self.assertLivesOn()

    def test_one_address_cannot_keep_the_others_out(self):
        with self.flood("127.0.0.2") as connections:
            waited = sorted(self.honest_call() for _ in range(50))
        print(f"while {connections} silent connections come from elsewhere: "
              f"median {statistics.median(waited):.3f} s, worst {waited[-1]:.3f} s")
        self.assertLess(waited[-1], 1.0 * SLACK)
        self.assertLivesOn()

    def test_silent_connections_end_by_themselves(self):
        with self.flood("127.0.0.1"):
            waited = self.honest_call()  # While they all stay.
        print(f"an answer after {waited:.1f} s, by when the silent ones are closed")
        self.assertLess(waited, 8 * SLACK)
        self.assertLivesOn()


class FrameFloodTest(HonestTest):
    """gRPC 1.51 reads frames faster than it acts on them, so what waits takes memory until the
    connection is cut: some 10 KB for a call that was taken back, all bytes of a header.
    """

    def setUp(self):
        super().setUp()
        for _ in range(3):  # What a first call takes is no growth.
            self.honest_call()

    def memory(self, kind):
        """In bytes; VmHWM is the most there ever was."""
        with open(f"/proc/{self.server.process.pid}/status") as status:
            line = next(line for line in status if line.startswith(kind))
        return int(line.split()[1]) * 1024

    def check(self, kind):
        job = self.server.create(endless_and_slow()).name
        base, waited = self.memory("VmRSS"), []
        with flooding.start(self.server.port, FLOOD_S, kind, job) as flood:
            while flood.poll() is None:
                waited.append(self.honest_call())
            batches, connections = flood.stdout.read().split()
        after = self.honest_call()
        growth = self.memory("VmHWM") - base
        waited.sort()
        p99 = waited[int(0.99 * (len(waited) - 1))]
        print(f"{kind}: {batches} batches on {connections} connections; {len(waited)} honest calls "
              f"meanwhile, median {1000 * statistics.median(waited):.1f} ms, p99 {1000 * p99:.0f} "
              f"ms; {1000 * after:.1f} ms after it; {growth / 2**20:.1f} MiB more at most")
        self.assertLess(p99, 1.0 * SLACK)
        self.assertLess(after, 2.0 * SLACK)
        self.assertLess(growth, MOST_GROWTH)
        self.assertLivesOn()


for kind in flooding.KINDS:
    setattr(FrameFloodTest, "test_" + kind.replace(" ", "_"), lambda test, kind=kind: test.check(kind))


if __name__ == "__main__":
    unittest.main()
