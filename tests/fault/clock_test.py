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

    def make_server(self):
        self.offset = self.folder / "offset"
        self.offset.write_text("+0")
        environment = os.environ | {
            "LD_PRELOAD": LIBRARY, "FAKETIME_TIMESTAMP_FILE": str(self.offset),
            "FAKETIME_NO_CACHE": "1", "FAKETIME_DONT_FAKE_MONOTONIC": "1"}
        return Server(self.folder / "data", "--workers=3", environment=environment)

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


if __name__ == "__main__":
    unittest.main()
