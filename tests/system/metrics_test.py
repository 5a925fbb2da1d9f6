"""What contactd tells Prometheus agrees with what was done."""

import math
import re
import socket
import time
import unittest
import urllib.request

import grpc
from contact.v1 import job_service_pb2
from contactd import PATIENCE_S, ServerTest, endless, is_cycle, three_ball_chain

SERVICE = "/contact.v1.JobService/"
SAMPLE = re.compile(r'([a-z_]+)(?:\{((?:[a-z]+="[^"\\]*",?)*)\})? (\S+)')


def parse(text):
    """Checks the text format as promtool would, and returns {name: {labels: value}}."""
    values, kinds = {}, {}
    for line in text.splitlines():
        if line.startswith("# TYPE "):
            _, _, name, kind = line.split()
            assert name not in kinds, f"{name} comes twice"
            kinds[name] = kind
        elif not line.startswith("# HELP "):
            match = SAMPLE.fullmatch(line)
            assert match, line
            name, labels, value = match.groups()
            family = re.sub(r"_(bucket|sum|count)$", "", name)
            assert name in kinds or kinds.get(family) in ("histogram", "summary"), line
            assert kinds.get(name) != "counter" or name.endswith("_total"), line
            key = frozenset(re.findall(r'([a-z]+)="([^"]*)"', labels or ""))
            assert key not in values.setdefault(name, {}), line
            values[name][key] = float(value)
    return values


