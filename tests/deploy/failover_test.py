"""The failover of deploy/README.md: the first server of two dies, the standby is promoted, and a
front and a worker, whose address names both, go on with all that was answered."""

import pathlib
import sys
import threading
import time
import unittest

from contactd import is_cycle, spring_wall, three_ball_chain
from shared import Worker

for folder in "testing", "fault":
    sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / folder))
import postgres
from fault import *

CLIENTS = 4


class Standby(postgres.Cluster):
    """A copy of another server, which follows it under the name db_2."""

    def __init__(self, first):
        self.first = first
        super().__init__()

    def make_data(self):
        self.call("pg_basebackup", "-D", self.data, "-R", "-C", "-S", "db_2",
                  "--no-sync", "--checkpoint=fast", "-d",
                  f"host={self.first.folder} user=contactd application_name=db_2")


class FailoverTest(FaultTest):
    """`self.server` is the front."""

    def make_server(self):
        self.first = postgres.Cluster()
        self.addCleanup(self.first.stop)
        self.first.create("jobs")
        self.second = Standby(self.first)
        self.addCleanup(self.second.stop)
        self.first.run("ALTER SYSTEM SET synchronous_standby_names = 'FIRST 1 (db_2)'")
        self.first.run("SELECT pg_reload_conf()")
        wait_for(lambda: self.first.run("SELECT sync_state FROM pg_stat_replication") == "sync")
        self.store = (f"postgresql://contactd@/jobs?host={self.first.folder},{self.second.folder}"
                      "&target_session_attrs=read-write")
        return Server(self.folder / "data", "--role=front", f"--store={self.store}", store="")

    def setUp(self):
        super().setUp()
        worker = Worker(self.folder / "worker.log", self.store, "--workers=2",
                        "--checkpoint-interval=200ms")
        self.addCleanup(worker.kill)
        worker.start()

    def test_nothing_that_was_answered_is_lost_with_the_first_server(self):
        chain, long = three_ball_chain(), spring_wall(self.end_time(2))
        golden = self.golden(chain, long)
        done = threading.Event()

        def keep_submitting(client):
            for i in range(1000):
                if done.is_set():
                    return
                patient(lambda: submit(self.server, self.history, chain, f"{client}-{i}"))

        name = submit(self.server, self.history, long, "long").name
        with clients() as start:
            start(follow, self.server, self.history.watch(name))
            for client in range(CLIENTS):
                start(keep_submitting, client)
            self.server.wait_until(name, is_cycle)
            self.first.kill()
            lost = time.monotonic()
            self.second.run("SELECT pg_promote()")
            patient(lambda: submit(self.server, self.history, chain, "after"))
            self.assertKept("creates_jobs_again", time.monotonic() - lost, 2)
            done.set()
        final = self.assertPromises(self.server, golden=golden)
        self.assertEqual({job.state for job in final.values()}, {Job.SUCCEEDED})
        self.figures |= dict(jobs=len(final), attempts=final[name].attempt)


if __name__ == "__main__":
    unittest.main()
