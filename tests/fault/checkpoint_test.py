"""kill -9 of a long run: it goes on from its last checkpoint, and nobody can tell."""

import re
import time
import unittest

import kill_test
from contactd import Job, spring_wall
from fault import *

KILLS = 3


class CheckpointTest(kill_test.ResumeTest):
    """F2, of a run that is too long to begin anew."""

    flags = ("--workers=2", "--max-attempts=100", "--checkpoint-interval=100ms")

    def test_a_killed_run_gives_the_same_bytes(self):
        spec = Job(scenario=spring_wall(self.end_time(3)))
        undisturbed = self.outcome(self.create(spec))
        name = self.create(spec)
        kills = 0
        for _ in range(KILLS):
            # Far enough for a checkpoint that lies behind the one before.
            reached = self.server.get(name).progress.time_s
            wait_for(lambda: self.ended_or_past(name, reached + 0.1 * spec.scenario.end_time_s))
            time.sleep(self.random.uniform(0.2, 0.4))
            if self.server.get(name).state in ENDED:
                break
            self.server.kill()
            kills += 1
            self.server.start()
        self.assertEqual(self.outcome(name), undisturbed, f"seed {self.seed}")
        resumed = [float(time) for time in re.findall(
            rf"job={name} goes on from t=(\S+) s", self.server.log())]
        self.assertGreater(kills, 0)
        self.assertEqual(len(resumed), kills, "it began anew")
        self.assertEqual(resumed, sorted(resumed))
        self.figures |= dict(kills=kills, resumed=[f"{time:.3g}s" for time in resumed],
                             of=f"{spec.scenario.end_time_s:.3g}s")

    def ended_or_past(self, name, time_s):
        job = self.server.get(name)
        return job.state in ENDED or job.progress.time_s > time_s


if __name__ == "__main__":
    unittest.main()
