"""Floods of connections and of frames: the server lives on, and serves who is honest.

FLOOD_SECONDS says how long a flood of frames lasts.
"""

import contextlib
import itertools
import multiprocessing
import os
import resource
import socket
import statistics
import struct
import time
import unittest

import grpc
import http2
from contact.v1 import job_service_pb2, job_service_pb2_grpc
from contactd import PATIENCE_S, ServerTest, endless_and_slow

DESCRIPTORS = 512  # Of the server.
SLACK = 5  # A machine so many times slower must pass too.
FLOOD_S = float(os.environ.get("FLOOD_SECONDS", "3"))
MOST_GROWTH = 256 << 20  # Of the server's memory [B].
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

    gRPC 1.51 reads such frames faster than it acts on them, so what waits takes memory until the
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

    def send(self, frames, until, sent):
        """Begins anew whenever the server has ended the connection. A process of its own."""
        while time.monotonic() < until:
            with contextlib.suppress(OSError), http2.greet(self.server.port) as connection:
                sent[1] += 1
                connection.settimeout(0.2)
                for number in itertools.count():
                    connection.sendall(frames(number))
                    sent[0] += 1
                    if time.monotonic() > until:
                        break

    def flood(self, what, frames):
        base, sent, waited = self.memory("VmRSS"), multiprocessing.Array("q", 2), []
        until = time.monotonic() + FLOOD_S
        flood = multiprocessing.get_context("fork").Process(
            target=self.send, args=(frames, until, sent))
        flood.start()
        while flood.is_alive():
            waited.append(self.honest_call())
        flood.join()
        after = self.honest_call()
        growth = self.memory("VmHWM") - base
        waited.sort()
        p99 = waited[int(0.99 * (len(waited) - 1))]
        print(f"{what}: {sent[0]} batches on {sent[1]} connections; {len(waited)} honest calls "
              f"meanwhile, median {1000 * statistics.median(waited):.1f} ms, p99 {1000 * p99:.0f} "
              f"ms; {1000 * after:.1f} ms after it; {growth / 2**20:.1f} MiB more at most")
        self.assertLess(p99, 1.0 * SLACK)
        self.assertLess(after, 2.0 * SLACK)
        self.assertLess(growth, MOST_GROWTH)
        self.assertLivesOn()

    def test_pings(self):
        batch = http2.frame(http2.PING, 0, 0, bytes(8)) * 500
        self.flood("PING", lambda _: batch)

    def test_settings(self):
        window = struct.pack(">HI", http2.INITIAL_WINDOW_SIZE, 65535)
        batch = http2.frame(http2.SETTINGS, 0, 0, window) * 500
        self.flood("SETTINGS", lambda _: batch)

    def test_windows(self):
        batch = http2.frame(http2.WINDOW_UPDATE, 0, 0, struct.pack(">I", 1)) * 1000
        self.flood("WINDOW_UPDATE", lambda _: batch)

    def test_priorities(self):
        batch = http2.frame(http2.PRIORITY, 0, 1, struct.pack(">IB", 0, 16)) * 1000
        self.flood("PRIORITY", lambda _: batch)

    def test_headers_without_end(self):
        """No setting of the server is confirmed, so gRPC bounds no header."""
        start = http2.frame(http2.HEADERS, 0, 1, http2.header(b":method", b"POST"))
        batch = http2.frame(http2.CONTINUATION, 0, 1, http2.header(b"n", b"x" * 1000) * 16) * 4
        self.flood("CONTINUATION", lambda number: batch if number else start)

    def test_empty_headers_without_end(self):
        start = http2.frame(http2.HEADERS, 0, 1, http2.header(b":method", b"POST"))
        batch = http2.frame(http2.CONTINUATION, 0, 1) * 1000
        self.flood("empty CONTINUATION", lambda number: batch if number else start)

    def test_empty_data(self):
        batch = http2.frame(http2.DATA, 0, 1) * 1000
        self.flood("empty DATA", lambda number: batch if number else http2.headers(1, INFO))

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
        self.flood("RST_STREAM", self.resets(INFO, b""))

    def test_watches_reset_at_once(self):
        name = self.server.create(endless_and_slow()).name
        request = job_service_pb2.WatchJobRequest(name=name).SerializeToString()
        self.flood("RST_STREAM of watches", self.resets(WATCH, request))

    def test_calls_whose_answers_are_not_read(self):
        """No setting of the server is confirmed, so gRPC lets streams be opened without end."""
        def frames(number):
            return b"".join(http2.headers(stream, INFO) + http2.message(stream)
                            for stream in range(200 * number + 1, 200 * number + 201, 2))
        self.flood("unread calls", frames)


if __name__ == "__main__":
    unittest.main()
