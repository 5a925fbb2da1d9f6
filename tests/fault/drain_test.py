"""A server that is asked to end hands over: no attempt is burned, no watcher misses anything."""

import threading
import unittest

from contactd import spring_wall
from fault import *

JOBS, WATCHERS = 4, 50


class DrainTest(FaultTest):
    """F23."""

    flags = ("--workers=4",)

    def test_the_next_server_goes_on(self):
        end_time = self.end_time(1)
        scenarios = [spring_wall(end_time + 0.1 * i) for i in range(JOBS)]
        golden = self.golden(*scenarios)
        names = [submit(self.server, self.history, scenario, f"{i}").name
                 for i, scenario in enumerate(scenarios)]
        watching = threading.Semaphore(0)

        def watch(name):
            heard = iter([watching.release])
            follow(self.server, self.history.watch(name), lambda _: next(heard, lambda: None)())

        with clients() as start:
            for i in range(WATCHERS):
                start(watch, names[i % JOBS])
            for _ in range(WATCHERS):
                self.assertTrue(watching.acquire(timeout=PATIENCE_S))
            code, elapsed = self.server.terminate()
            self.assertEqual(code, 0, self.server.log())
            self.server.start()
        final = self.assertPromises(self.server, golden=golden, max_attempts=1)
        starts = sum(entry.kind == "attempt_started" for job in final.values() for entry in job.log)
        self.assertGreater(starts, JOBS, "the end met no running job")
        self.figures |= dict(jobs=JOBS, watchers=WATCHERS, starts=starts)
        self.assertKept("exit", elapsed, 5, slack=1)


if __name__ == "__main__":
    unittest.main()
