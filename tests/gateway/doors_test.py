"""Who comes in by the gateway: as strict as the listener behind it; nobody can say who he is not; a
client that takes nothing costs little and is ended."""

import datetime
import http.client
import json
import os
import pathlib
import re
import socket
import subprocess
import sys
import time
import unittest

import grpc
from contact.v1 import job_service_pb2
from contactd import BINARY, PATIENCE_S, Server, ServerTest, endless, spring_wall
from gateway import SERVICE, Answer, GatewayTest, frame

sys.path.append(str(pathlib.Path(__file__).parents[1] / "system"))
from identity_test import token_line  # noqa: E402

# What all whole answers over 64 KiB may have until they are sent [B].
ANSWERS = 64 << 20


class UnixConnection(http.client.HTTPConnection):
    def __init__(self, path):
        super().__init__("localhost", timeout=PATIENCE_S)
        self.path = path

    def connect(self):
        self.sock = socket.socket(socket.AF_UNIX)
        self.sock.settimeout(PATIENCE_S)
        self.sock.connect(self.path)


class TokensTest(ServerTest):
    """A server that asks who calls, on socket files."""

    def make_server(self):
        expires = datetime.datetime.now(datetime.timezone.utc) + datetime.timedelta(days=1)
        self.tokens = {kind: f"ctk_{kind * 8}_{kind * 43}" for kind in "ar"}
        tokens = self.folder / "tokens"
        tokens.touch(mode=0o600)
        tokens.write_text(
            token_line(self.tokens["a"], "user:ada tenant:acme roles:admin", expires) +
            token_line(self.tokens["r"], "user:rob tenant:acme roles:read", expires))
        return Server(self.folder / "data", f"--listen=unix:{self.folder / 'grpc'}",
                      f"--http-listen=unix:{self.folder / 'http'}", f"--tokens={tokens}",
                      f"--audit-log={self.folder / 'audit'}")

    def call(self, method, message, token=None, **headers):
        connection = UnixConnection(str(self.folder / "http"))
        names = {"content-type": "application/json"} | headers
        if token:
            names["authorization"] = f"Bearer {token}"
        connection.request("POST", SERVICE + method, json.dumps(message), names)
        answer = Answer(connection.getresponse())
        connection.close()
        return answer

    def test_a_caller_without_a_good_token_is_unauthenticated(self):
        for token in (None, "ctk_00000000_" + "x" * 43, self.tokens["a"][:-1] + "b"):
            answer = self.call("ListJobs", {}, token)
            self.assertEqual((answer.status, answer.code()), (401, "unauthenticated"))

    def test_a_token_says_who_calls_and_what_that_one_may(self):
        info = self.call("GetServerInfo", {}, self.tokens["r"]).json()
        self.assertEqual(info["principal"]["name"], "rob")
        answer = self.call("CreateJob", {}, self.tokens["r"])
        self.assertEqual((answer.status, answer.code()), (403, "permission_denied"))

    def test_nobody_can_say_by_a_header_who_he_is(self):
        answer = self.call("ListJobs", {}, **{
            "x-contactd-principal": "user:root tenant:acme roles:admin"})
        self.assertEqual(answer.code(), "unauthenticated")

    def test_metrics_are_not_for_everybody_where_callers_are_asked(self):
        connection = UnixConnection(str(self.folder / "http"))
        connection.request("GET", "/metrics")
        self.assertEqual(Answer(connection.getresponse()).status, 403)
        connection.close()

    def test_refused_calls_are_in_the_audit_log(self):
        self.call("CreateJob", {}, self.tokens["r"])
        end = time.monotonic() + PATIENCE_S
        while "PERMISSION_DENIED" not in (self.folder / "audit").read_text():
            self.assertLess(time.monotonic(), end)
        self.assertIn(f'"peer":"unix:{os.getuid()}:', (self.folder / "audit").read_text())


class PeerTest(GatewayTest):

    @property
    def flags(self):
        return (*super().flags, f"--audit-log={self.folder / 'audit'}",
                "--max-watchers-per-peer=2")

    def peers(self, count):
        """The peers of the first `count` lines of the audit log."""
        end = time.monotonic() + PATIENCE_S
        while True:
            lines = (self.folder / "audit").read_text().splitlines()
            if len(lines) >= count:
                return [json.loads(line)["peer"] for line in lines]
            self.assertLess(time.monotonic(), end, lines)

    def test_the_audit_log_has_the_address_of_the_http_client(self):
        connection = http.client.HTTPConnection("127.0.0.1", self.http, timeout=PATIENCE_S)
        connection.connect()
        port = connection.sock.getsockname()[1]
        connection.request("POST", SERVICE + "CancelJob", '{"name":"jobs/x"}',
                           {"content-type": "application/json",
                            "x-contactd-peer": "ipv4:9.9.9.9:9"})
        connection.getresponse().read()
        connection.close()
        self.assertEqual(self.peers(1), [f"ipv4:127.0.0.1:{port}"])

    def test_a_native_client_cannot_name_another_address(self):
        with self.assertRaises(grpc.RpcError):
            self.server.stub.CancelJob(
                job_service_pb2.CancelJobRequest(name="jobs/x"), timeout=PATIENCE_S,
                metadata=[("x-contactd-peer", "ipv4:9.9.9.9:9")])
        self.assertRegex(self.peers(1)[0], r"^ipv4:127\.0\.0\.1:\d+$")
        self.assertNotIn("9.9.9.9", (self.folder / "audit").read_text())

    def test_streams_of_an_address_are_counted_with_those_of_native_clients(self):
        name = self.server.create(endless()).name
        native = self.server.watch(name)
        next(iter(native))
        first = self.connect()
        body = frame(json.dumps({"name": name}).encode())
        request = (f"POST {SERVICE}WatchJob HTTP/1.1\r\nhost: localhost\r\ncontent-type: "
                   f"application/connect+json\r\ncontent-length: {len(body)}\r\n\r\n").encode()
        first.sendall(request + body)
        first.recv(1)
        _, parts = self.stream("WatchJob", {"name": name})
        self.assertEqual(json.loads(parts[-1][1])["error"]["code"], "resource_exhausted")
        native.cancel()


