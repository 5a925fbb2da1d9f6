"""Principals that share a server: each gets its part of the workers, whatever the others send.

FAIR_SECONDS says for how long the shares are measured.
"""

import os
import threading
import time
import unittest

import grpc
from contact.v1 import job_service_pb2, job_service_pb2_grpc, scenario_pb2
from contactd import PATIENCE_S, Job, ServerTest, endless_and_slow

SECONDS = float(os.environ.get("FAIR_SECONDS", "12"))
# A turn of half a second is a larger part of a short time.
MOST_OFF = 0.05 if SECONDS >= 60 else 0.15
FLOOD = 10_000
SLACK = 5  # A machine so many times slower must pass too.


class FairnessTest(ServerTest):
    """Three users of two tenants, each with a socket of its own."""

    users = {"ada": "acme", "bob": "acme", "eve": "umbra"}

    @property
    def flags(self):
        return ("--workers=2", f"--max-queued-jobs={2 * FLOOD}", f"--max-create-burst={2 * FLOOD}",
                "--max-creates-per-second=0", f"--max-unfinished-per-owner={2 * FLOOD}",
                "--max-creates-per-second-per-owner=0",
                *(f"--listen-as=unix:{self.folder / user} user:{user} tenant:{tenant} roles:submit"
                  for user, tenant in self.users.items()))

    def setUp(self):
        super().setUp()
        self.stubs = {user: self.stub_of(user) for user in self.users}

    def stub_of(self, user):
        options = [("grpc.use_local_subchannel_pool", 1)]
        channel = grpc.insecure_channel(f"unix:{self.folder / user}", options)
        self.addCleanup(channel.close)
        return job_service_pb2_grpc.JobServiceStub(channel)

    def request(self, **job):
        return job_service_pb2.CreateJobRequest(job=Job(**job))

    def create(self, user, **job):
        request = self.request(**job or {"scenario": endless_and_slow()})
        return self.stubs[user].CreateJob(request, timeout=PATIENCE_S).name

    def get(self, user, name):
        return self.stubs[user].GetJob(job_service_pb2.GetJobRequest(name=name),
                                       timeout=PATIENCE_S)

    def flood(self, user, request, number):
        """Creates so many jobs, with as many calls at once as the server takes well."""
        places = threading.Semaphore(200)
        failed = []

        def done(call):
            places.release()
            if call.code() != grpc.StatusCode.OK:
                failed.append(call.code())

        calls = []
        for _ in range(number):
            places.acquire()
            calls.append(self.stubs[user].CreateJob.future(request, timeout=PATIENCE_S))
            calls[-1].add_done_callback(done)
        for call in calls:
            call.exception()
        self.assertEqual(failed, [])

    def assertStartsSoon(self, user):
        start = time.monotonic()
        name = self.create(user)
        while self.get(user, name).state != Job.RUNNING:
            time.sleep(0.02)
        waited = time.monotonic() - start
        print(f"{user}'s job runs after {waited:.2f} s")
        self.assertLess(waited, 5)


class FloodTest(FairnessTest):

    def test_ten_thousand_endless_jobs_keep_nobody_waiting(self):
        start = time.monotonic()
        self.flood("eve", self.request(scenario=endless_and_slow(), priority=100), FLOOD)
        print(f"{FLOOD} jobs after {time.monotonic() - start:.1f} s")
        self.assertStartsSoon("ada")
        self.assertStartsSoon("bob")

    def test_endless_sweeps_keep_nobody_waiting(self):
        sweep = scenario_pb2.Sweep(
            base=endless_and_slow(),
            axes=[scenario_pb2.Sweep.Axis(
                field="contacts[*].restitution",
                linear=scenario_pb2.Sweep.Range(low=0.5, high=0.9, count=1000))],
            metrics=["iterations"])
        for _ in range(20):
            self.create("eve", sweep=sweep)
        time.sleep(1)  # Helpers have come by now.
        self.assertStartsSoon("ada")
        self.assertStartsSoon("bob")


class ShareTest(FairnessTest):

    users = {"ada": "acme", "bob": "brand", "eve": "umbra"}

    def test_three_who_compute_get_a_third_each(self):
        jobs = {"ada": 1, "bob": 2, "eve": 20}
        names = {user: [self.create(user) for _ in range(number)]
                 for user, number in jobs.items()}
        time.sleep(2)  # All have come, and had a turn.
        before = self.steps(names)
        time.sleep(SECONDS)
        after = self.steps(names)
        made = {user: after[user] - before[user] for user in names}
        shares = {user: made[user] / sum(made.values()) for user in names}
        print(f"in {SECONDS:.0f} s " + ", ".join(f"{user} {100 * share:.1f} %"
                                                 for user, share in shares.items()))
        for share in shares.values():
            self.assertAlmostEqual(3 * share, 1, delta=MOST_OFF)

    def steps(self, names):
        """Integration steps of each user's jobs, which cost the same for all."""
        return {user: sum(self.get(user, name).progress.steps for name in jobs)
                for user, jobs in names.items()}


if __name__ == "__main__":
    unittest.main()
