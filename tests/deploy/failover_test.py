"""The failover of deploy/README.md: the first server of two dies, the standby is promoted, and
contactd, whose address names both, goes on with all that it has answered."""

import sys
import time
import unittest
from pathlib import Path

import grpc
from contactd import Job, Server, ServerTest, is_cycle, spring_wall, three_ball_chain

sys.path.insert(0, str(Path(__file__).parent.parent / "testing"))
import postgres

PATIENCE_S = 30
MOST_AWAY_S = 10  # With the promotion, on a busy machine.


class Standby(postgres.Cluster):
    """A copy of another server, which follows it under the name db_2."""

    def __init__(self, first):
        self.first = first
        super().__init__()

    def make_data(self):
        self.call("pg_basebackup", "-D", self.data, "-R", "-C", "-S", "db_2",
                  "--no-sync", "--checkpoint=fast", "-d",
                  f"host={self.first.folder} user=contactd application_name=db_2")


def wait_for(what, happened):
    end = time.monotonic() + PATIENCE_S
    while not happened():
        assert time.monotonic() < end, what
        time.sleep(0.05)


class FailoverTest(ServerTest):

    def make_server(self):
        self.first = postgres.Cluster()
        self.addCleanup(self.first.stop)
        self.first.create("jobs")
        self.second = Standby(self.first)
        self.addCleanup(self.second.stop)
        self.addCleanup(self.second.kill)
        self.first.run("ALTER SYSTEM SET synchronous_standby_names = 'FIRST 1 (db_2)'")
        self.first.run("SELECT pg_reload_conf()")
        wait_for("a synchronous standby", lambda: "sync" == self.first.run(
            "SELECT sync_state FROM pg_stat_replication"))
        hosts = f"{self.first.folder},{self.second.folder}"
        return Server(self.folder / "data", f"--store=postgresql://contactd@/jobs?host={hosts}",
                      "--checkpoint-interval=0s", store="")

    def stores(self):
        """Whether a job is created, which is answered once it is on disk."""
        try:
            return self.server.create(three_ball_chain())
        except grpc.RpcError:
            return None

    def test_nothing_that_was_answered_is_lost_with_the_first_server(self):
        done = [self.server.create(three_ball_chain()).name for _ in range(20)]
        long = self.server.create(spring_wall(end_time_s=2)).name
        self.server.wait_until(long, is_cycle)
        self.first.kill()
        lost = time.monotonic()
        self.second.run("SELECT pg_promote()")
        wait_for("an answer", self.stores)
        away = time.monotonic() - lost
        print(f"creates jobs again {away:.2f} s after the loss")
        self.assertLess(away, MOST_AWAY_S)
        for name in [*done, long]:
            wait_for(name, lambda name=name: self.server.get(name).state == Job.SUCCEEDED)
            self.assertWholeLog(self.server.events(name))


if __name__ == "__main__":
    unittest.main()