class MetricsTest(ServerTest):

    flags = ("--metrics-listen=127.0.0.1:0", "--workers=1", "--max-creates-per-second=0.001",
             "--max-create-burst=8", "--max-connections-per-peer=50")

    @property
    def metrics_port(self):
        return re.findall(r"metrics on port (\d+)", self.server.log())[-1]

    def scrape(self):
        page = f"http://127.0.0.1:{self.metrics_port}/metrics"
        with urllib.request.urlopen(page, timeout=PATIENCE_S) as page:
            return parse(page.read().decode())

    def value(self, name, **labels):
        return self.scrape().get(name, {}).get(frozenset(labels.items()), 0.0)

    def assertBecomes(self, expected, name, **labels):
        """A call is over for its client a moment before it is counted."""
        end = time.monotonic() + PATIENCE_S
        while (value := self.value(name, **labels)) != expected and time.monotonic() < end:
            time.sleep(0.02)
        self.assertEqual(value, expected, f"{name} {labels}")

    def test_hostile_requests_leave_the_page_of_metrics_as_it_is(self):
        """What civetweb 1.15 does wrong is in files and forms, of which there are none."""
        form = b"Content-Type: multipart/form-data; boundary=x\r\nContent-Length: 30\r\n\r\n--x\r\n"
        for request in (b"GET /" + b"../" * 2000 + b" HTTP/1.1\r\n\r\n",
                        b"GET /" + b"%2e%2e%2f" * 1500 + b"metrics HTTP/1.1\r\n\r\n",
                        b"GET /metrics?" + b"a=%00&" * 2000 + b" HTTP/1.1\r\nHost: x\r\n\r\n",
                        b"GET //" + b"x" * 15000 + b"?/../ HTTP/1.1\r\nHost: x\r\n\r\n",
                        b"POST /metrics HTTP/1.1\r\nHost: x\r\n" + form,
                        b"POST /metrics HTTP/1.1\r\nHost: x\r\n" + form.replace(b"x\r\n", b"\0\r\n"),
                        b"GET /etc/passwd HTTP/1.1\r\nHost: x\r\n\r\n"):
            with socket.create_connection(("127.0.0.1", self.metrics_port), PATIENCE_S) as raw:
                raw.sendall(request)
                raw.shutdown(socket.SHUT_WR)
                answer = b""
                try:
                    while part := raw.recv(1 << 16):
                        answer += part
                except ConnectionResetError:
                    pass
            self.assertNotIn(b"root:", answer)
            self.assertIn("contactd_workers", self.scrape())
        self.assertIsNone(self.server.process.poll())

    def test_counters_agree_with_what_was_done(self):
        jobs = [self.server.run(three_ball_chain()) for _ in range(3)]
        running = self.server.create(endless()).name
        self.server.wait_until(running, is_cycle)
        queued = self.server.create(three_ball_chain()).name
        self.server.cancel(queued)
        watch = self.server.watch(running)
        next(watch)
        with self.assertRaises(grpc.RpcError):
            self.server.get("jobs/none")

        self.assertBecomes(1, "contactd_jobs", state="RUNNING")
        self.assertBecomes(0, "contactd_jobs", state="QUEUED")
        self.assertBecomes(1, "contactd_watchers")
        self.assertBecomes(5, "contactd_job_moves_total", state="QUEUED",
                           reason="WAITING_FOR_WORKER")
        self.assertBecomes(4, "contactd_job_moves_total", state="RUNNING", reason="")
        self.assertBecomes(3, "contactd_job_moves_total", state="SUCCEEDED", reason="")
        self.assertBecomes(1, "contactd_job_moves_total", state="CANCELLED", reason="USER_REQUEST")
        self.assertBecomes(5, "contactd_rpc_ended_total", method=SERVICE + "CreateJob", code="OK")
        self.assertBecomes(1, "contactd_rpc_ended_total", method=SERVICE + "GetJob",
                           code="NOT_FOUND")
        self.assertBecomes(1, "contactd_rpc_open", method=SERVICE + "WatchJob")

        values = self.scrape()
        alone = frozenset()
        self.assertEqual(values["contactd_steps_total"][alone],
                         sum(job.summary.steps for job in jobs))
        self.assertEqual(values["contactd_cycle_iterations_sum"][alone],
                         sum(cycle.iterations for job in jobs for cycle in job.cycles))
        self.assertEqual(values["contactd_job_run_seconds_count"][alone], 3)
        self.assertEqual(values["contactd_job_wait_seconds_count"][alone], 4)
        self.assertGreater(values["contactd_store_commit_seconds_count"][alone], 8)
        self.assertGreater(values["contactd_store_bytes"][alone], 0)
        self.assertGreater(values["contactd_connections"][alone], 0)
        self.assertGreater(values["contactd_rpc_streamed_bytes_total"][
            frozenset({("method", SERVICE + "WatchJob")})], 1000)
        watch.cancel()
        self.assertBecomes(0, "contactd_watchers")

    def test_buckets_of_a_histogram_add_up(self):
        self.server.run(three_ball_chain())
        values = self.scrape()
        histograms = [name[:-len("_bucket")] for name in values if name.endswith("_bucket")]
        self.assertIn("contactd_store_commit_seconds", histograms)
        for name in histograms:
            for key, count in values[name + "_count"].items():
                buckets = sorted(
                    (math.inf if dict(labels)["le"] == "+Inf" else float(dict(labels)["le"]), held)
                    for labels, held in values[name + "_bucket"].items()
                    if labels - {("le", dict(labels)["le"])} == key)
                held = [held for _, held in buckets]
                self.assertEqual(held, sorted(held), name)
                self.assertEqual(held[-1], count, name)

    def test_refused_calls_are_counted_by_reason(self):
        for _ in range(8):
            self.server.create(three_ball_chain(), validate_only=True)
        for _ in range(2):
            details = self.assertFails(
                grpc.StatusCode.RESOURCE_EXHAUSTED, "RATE_LIMITED", self.server.stub.CreateJob,
                job_service_pb2.CreateJobRequest())
            self.assertGreater(details["RetryInfo"].retry_delay.seconds, 900)
        self.assertEqual(self.value("contactd_rpc_refused_total", reason="RATE_LIMITED"), 2)


class SlowClientsTest(ServerTest):

    flags = ("--metrics-listen=127.0.0.1:0",)

    def test_requests_that_come_half_do_not_keep_others_waiting(self):
        port = int(re.search(r"metrics on port (\d+)", self.server.log()).group(1))
        for _ in range(100):
            half = socket.create_connection(("127.0.0.1", port), PATIENCE_S)
            self.addCleanup(half.close)
            half.sendall(b"GET /metrics HTTP/1.1\r\nHost:")
        start = time.monotonic()
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/metrics", timeout=30) as page:
            self.assertIn(b"contactd_workers", page.read())
        self.assertLess(time.monotonic() - start, 10)


class PortTest(ServerTest):

    flags = ("--metrics-listen=127.0.0.1:0",)

    def test_taken_port_ends_the_start(self):
        other = f"--metrics-listen=127.0.0.1:{self.server.port}"
        held = type(self.server)(self.folder / "other", other)
        with self.assertRaisesRegex(RuntimeError, "for metrics"):
            held.start()


if __name__ == "__main__":
    unittest.main()
