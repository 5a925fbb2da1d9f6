"""contactd behind nginx with the configuration of deploy/nginx: clients need a certificate, and
floods cost contactd nothing."""

import contextlib
import itertools
import pathlib
import socket
import ssl
import statistics
import subprocess
import threading
import time
import unittest

import grpc
import http2
from authority import Authority
from contact.v1 import job_service_pb2, job_service_pb2_grpc
from contactd import PATIENCE_S, Job, Server, ServerTest, three_ball_chain
from tools import tool

SHIPPED = pathlib.Path(__file__).resolve().parents[2] / "deploy/nginx/contactd.conf"
INFO = "/contact.v1.JobService/GetServerInfo"
FLOOD_S = 2
MOST_GROWTH = 32 << 20  # Of contactd's memory in a flood [B].
MOST_WAIT_S = 5  # Of an honest client beside a flood, also on a slow machine.


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


class NginxTest(ServerTest):

    def make_server(self):
        return Server(self.folder / "data", f"--listen=unix:{self.folder}/contactd.sock",
                      f"--trusted-proxy=unix:{self.folder}/proxy.sock")

    def setUp(self):
        nginx = tool("nginx")
        super().setUp()
        self.ca = Authority(self.folder)
        self.ca.issue("server", "DNS:localhost")
        self.client = self.ca.issue("client", "DNS:client")
        self.port = free_port()
        (self.folder / "contactd.conf").write_text(self.configuration())
        (self.folder / "nginx.conf").write_text(
            f"daemon off; master_process off; pid {self.folder}/pid; error_log stderr;\n"
            f"events {{ worker_connections 1024; }}\nhttp {{ access_log off;\n" + "".join(
                f"{kind}_temp_path {self.folder}/{kind};\n"
                for kind in ("client_body", "proxy", "fastcgi", "uwsgi", "scgi"))
            + "include contactd.conf;\n}\n")
        with open(self.folder / "nginx.log", "w") as log:
            self.nginx = subprocess.Popen(
                [nginx, "-p", self.folder, "-c", self.folder / "nginx.conf", "-e", "stderr"],
                stderr=log)
        self.addCleanup(self.stop_nginx)
        self.server.stub = self.connect()  # What the test calls goes through nginx.
        self.info(wait_for_ready=True)

    def info(self, stub=None, **options):
        return (stub or self.server.stub).GetServerInfo(
            job_service_pb2.GetServerInfoRequest(), timeout=PATIENCE_S, **options)

    def stop_nginx(self):
        self.nginx.kill()
        self.nginx.wait()

    def configuration(self):
        """The shipped one; only places differ."""
        text = SHIPPED.read_text()
        for place, here in (("/run/contactd", self.folder), ("listen 443 ", f"listen 127.0.0.1:{self.port} "),
                            ("contactd.example.org", "localhost"),
                            ("/etc/nginx/contactd/clients.pem", self.ca.pem),
                            ("/etc/nginx/contactd", self.folder)):
            self.assertIn(place, text)
            text = text.replace(place, str(here))
        return text

    def connect(self, known=True):
        chain, key = (file.read_bytes() if known else None for file in self.client)
        credentials = grpc.ssl_channel_credentials(self.ca.pem.read_bytes(), key, chain)
        channel = grpc.secure_channel(f"localhost:{self.port}", credentials)
        self.addCleanup(channel.close)
        return job_service_pb2_grpc.JobServiceStub(channel)

    def test_client_with_a_certificate_runs_a_job_and_watches_it(self):
        job = self.server.run(three_ball_chain())
        self.assertEqual(job.state, Job.SUCCEEDED)
        self.assertWholeLog(self.server.events(job.name))

    def assertRefused(self, code, call, *arguments):
        with self.assertRaises(grpc.RpcError) as refused:
            call(*arguments)
        self.assertEqual(refused.exception.code(), code, refused.exception)

    def test_server_knows_the_client_by_the_certificate_that_nginx_saw(self):
        for claim in ((), [("x-contactd-principal", "user:eve tenant:acme roles:admin")]):
            principal = self.info(metadata=claim).principal
            self.assertEqual((principal.name, principal.tenant, *principal.roles, principal.how),
                             ("client", "acme", "submit", "proxy"))

    def test_client_whose_name_is_none_is_refused(self):
        self.client = self.ca.issue("not a name", "DNS:client")
        self.assertRefused(grpc.StatusCode.UNAUTHENTICATED, self.info, self.connect())

    def test_client_without_a_certificate_is_refused(self):
        with self.assertRaises(grpc.RpcError):
            self.info(self.connect(known=False))

    def test_request_that_is_too_large_has_a_status(self):
        self.assertRefused(grpc.StatusCode.RESOURCE_EXHAUSTED, self.server.create,
                           three_ball_chain(title="x" * (9 << 20)))

    def test_lost_server_is_unavailable(self):
        self.server.process.kill()
        self.server.process.wait()
        self.assertRefused(grpc.StatusCode.UNAVAILABLE, self.info)

    # Floods, by a client that has a certificate.

    def greet(self):
        context = ssl.create_default_context(cafile=self.ca.pem)
        context.load_cert_chain(*self.client)
        context.set_alpn_protocols(["h2"])
        plain = socket.create_connection(("127.0.0.1", self.port), 5)
        connection = context.wrap_socket(plain, server_hostname="localhost")
        connection.sendall(http2.PREFACE + http2.frame(http2.SETTINGS, 0, 0))
        return connection

    def send(self, frames, until):
        while time.monotonic() < until:
            with contextlib.suppress(OSError), self.greet() as connection:
                connection.settimeout(0.2)
                for number in itertools.count():
                    connection.sendall(frames(number))
                    if time.monotonic() > until:
                        break

    def memory(self):
        with open(f"/proc/{self.server.process.pid}/status") as status:
            line = next(line for line in status if line.startswith("VmRSS"))
        return int(line.split()[1]) << 10

    def assertFloodCostsNothing(self, what, frames):
        base, waited = self.memory(), []
        flood = threading.Thread(target=self.send, args=(frames, time.monotonic() + FLOOD_S))
        flood.start()
        while flood.is_alive():
            start = time.monotonic()
            with contextlib.suppress(grpc.RpcError):  # The limit of calls is one for this address.
                self.info()
            waited.append(time.monotonic() - start)
            time.sleep(0.01)
        flood.join()
        growth = self.memory() - base
        print(f"{what}: {growth >> 20} MB, honest calls median {statistics.median(waited):.4f} s, "
              f"worst {max(waited):.3f} s")
        self.assertLess(growth, MOST_GROWTH)
        self.assertLess(max(waited), MOST_WAIT_S)

    def test_calls_taken_back_cost_nothing(self):
        def frames(number):
            return b"".join(
                http2.headers(stream, INFO) + http2.frame(http2.RST_STREAM, 0, stream, b"\0\0\0\x08")
                for stream in range(200 * number + 1, 200 * number + 201, 2))
        self.assertFloodCostsNothing("calls taken back", frames)

    def test_answers_that_nobody_reads_cost_nothing(self):
        def frames(number):
            return b"".join(http2.headers(stream, INFO) + http2.message(stream)
                            for stream in range(200 * number + 1, 200 * number + 201, 2))
        self.assertFloodCostsNothing("answers not read", frames)

    def test_pings_cost_nothing(self):
        self.assertFloodCostsNothing(
            "pings", lambda number: 100 * http2.frame(http2.PING, 0, 0, bytes(8)))

    def test_settings_cost_nothing(self):
        self.assertFloodCostsNothing(
            "settings", lambda number: 100 * http2.frame(http2.SETTINGS, 0, 0))

    def test_endless_headers_cost_nothing(self):
        def frames(number):
            if number == 0:
                return http2.frame(http2.HEADERS, 0, 1, http2.header(b"a", b"b"))
            return 100 * http2.frame(http2.CONTINUATION, 0, 1, http2.header(b"a", b"b"))
        self.assertFloodCostsNothing("endless headers", frames)


if __name__ == "__main__":
    unittest.main()
