"""What a job may take of the server's memory: the largest scenario, the longest ledger."""

import time
import unittest

from contact.v1 import scenario_pb2
from contactd import Job, ServerTest, endless

SLACK = 5  # A machine so many times slower must pass too.


def balls_at_rest(count):
    """A row of balls that never meet, each one a centimetre from the next."""
    names = [f"B{i}" for i in range(count)]
    return scenario_pb2.Scenario(
        bodies=[scenario_pb2.Body(name=name, mass_kg=0.1, radius_m=0.05, position_m=0.11 * i)
                for i, name in enumerate(names)],
        contacts=[scenario_pb2.Contact(between=names, stiffness=1e8, restitution=0.8)],
        end_time_s=1e-4)


class MemoryTest(ServerTest):

    flags = ("--workers=1", "--max-memory=64MiB")

    def peak(self):
        """The most memory that the process ever had, in bytes."""
        with open(f"/proc/{self.server.process.pid}/status") as status:
            line = next(line for line in status if line.startswith("VmHWM"))
        return int(line.split()[1]) * 1024


class LargeScenarioTest(MemoryTest):

    flags = ("--workers=1",)

    def test_largest_scenario_takes_300_megabytes_and_stops_within_a_second(self):
        name = self.server.create(balls_at_rest(19_999)).name
        while self.server.get(name).last_sequence < 10:
            time.sleep(0.1)
        time.sleep(5)  # Long enough for what is not written fast enough to pile up.
        self.assertEqual(self.server.get(name).state, Job.RUNNING)
        start = time.monotonic()
        self.server.cancel(name)
        self.server.events(name, kinds=["state_changed"])
        took = time.monotonic() - start
        print(f"{self.peak() / 1e6:.0f} MB at most, cancelled after {took:.2f} s")
        self.assertEqual(self.server.get(name).state, Job.CANCELLED)
        self.assertLess(self.peak(), 300e6)
        self.assertLess(took, 1 * SLACK)


class LongLedgerTest(MemoryTest):

    def test_ledger_without_end_ends_with_a_reason(self):
        name = self.server.create(endless()).name
        self.server.events(name, kinds=["state_changed"])
        job = self.server.get(name)
        print(f"{self.peak() / 1e6:.0f} MB at most with {len(job.cycles)} cycles")
        self.assertEqual(job.state_reason, "BUDGET_MEMORY")
        self.assertGreater(len(job.cycles), 5000)
        self.assertLess(self.peak(), 128 << 20)


if __name__ == "__main__":
    unittest.main()
