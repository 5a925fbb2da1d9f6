"""Floods of connections and of frames: the server lives on, and serves who is honest.

FLOOD_SECONDS says how long a flood of frames lasts.
"""

import contextlib
import datetime
import os
import pathlib
import resource
import shutil
import socket
import statistics
import tempfile
import time
import unittest

import flooding
import grpc
from authority import Authority
from contact.v1 import job_service_pb2, job_service_pb2_grpc
from contactd import PATIENCE_S, Server, ServerTest, endless_and_slow
from identity_test import token_line

DESCRIPTORS = 512  # Of the server.
SLACK = 5  # A machine so many times slower must pass too.
FLOOD_S = float(os.environ.get("FLOOD_SECONDS", "1"))
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


class FrameFloodTest(unittest.TestCase):
    """One server that asks nobody, on TCP and on a socket file, and one that asks for tokens over
    TLS, of which the attacker has none. All kinds of floods by eight connections each, and by one,
    two and four of TCP; FLOOD_ALL has all numbers everywhere.
    """

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="contactd-test-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.socket = cls.folder / "socket"
        cls.plain = Server(cls.folder / "plain", f"--http-listen=unix:{cls.socket}").start()
        cls.addClassCleanup(cls.plain.kill)
        cls.job = cls.plain.create(endless_and_slow()).name
        authority = Authority(cls.folder)
        certificate, key = authority.issue("server", "DNS:localhost,IP:127.0.0.1")
        cls.token = "ctk_aaaaaaaa_" + "x" * 43
        tokens = cls.folder / "tokens"
        tokens.touch(mode=0o600)
        end = datetime.datetime.now(datetime.timezone.utc) + datetime.timedelta(days=1)
        tokens.write_text(token_line(cls.token, "user:ann tenant:acme roles:read", end))
        cls.asking = Server(cls.folder / "asking", f"--tls-cert={certificate}", f"--tls-key={key}",
                            f"--tokens={tokens}").start()
        cls.addClassCleanup(cls.asking.kill)
        cls.root = authority.pem.read_bytes()
        cls.targets = {"tcp": (cls.plain, str(cls.plain.port)), "unix": (cls.plain, str(cls.socket)),
                       "tls": (cls.asking, f"tls:{cls.asking.port}")}
        for where in cls.targets:
            for _ in range(3):  # What a first call takes is no growth.
                with cls.channel(where) as channel:
                    cls.call(where, channel)

    @classmethod
    def channel(cls, where):
        """Of a new client."""
        options = [("grpc.use_local_subchannel_pool", 1), ("grpc.min_reconnect_backoff_ms", 100),
                   ("grpc.initial_reconnect_backoff_ms", 100)]
        if where == "tls":
            return grpc.secure_channel(f"localhost:{cls.asking.port}",
                                       grpc.ssl_channel_credentials(cls.root), options)
        address = f"unix:{cls.socket}" if where == "unix" else f"127.0.0.1:{cls.plain.port}"
        return grpc.insecure_channel(address, options)

    @classmethod
    def call(cls, where, channel):
        """Time until an answer, in seconds."""
        start = time.monotonic()
        metadata = [("authorization", f"Bearer {cls.token}")] if where == "tls" else []
        job_service_pb2_grpc.JobServiceStub(channel).GetServerInfo(
            job_service_pb2.GetServerInfoRequest(), timeout=PATIENCE_S, wait_for_ready=True,
            metadata=metadata)
        return time.monotonic() - start

    def memory(self, server, kind):
        """In bytes; VmHWM is the most there ever was."""
        with open(f"/proc/{server.process.pid}/status") as status:
            line = next(line for line in status if line.startswith(kind))
        return int(line.split()[1]) * 1024

    def check(self, where, connections, kind):
        server, target = self.targets[where]
        pathlib.Path(f"/proc/{server.process.pid}/clear_refs").write_text("5")  # VmHWM is VmRSS.
        base, honest, new = self.memory(server, "VmRSS"), [], []
        with self.channel(where) as mine, \
                flooding.start(target, connections, FLOOD_S, kind, self.job) as flood:
            while flood.poll() is None:
                honest.append(self.call(where, mine))
                with self.channel(where) as channel:
                    new.append(self.call(where, channel))
            batches, times = flood.stdout.read().split()
        with self.channel(where) as channel:
            after = self.call(where, channel)
        growth = self.memory(server, "VmHWM") - base
        p99 = [sorted(times)[int(0.99 * (len(times) - 1))] for times in (honest, new)]
        print(f"{kind}, {where} x {connections}: {batches} batches on {times} connections; "
              f"{len(honest)} honest calls p99 {1000 * p99[0]:.0f} ms, of new clients "
              f"{1000 * p99[1]:.0f} ms; {1000 * after:.1f} ms after it; "
              f"{growth / 2**20:.1f} MiB more at most")
        self.assertLess(max(p99), 1.0 * SLACK)
        self.assertLess(after, 2.0 * SLACK)
        self.assertLess(growth, MOST_GROWTH)
        self.assertIsNone(server.process.poll())
        self.assertLess(server.log().count("\n"), 500)


for kind in flooding.KINDS:
    for where in ("tcp", "unix", "tls"):
        for connections in (1, 2, 4, 8):
            if where == "tcp" or connections == 8 or os.environ.get("FLOOD_ALL"):
                setattr(FrameFloodTest,
                        f"test_{kind.replace(' ', '_')}_{where}_{connections}",
                        lambda test, case=(where, connections, kind): test.check(*case))


if __name__ == "__main__":
    unittest.main()
