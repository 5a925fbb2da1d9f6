"""What one owner may have: it reaches each of its limits, and others do not notice."""

import contextlib
import hashlib
import json
import re
import threading
import time
import unittest
import urllib.request

import grpc
from authority import Authority
from contact.v1 import job_pb2, job_service_pb2, job_service_pb2_grpc, scenario_pb2
from contactd import PATIENCE_S, Server, ServerTest, details_of, endless_and_slow, three_ball_chain

Code, Q = grpc.StatusCode, job_service_pb2.Quota
PRINCIPALS = {"ada": "user:ada tenant:acme roles:submit", "bob": "user:bob tenant:acme roles:submit",
              "root": "user:root tenant:acme roles:admin"}


def token_of(name):
    secret = hashlib.sha256(name.encode()).hexdigest()[:43]
    return f"ctk_{secret[:8]}_{secret}"


class Caller:
    """The calls of one principal, over a connection of its own."""

    def __init__(self, test, name):
        self.metadata = [("authorization", f"Bearer {token_of(name)}")]
        channel = grpc.secure_channel(
            f"localhost:{test.server.port}", grpc.ssl_channel_credentials(test.ca.read_bytes()),
            options=[("grpc.use_local_subchannel_pool", 1)])  # Others do not lend their connection.
        self.stub = job_service_pb2_grpc.JobServiceStub(channel)
        test.addCleanup(channel.close)

    def call(self, method, request):
        return getattr(self.stub, method)(request, timeout=PATIENCE_S, metadata=self.metadata)

    def create(self, scenario=None, **request):
        job = job_pb2.Job(scenario=scenario or endless_and_slow())
        return self.call("CreateJob", job_service_pb2.CreateJobRequest(job=job, **request))

    def sweep(self, cells):
        velocity = scenario_pb2.Sweep.Axis(field="bodies[0].velocity_m_per_s")
        velocity.linear.low, velocity.linear.high, velocity.linear.count = 0.1, 0.5, cells
        sweep = scenario_pb2.Sweep(base=endless_and_slow(), axes=[velocity])
        return self.call("CreateJob",
                         job_service_pb2.CreateJobRequest(job=job_pb2.Job(sweep=sweep)))

    def end(self, name):
        self.call("CancelJob", job_service_pb2.CancelJobRequest(name=name))
        list(self.call("WatchJob", job_service_pb2.WatchJobRequest(name=name)))

    def delete(self, name):
        self.call("DeleteJob", job_service_pb2.DeleteJobRequest(name=name))

    def watch(self):
        """An open stream, past its first message."""
        stream = self.stub.WatchJobs(job_service_pb2.WatchJobsRequest(), metadata=self.metadata)
        next(stream)
        return stream

    def quota(self, resource):
        info = self.call("GetServerInfo", job_service_pb2.GetServerInfoRequest())
        return next(quota for quota in info.quotas if quota.resource == resource)


