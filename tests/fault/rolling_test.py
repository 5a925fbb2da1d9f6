"""A new version comes process by process, and nobody notices but by asking again."""

import signal
import time
import unittest

from contactd import endless_and_slow
from disturbed import DisturbedTest
from fault import *
from shared import Shared

FRONTS, WORKERS, ROUNDS = 2, 3, 2
# An end that burned the only attempt of a job would fail it.
FLAGS = ("--workers=1", "--max-attempts=1", "--checkpoint-interval=200ms")


class RollingTest(DisturbedTest):
    """F23, with several fronts and workers of one database."""

    attempts = 1

    def test_each_process_is_replaced_in_turn_and_no_attempt_is_burned(self):
        self.shared = Shared(self)
        self.fronts = [self.shared.front() for _ in range(FRONTS)]
        self.workers = [self.shared.worker(*FLAGS) for _ in range(WORKERS)]
        final = self.check()
        self.assertNotIn(Job.FAILED, [job.state for job in final.values()])
        starts = sum(entry.kind == "attempt_started" for entry in final[self.lasting].log)
        self.assertGreater(starts, 1, "no worker handed it on")
        self.figures |= dict(lasting_starts=starts)

    def disturb(self):
        """Beside the clients' jobs one lasts from the beginning to the end, and is watched."""
        self.lasting = submit(self.any, self.history, endless_and_slow(), "lasting").name
        with clients() as start:
            start(follow, self.any, self.history.watch(self.lasting))
            exits = [replace(place) for _ in range(ROUNDS)
                     for replace, count in ((self.replace_front, FRONTS),
                                            (self.replace_worker, WORKERS))
                     for place in range(count)]
            self.cancel(self.lasting)
        self.assertKept("exit", max(exits), 5, slack=1)

    def replace_front(self, place):
        """Another one comes first. Clients of the old one meet its end, not a closed channel."""
        old, self.fronts[place] = self.fronts[place], self.shared.front()
        return self.end(old.process)

    def replace_worker(self, place):
        self.await_work()
        old, self.workers[place] = self.workers[place], self.shared.worker(*FLAGS)
        return self.end(old.process)

    def await_work(self):
        """Waits until every worker runs a job."""
        request = job_service_pb2.GetServerInfoRequest()
        wait_for(lambda: patient(lambda: self.any.stub.GetServerInfo(
            request, timeout=PATIENCE_S)).running_jobs >= WORKERS)

    def end(self, process):
        """Asks it to end; seconds that took."""
        start = time.monotonic()
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(PATIENCE_S), 0)
        return time.monotonic() - start


if __name__ == "__main__":
    unittest.main()
