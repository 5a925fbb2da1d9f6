"""What TLS, identity and the audit log cost: one server with client certificates, tokens and an
audit log beside one without, in turns on the same machine. Prints one table.

  CONTACTD=build/release/server/contactd PYTHONPATH=build/release/python:tests/system \\
    /usr/bin/python3 tests/benchmark/identity_benchmark.py

--tiny only shows that it runs.
"""

import hashlib
import pathlib
import statistics
import sys
import tempfile
import time

import grpc
from authority import Authority
from contact.v1 import job_pb2, job_service_pb2, job_service_pb2_grpc
from contactd import PATIENCE_S, Server, three_ball_chain

TINY = "--tiny" in sys.argv[1:]
ROUNDS = 2 if TINY else 10
SUBMITS = 10 if TINY else 100  # In a round.
SAMPLES = 10_000 if TINY else 500_000  # 120 bytes each, before they are compressed.
OPTIONS = [("grpc.max_receive_message_length", 64 << 20), ("grpc.use_local_subchannel_pool", 1)]
# What submits fill must not end the benchmark.
FLAGS = ("--max-creates-per-second=1e6", "--max-creates-per-second-per-owner=1e6",
         "--max-unfinished-per-owner=100000")


class Side:
    """One server, and what its client has measured."""

    def __init__(self, server, channel, metadata=()):
        self.server, self.channel, self.metadata = server, channel, metadata
        self.stub = job_service_pb2_grpc.JobServiceStub(channel)
        self.watch = channel.unary_stream(  # Bytes: what Python takes to parse them is no matter.
            "/contact.v1.JobService/WatchJob",
            request_serializer=job_service_pb2.WatchJobRequest.SerializeToString)
        self.submit_ms, self.rates = [], []

    def submit(self, scenario):
        return self.stub.CreateJob(
            job_service_pb2.CreateJobRequest(job=job_pb2.Job(scenario=scenario)),
            timeout=PATIENCE_S, metadata=self.metadata)

    def stream(self, name):
        """The bytes of a watch to its end."""
        request = job_service_pb2.WatchJobRequest(name=name)
        return sum(map(len, self.watch(request, timeout=PATIENCE_S, metadata=self.metadata)))

    def await_idle(self):
        info = job_service_pb2.GetServerInfoRequest()
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            now = self.stub.GetServerInfo(info, timeout=PATIENCE_S, metadata=self.metadata)
            if now.queued_jobs + now.running_jobs == 0:
                return
            time.sleep(0.01)
        raise RuntimeError("the jobs do not end")

    def prepare(self):
        scenario = three_ball_chain()
        scenario.bodies[0].velocity_m_per_s = -0.2  # They never meet.
        scenario.output.sample_interval_s = scenario.end_time_s / SAMPLES
        self.recording = self.submit(scenario).name
        self.stream(self.recording)

    def measure(self):
        for _ in range(SUBMITS):
            start = time.perf_counter()
            self.submit(three_ball_chain())
            self.submit_ms.append(1e3 * (time.perf_counter() - start))
        self.await_idle()
        start = time.perf_counter()
        size = self.stream(self.recording)
        self.rates.append(size / 1e6 / (time.perf_counter() - start))

    def row(self, title):
        cuts = statistics.quantiles(self.submit_ms, n=100)
        rates = sorted(self.rates)
        print(f"{title:34} {cuts[49]:8.2f} / {cuts[98]:.2f} ms   {statistics.median(rates):8.0f} MB/s"
              f" ({rates[0]:.0f} to {rates[-1]:.0f})")
        return cuts[49], cuts[98], statistics.median(rates)


def open_server(folder):
    server = Server(folder / "open" / "data", *FLAGS).start()
    return Side(server, grpc.insecure_channel(f"127.0.0.1:{server.port}", OPTIONS))


def guarded_server(folder):
    ca = Authority(folder)
    pem, key = ca.issue("server", "DNS:localhost,IP:127.0.0.1")
    client, client_key = ca.issue("ada", "URI:spiffe://acme/user/ada")
    secret = hashlib.sha256(b"benchmark").hexdigest()[:43]
    digest = hashlib.sha256(f"ctk_{secret[:8]}_{secret}".encode()).hexdigest()
    tokens = folder / "tokens"
    tokens.touch(mode=0o600)
    tokens.write_text(f"{secret[:8]} {digest} 2100-01-01T00:00:00Z valid "
                      "user:boss tenant:acme roles:admin\n")
    rules = folder / "rules"
    rules.write_text("cert spiffe://acme/user/*  user:$1 tenant:acme roles:submit\n")
    server = Server(folder / "guarded" / "data", *FLAGS, f"--tls-cert={pem}", f"--tls-key={key}",
                    f"--tls-client-ca={ca.pem}", f"--identity-rules={rules}",
                    f"--tokens={tokens}", f"--audit-log={folder / 'audit.log'}").start()
    read = pathlib.Path.read_bytes
    credentials = grpc.ssl_channel_credentials(read(ca.pem), read(client_key), read(client))
    channel = grpc.secure_channel(f"localhost:{server.port}", credentials, OPTIONS)
    return Side(server, channel, [("authorization", f"Bearer ctk_{secret[:8]}_{secret}")])


def main():
    with tempfile.TemporaryDirectory(prefix="contactd-benchmark-") as name:
        folder = pathlib.Path(name)
        sides = []
        try:
            for make in (open_server, guarded_server):
                (folder / make.__name__.split("_")[0]).mkdir()
                sides.append(make(folder))
            for side in sides:
                side.prepare()
            for _ in range(ROUNDS):
                for side in sides:
                    side.measure()
            print(f"{'':34} {'submit p50 / p99':>18}   {'stream':>13}")
            plain = sides[0].row("neither TLS, identity nor audit")
            guarded = sides[1].row("mTLS, token and audit log")
            print("ratio: " + ", ".join(f"{b / a:.2f}" for a, b in zip(plain, guarded)))
        finally:
            for side in sides:
                side.server.kill()


if __name__ == "__main__":
    main()