class LimitsTest(ServerTest):

    limits = ()

    def make_server(self):
        authority = Authority(self.folder)
        self.ca, pair = authority.pem, authority.issue("server", "DNS:localhost,IP:127.0.0.1")
        tokens = self.folder / "tokens"
        tokens.touch(mode=0o600)
        tokens.write_text("".join(
            f"{token_of(name)[4:12]} {hashlib.sha256(token_of(name).encode()).hexdigest()} "
            f"2100-01-01T00:00:00Z valid {principal}\n" for name, principal in PRINCIPALS.items()))
        return Server(self.folder / "data", f"--tls-cert={pair[0]}", f"--tls-key={pair[1]}",
                      f"--tokens={tokens}", f"--audit-log={self.folder}/audit.log", "--workers=1",
                      "--metrics-listen=127.0.0.1:0", *self.limits)

    def setUp(self):
        super().setUp()
        self.ada, self.bob, self.root = (Caller(self, name) for name in PRINCIPALS)

    def assertRefused(self, resource, call, *arguments, waits=True):
        """The call is refused for this resource, in words, with numbers, and told."""
        before = self.refused(resource)
        with self.assertRaises(grpc.RpcError) as caught:
            answer = call(*arguments)
            if hasattr(answer, "cancel"):
                next(answer)
        error = caught.exception
        self.assertEqual(error.code(), Code.RESOURCE_EXHAUSTED, error)
        details = details_of(error)
        self.assertEqual(details["ErrorInfo"].reason, "QUOTA_EXCEEDED")
        facts = details["ErrorInfo"].metadata
        self.assertEqual(facts["resource"], Q.Resource.Name(resource))
        self.assertIn(facts["limit"], error.details())
        self.assertIn(facts["used"], error.details())
        self.assertEqual(details["QuotaFailure"].violations[0].subject, "principal:ada")
        self.assertEqual("RetryInfo" in details, waits)
        self.assertEqual(self.refused(resource), before + 1)
        return facts

    def refused(self, resource):
        port = re.findall(r"metrics on port (\d+)", self.server.log())[-1]
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/metrics", timeout=PATIENCE_S) as page:
            name = f'contactd_quota_refused_total{{resource="{Q.Resource.Name(resource)}"}}'
            lines = [line for line in page.read().decode().splitlines() if line.startswith(name)]
        return int(float(lines[0].split()[-1])) if lines else 0

    def audited(self):
        lines = [json.loads(line) for line in
                 (self.folder / "audit.log").read_text().splitlines()]
        return [(line["principal"], line["method"].rsplit("/")[-1]) for line in lines
                if line.get("reason") == "QUOTA_EXCEEDED"]


class JobsTest(LimitsTest):

    limits = ("--max-unfinished-per-owner=3", "--max-cells-per-owner=20")

    def test_unfinished_jobs_also_after_a_restart(self):
        names = [self.ada.create(request_id=str(i)).name for i in range(3)]
        self.assertRefused(Q.UNFINISHED_JOBS, self.ada.create)
        self.assertEqual(self.ada.create(request_id="2").name, names[2], "it was accepted before")
        self.assertEqual(self.bob.create().state, job_pb2.Job.QUEUED)
        self.server.kill()
        self.server.start()
        self.ada, self.bob = Caller(self, "ada"), Caller(self, "bob")
        self.assertEqual(self.ada.quota(Q.UNFINISHED_JOBS).used, 3)
        self.assertEqual(self.bob.quota(Q.UNFINISHED_JOBS).used, 1)
        self.assertRefused(Q.UNFINISHED_JOBS, self.ada.create)
        self.ada.end(names[0])
        self.ada.create()
        self.assertIn(("ada", "CreateJob"), self.audited())

    def test_cells(self):
        self.ada.sweep(12)
        facts = self.assertRefused(Q.CELLS, self.ada.sweep, 9)
        self.assertEqual((facts["used"], facts["limit"]), ("12", "20"))
        self.assertRefused(Q.CELLS, self.ada.sweep, 21, waits=False)
        self.ada.sweep(8)
        self.bob.sweep(20)

    def test_concurrent_calls_get_no_more(self):
        accepted = []

        def create():
            for _ in range(5):
                with contextlib.suppress(grpc.RpcError):
                    accepted.append(self.ada.create().name)

        threads = [threading.Thread(target=create) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(accepted), 3)


class StoreTest(LimitsTest):

    limits = ("--max-stored-bytes-per-owner=20kB",)

    def test_stored_bytes_until_jobs_are_deleted(self):
        names = []
        for _ in range(20):
            if self.ada.quota(Q.STORED_BYTES).used >= 20_000:
                break
            names.append(self.ada.create(three_ball_chain()).name)
            list(self.ada.call("WatchJob", job_service_pb2.WatchJobRequest(name=names[-1])))
        self.assertRefused(Q.STORED_BYTES, self.ada.create, waits=False)
        self.bob.create(three_ball_chain())
        for name in names:
            self.ada.delete(name)
        self.assertLess(self.ada.quota(Q.STORED_BYTES).used, 20_000)
        self.ada.create(three_ball_chain())


