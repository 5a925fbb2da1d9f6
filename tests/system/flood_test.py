"""Floods of connections and of frames: the server lives on, and serves who is honest."""

import contextlib
import itertools
import resource
import socket
import statistics
import struct
import threading
import time
import unittest

import grpc
import http2
from contact.v1 import job_service_pb2, job_service_pb2_grpc
from contactd import PATIENCE_S, ServerTest, endless_and_slow

DESCRIPTORS = 512  # Of the server.
SLACK = 5  # A machine so many times slower must pass too.
FLOOD_S = 3
MOST_GROWTH = 1 << 29  # Of the server's memory [B],
MOST_PER_BATCH = 100 << 15  # more for each batch of 100 calls that gRPC has not yet let go.
INFO = "/contact.v1.JobService/GetServerInfo"
WATCH = "/contact.v1.JobService/WatchJob"


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
    """One client that sends frames as fast as it can, and reads no answer.

    gRPC 1.51 reads such frames faster than it acts on them, so what waits takes memory while the
    flood lasts: some 10 KB for a call that was taken back, 100 bytes for the answer to a ping.
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

    def send(self, frames, until, sent):
        """Begins anew whenever the server has ended the connection."""
        while time.monotonic() < until:
            with contextlib.suppress(OSError), http2.greet(self.server.port) as connection:
                connection.settimeout(0.2)
                for number in itertools.count():
                    connection.sendall(frames(number))
                    sent.append(1)
                    if time.monotonic() > until:
                        break

    def flood(self, what, frames, most_per_batch=0):
        base, sent, waited = self.memory("VmRSS"), [], []
        until = time.monotonic() + FLOOD_S
        flood = threading.Thread(target=self.send, args=(frames, until, sent))
        flood.start()
        while flood.is_alive():
            waited.append(self.honest_call())
        flood.join()
        after = self.honest_call()
        growth = self.memory("VmHWM") - base
        waited.sort()
        print(f"{what}: {len(sent)} batches; {len(waited)} honest calls meanwhile, median "
              f"{1000 * statistics.median(waited):.1f} ms, worst {1000 * waited[-1]:.1f} ms; "
              f"{1000 * after:.1f} ms after it; {growth / 2**20:.1f} MiB more at most")
        self.assertLess(statistics.median(waited), 1.0 * SLACK)
        self.assertLess(after, 1.0 * SLACK)
        self.assertLess(growth, MOST_GROWTH + most_per_batch * len(sent))
        self.assertLivesOn()

    def test_pings(self):
        batch = http2.frame(http2.PING, 0, 0, bytes(8)) * 500
        self.flood("PING", lambda _: batch)

    def test_settings(self):
        window = struct.pack(">HI", http2.INITIAL_WINDOW_SIZE, 65535)
        batch = http2.frame(http2.SETTINGS, 0, 0, window) * 500
        self.flood("SETTINGS", lambda _: batch)

    def resets(self, method, content):
        """Calls that are taken back at once, streams of their connection in turn."""
        def frames(number):
            first = 100 * number
            return b"".join(
                http2.headers(stream, method) + http2.message(stream, content) +
                http2.frame(http2.RST_STREAM, 0, stream, struct.pack(">I", 8))
                for stream in range(2 * first + 1, 2 * first + 201, 2))
        return frames

    def test_calls_reset_at_once(self):
        self.flood("RST_STREAM", self.resets(INFO, b""), MOST_PER_BATCH)

    def test_watches_reset_at_once(self):
        name = self.server.create(endless_and_slow()).name
        request = job_service_pb2.WatchJobRequest(name=name).SerializeToString()
        self.flood("RST_STREAM of watches", self.resets(WATCH, request), MOST_PER_BATCH)

    def test_calls_whose_answers_are_not_read(self):
        """No setting of the server is confirmed, so gRPC lets streams be opened without end."""
        def frames(number):
            return b"".join(http2.headers(stream, INFO) + http2.message(stream)
                            for stream in range(200 * number + 1, 200 * number + 201, 2))
        self.flood("unread calls", frames)


if __name__ == "__main__":
    unittest.main()