class ReaderlessTest(GatewayTest):
    """A server with clients that take nothing."""

    CLIENTS = 100

    def memory(self, name):
        """A number of the server's memory, as the system calls it [B]."""
        status = pathlib.Path(f"/proc/{self.server.process.pid}/status").read_text()
        return int(re.search(rf"{name}:\s+(\d+) kB", status)[1]) << 10

    def post(self, method, kind, body):
        """Clients that ask so, and read nothing."""
        request = (f"POST {SERVICE}{method} HTTP/1.1\r\nhost: localhost\r\ncontent-type: "
                   f"{kind}\r\ncontent-length: {len(body)}\r\n\r\n").encode()
        raws = [self.connect() for _ in range(self.CLIENTS)]
        for raw in raws:
            raw.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            raw.sendall(request + body)
        return raws

    def long_job(self):
        """The name of a job with 200,000 samples."""
        scenario = spring_wall(end_time_s=2.0)
        scenario.output.sample_interval_s = 1e-5
        return self.server.run(scenario).name


class StalledTest(ReaderlessTest):
    http_flags = ("--write-stall-seconds=2", "--max-watchers-per-peer=1000", "--max-watchers=1000")

    def watchers(self):
        metrics = self.ask("GET", "/metrics").body.decode()
        return int(re.search(r"\ncontactd_watchers (\d+)", metrics)[1])

    def test_clients_that_take_nothing_cost_little_and_are_ended(self):
        request = job_service_pb2.WatchJobRequest(name=self.long_job())
        before = self.memory("VmRSS")
        raws = self.post("WatchJob", "application/connect+proto",
                         frame(request.SerializeToString()))
        for raw in raws:
            raw.recv(1)
        times = []
        for _ in range(50):
            start = time.monotonic()
            self.assertEqual(self.call("ListJobs", {}).status, 200)
            times.append(time.monotonic() - start)
        if not os.environ.get("CONTACT_SANITIZE"):  # Its allocator keeps what was freed.
            self.assertLess(self.memory("VmRSS") - before, self.CLIENTS * (1 << 20))
        self.assertLess(sorted(times)[len(times) // 2], 1.0)
        end = time.monotonic() + PATIENCE_S
        while self.watchers() > 0:
            self.assertLess(time.monotonic(), end)
            time.sleep(0.1)


class HeldAnswersTest(ReaderlessTest):
    CLIENTS = 40  # Ask for four times what is held.

    def test_large_answers_that_nobody_takes_are_held_within_a_bound(self):
        series = {"name": self.long_job(), "maxPoints": 1_000_000, "plainNumbers": True}
        whole = self.call("GetSeries", series)
        self.assertGreater(len(whole.body), 5_000_000)
        before = self.memory("VmRSS")
        raws = self.post("GetSeries", "application/json", json.dumps(series).encode())
        statuses = [int(raw.recv(12, socket.MSG_WAITALL).split()[1]) for raw in raws]
        held, most = self.memory("VmRSS") - before, self.memory("VmHWM") - before
        print(f"answers of {len(whole.body) / 1e6:.1f} MB: {statuses.count(200)} of "
              f"{self.CLIENTS} held, {held / 1e6:.0f} MB, {most / 1e6:.0f} MB while they were made",
              file=sys.stderr)
        late = {504} if os.environ.get("CONTACT_SANITIZE") else set()  # It makes few in 30 s.
        self.assertEqual(set(statuses) - late, {200, 429})
        self.assertLessEqual(statuses.count(200) * len(whole.body), ANSWERS)
        self.assertEqual(self.call("ListJobs", {}).status, 200)
        for raw in raws:
            raw.close()
        self.wait_until(lambda: self.call("GetSeries", series).status == 200)


class SettingsTest(unittest.TestCase):

    def refusal(self, *flags):
        run = subprocess.run([BINARY, "--data-dir=/nonexistent", *flags], capture_output=True,
                             text=True, timeout=PATIENCE_S, check=False)
        self.assertEqual(run.returncode, 2)
        return run.stderr

    def test_what_would_let_in_others_is_refused_with_what_to_do(self):
        self.assertIn("deploy/nginx", self.refusal("--http-listen=0.0.0.0:0"))
        self.assertIn("unix:PATH",
                      self.refusal("--listen=unix:/tmp/x", "--http-listen=127.0.0.1:0"))
        self.assertIn("deploy/nginx", self.refusal(
            "--listen=unix:/tmp/x", "--tokens=/x", "--http-listen=127.0.0.1:0"))
        self.assertIn("not HOST:PORT", self.refusal("--http-listen=8080"))


if __name__ == "__main__":
    unittest.main()
