"""What a job may take of the server's memory: the largest scenario, the longest ledger."""

import os
import time
import unittest

import flooding
import http2
from contact.v1 import job_service_pb2, scenario_pb2
from contactd import PATIENCE_S, Job, ServerTest, endless, spring_wall

FLOOD_S = float(os.environ.get("FLOOD_SECONDS", "5"))
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


    def test_client_of_grpc_as_it_comes_reads_all_columns_of_the_largest_scenario(self):
        """Its messages have 4 MiB at most, so an event has about one."""
        scenario = balls_at_rest(19_999)
        scenario.output.sample_interval_s = scenario.end_time_s  # Two samples.
        name = self.server.run(scenario).name
        chunks = [event.frame_chunk for event in self.server.events(name, kinds=["frame_chunk"])
                  if event.HasField("frame_chunk")]
        largest = max(chunk.ByteSize() for chunk in chunks)
        print(f"{len(chunks)} chunks of {largest / 2**20:.2f} MiB at most")
        self.assertLessEqual(largest, 1 << 20)
        for sample in (0, 1):
            parts = [chunk for chunk in chunks if chunk.first_sample == sample]
            self.assertEqual([part.columns_follow for part in parts],
                             [True] * (len(parts) - 1) + [False])
            columns = parts[0].columns[:1] + [c for part in parts for c in part.columns[1:]]
            self.assertEqual(len({column.name for column in columns}), 1 + 3 * 19_999 + 4 * 19_998 + 5)
            self.assertEqual({len(column.values) for column in columns}, {8})
        series = self.server.stub.GetSeries(job_service_pb2.GetSeriesRequest(
            name=name, channels=["B0.position", "B19998.velocity"]), timeout=PATIENCE_S)
        self.assertEqual([len(column.values) for column in series.columns], [16] * 3)


class LongLedgerTest(MemoryTest):

    def test_ledger_without_end_ends_with_a_reason(self):
        name = self.server.create(endless()).name
        self.server.events(name, kinds=["state_changed"])
        job = self.server.get(name)
        print(f"{self.peak() / 1e6:.0f} MB at most with {len(job.cycles)} cycles")
        self.assertEqual(job.state_reason, "BUDGET_MEMORY")
        self.assertGreater(len(job.cycles), 5000)
        self.assertLess(self.peak(), 128 << 20)


class EverythingAtOnceTest(MemoryTest):
    """The bounds that server/jobs/quota/README.md gives one by one hold together."""

    flags = ("--workers=2", "--max-memory=256MiB", "--max-watchers=3000",
             "--max-watchers-per-peer=3000")
    # Runs, a flood, messages to watchers, requests that are not answered yet.
    most = (2 * 256 + 256 + 24 + 256) << 20

    def stall(self, name, watchers):
        """Watchers that open their windows wide, and never read."""
        request = job_service_pb2.WatchJobRequest(name=name).SerializeToString()
        for _ in range(watchers // 100):
            client = http2.greet(self.server.port, window=http2.LARGEST_WINDOW)
            self.addCleanup(client.close)
            client.sendall(b"".join(
                http2.headers(stream, flooding.WATCH) + http2.message(stream, request)
                for stream in range(1, 201, 2)))

    def test_memory_stays_below_the_sum_of_its_bounds(self):
        recorded = spring_wall(0.4)  # 11 MB of events.
        recorded.output.sample_interval_s = 2e-6
        self.stall(self.server.run(recorded).name, 2000)
        runs = [self.server.create(scenario).name
                for scenario in (balls_at_rest(19_999), endless()) * 3]
        floods = [flooding.start(self.server.port, 1, FLOOD_S, kind)
                  for kind in ("unread calls", "CONTINUATION")]
        while any(flood.poll() is None for flood in floods):
            self.server.create(balls_at_rest(5000))
        for flood in floods:
            flood.stdout.close()
        states = [Job.State.Name(self.server.get(name).state) for name in runs]
        print(f"{self.peak() / 2**20:.0f} of {self.most / 2**20:.0f} MiB at most; {states}")
        self.assertIn("RUNNING", states)
        self.assertLess(self.peak(), self.most)


if __name__ == "__main__":
    unittest.main()
