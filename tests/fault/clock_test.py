"""A wall clock that jumps: nothing depends on it but the times that are shown."""

import glob
import os
import time
import unittest

from contactd import spring_wall, three_ball_chain
from fault import *

LIBRARY = next(iter(glob.glob("/usr/lib/*/faketime/libfaketimeMT.so.1")), None)
JUMPS = {"an hour ahead": "+3600", "an hour back": "-3600", "ten years ahead": "+315576000"}


@unittest.skipUnless(LIBRARY, "needs the package faketime")
class ClockTest(FaultTest):
    """F15."""

    flags = ("--workers=3",)

    def make_server(self):
        self.offset = self.folder / "offset"
        self.offset.write_text("+0")
        environment = os.environ | {
            "LD_PRELOAD": LIBRARY, "FAKETIME_TIMESTAMP_FILE": str(self.offset),
            "FAKETIME_NO_CACHE": "1", "FAKETIME_DONT_FAKE_MONOTONIC": "1"}
        return Server(self.folder / "data", *self.flags, environment=environment)

    def jump(self, offset):
        """Written beside it and renamed: the server reads it all the time."""
        draft = self.folder / "offset.new"
        draft.write_text(offset)
        draft.rename(self.offset)

    def test_jumps_change_nothing_but_times(self):
        chain, long = three_ball_chain(), spring_wall(2.0)
        golden = self.golden(chain, long)
        names = [submit(self.server, self.history, long, f"long-{i}").name for i in range(2)]
        shown = []
        with clients() as start:
            for name in names:
                start(follow, self.server, self.history.watch(name))
            for when, offset in JUMPS.items():
                self.jump(offset)
                for i in range(3):
                    name = submit(self.server, self.history, chain, f"{offset[1:]}-{when[-1]}-{i}")
                    follow(self.server, self.history.watch(name.name))
                shown.append(self.server.get(name.name).create_time.seconds - time.time())
        for offset, expected in zip(shown, JUMPS.values()):
            self.assertAlmostEqual(offset, int(expected), delta=60, msg="the clock did not jump")
        final = self.assertPromises(self.server, golden=golden, max_attempts=1)
        self.figures |= dict(jumps=len(JUMPS), jobs=len(final))


class RetentionTest(ClockTest):
    """F15, where ended jobs are kept for a month."""

    flags = ("--workers=3", "--retain-for=30d")

    def test_a_server_that_starts_a_year_later_deletes_nothing(self):
        names = [submit(self.server, self.history, three_ball_chain(), f"{i}").name
                 for i in range(20)]
        for name in names:
            follow(self.server, self.history.watch(name))
        self.server.terminate()
        self.jump("+31536000")
        self.server.start()
        wait_for(lambda: "h ahead of the time that has passed" in self.server.log())
        time.sleep(1)  # The pass that has said so is over.
        left = [job for job in all_jobs(self.server) if job.name in names]
        self.assertGreater(left[0].expire_time.seconds, 0)
        self.assertLess(left[0].expire_time.seconds, time.time() + 31536000)
        self.assertEqual(len(left), 20)


if __name__ == "__main__":
    unittest.main()