class CallsTest(LimitsTest):

    limits = ("--max-creates-per-second-per-owner=0.001", "--max-create-burst-per-owner=2",
              "--max-watchers-per-owner=2", "--max-connections-per-owner=2")

    def test_create_calls(self):
        for _ in range(2):
            self.ada.create(three_ball_chain())
        self.assertRefused(Q.CREATE_CALLS, self.ada.create)
        self.bob.create(three_ball_chain())
        quota = self.ada.quota(Q.CREATE_CALLS)
        self.assertEqual((quota.limit, quota.used, quota.per_second), (2, 2, 0.001))

    def test_streams(self):
        streams = [self.ada.watch() for _ in range(2)]
        self.assertRefused(Q.STREAMS, self.ada.watch)
        self.assertEqual(self.ada.quota(Q.STREAMS).used, 2)
        self.bob.watch()
        streams[0].cancel()
        end = time.monotonic() + PATIENCE_S
        while self.ada.quota(Q.STREAMS).used > 1:
            self.assertLess(time.monotonic(), end)
        self.ada.watch()
        self.assertIn(("ada", "WatchJobs"), self.audited())

    def test_connections_with_open_calls(self):
        second, third = Caller(self, "ada"), Caller(self, "ada")
        streams = [self.ada.watch(), second.watch()]
        self.assertEqual(self.ada.quota(Q.CONNECTIONS).used, 2)
        self.assertRefused(Q.CONNECTIONS, third.quota, Q.CONNECTIONS)
        self.bob.watch()
        streams[1].cancel()
        end = time.monotonic() + PATIENCE_S
        while self.ada.quota(Q.CONNECTIONS).used > 1:
            self.assertLess(time.monotonic(), end)
        third.quota(Q.CONNECTIONS)


class AdminTest(LimitsTest):

    limits = ("--max-queued-jobs=4", "--max-watchers=4", "--admin-slots=1",
              "--max-watchers-per-peer=4")

    def test_admin_is_answered_and_may_create_when_others_have_taken_all(self):
        for caller in self.ada, self.bob:
            with contextlib.suppress(grpc.RpcError):
                for _ in range(10):
                    caller.create()
        streams = []
        with contextlib.suppress(grpc.RpcError):
            for _ in range(10):
                streams.append(self.ada.watch())
        self.assertEqual(len(streams), 3)
        for call, reason in (self.bob.create, "QUEUE_FULL"), (self.bob.watch, "WATCHER_LIMIT"):
            with self.assertRaises(grpc.RpcError) as caught:
                call()
            self.assertEqual(details_of(caught.exception)["ErrorInfo"].reason, reason)
        self.assertEqual(self.root.create().state, job_pb2.Job.QUEUED)
        self.assertTrue(self.root.watch())
        self.assertEqual(self.root.quota(Q.UNFINISHED_JOBS).used, 1)


class DefaultsTest(LimitsTest):

    def test_server_tells_each_principal_its_own(self):
        self.ada.create(three_ball_chain())
        info = self.bob.call("GetServerInfo", job_service_pb2.GetServerInfoRequest())
        limits = {quota.resource: (quota.limit, quota.used) for quota in info.quotas}
        self.assertEqual(set(limits), set(Q.Resource.values()) - {Q.RESOURCE_UNSPECIFIED})
        self.assertEqual(limits[Q.UNFINISHED_JOBS], (1000, 0))
        self.assertEqual(limits[Q.CELLS], (200_000, 0))
        self.assertEqual(limits[Q.STORED_BYTES], (info.limits.max_stored_bytes // 2, 0))
        self.assertEqual(limits[Q.CREATE_CALLS], (1000, 0))
        self.assertEqual(limits[Q.CALLS], (500, 1), "this one")
        self.assertGreater(self.ada.quota(Q.STORED_BYTES).used, 0)
        self.assertEqual(info.limits.max_disk_percent, 80)
        self.assertEqual(info.limits.admin_slots, 10)
        budget = info.limits.max_budget
        self.assertEqual((budget.wall_time.seconds, budget.steps, budget.output_bytes),
                         (3600, 10**9, 4 * 10**9))


if __name__ == "__main__":
    unittest.main()
