"""Thousands of watchers: what they leave behind, what a slow one costs, what idle ones cost."""

import json
import os
import subprocess
import time
import unittest

from contactd import endless_and_slow, spring_wall, stored
from fault import *

CROWD = os.environ["WATCH_CROWD"]


class CrowdTest(FaultTest):

    def crowd(self, name, watchers, connections, *kinds):
        """A process that watches; it is attached."""
        process = subprocess.Popen(
            [CROWD, f"127.0.0.1:{self.server.port}", name, str(watchers), str(connections), *kinds],
            stdout=subprocess.PIPE, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait, PATIENCE_S)
        self.addCleanup(process.kill)
        process.attached_s = float(process.stdout.readline().split()[1])
        return process

    def figures_of(self, crowd):
        return json.loads(crowd.stdout.readline())


class StormTest(CrowdTest):
    """F11."""

    flags = ("--workers=1", "--max-watchers=2500", "--max-watchers-per-peer=2500")
    # A round finds no place if the last one is kept.

    def test_killed_watchers_leave_nothing_behind(self):
        long = submit(self.server, self.history, endless_and_slow(), "long").name
        base, resident, freed = descriptors(self.server), [], []
        for _ in range(3):
            crowd = self.crowd(long, 2000, 20, "state_changed")
            self.assertGreater(descriptors(self.server), base)
            crowd.kill()
            crowd.wait(PATIENCE_S)
            freed.append(wait_for(lambda: descriptors(self.server) <= base + 1))
            resident.append(status_of(self.server, "VmRSS"))
        self.assertEqual(get(self.server, self.history, long).state, Job.RUNNING)
        self.server.cancel(long)
        self.assertPromises(self.server, resources={
            "descriptors": (base + 1, descriptors(self.server))})
        self.figures |= dict(rounds=3, watchers=2000, resident_mb=[round(mb) for mb in resident])
        self.assertKept("freed_after", max(freed), 1)
        self.assertKept("growth", resident[2] - resident[1], 10, "MB", slack=1)


class SlowReaderTest(CrowdTest):
    """F12."""

    flags = ("--workers=1", "--write-stall-seconds=5")

    def scenario(self):
        """Its log is several times what the connection of a stalled watcher takes: 11 MB."""
        scenario = spring_wall(0.4)
        scenario.output.sample_interval_s = 2e-6
        return scenario

    def test_a_stalled_watcher_costs_nobody_anything(self):
        alone = self.latency(stalled=0)
        base = status_of(self.server, "VmHWM")
        beside = self.latency(stalled=1)
        growth = status_of(self.server, "VmHWM") - base
        self.figures |= dict(p99_ms_alone=round(alone["p99"], 1))
        # At 20 ms a batch is written: below that there is nothing to tell apart.
        self.assertKept("p99", beside["p99"], round(max(alone["p99"], 20) * 1.5), "ms")
        self.assertKept("growth", growth, 16, "MB", slack=1)
        self.assertPromises(self.server)

    def latency(self, stalled):
        """Figures of 20 watchers beside so many that take nothing until the job has ended."""
        name = submit(self.server, self.history, self.scenario(), f"stalled-{stalled}").name
        slow = [self.server.watch(name) for _ in range(stalled)]
        watches = [self.history.watch(name) for _ in slow]
        for call, watch in zip(slow, watches):
            self.take(watch, next(call))
        figures = self.figures_of(self.crowd(name, 20, 4))
        self.assertEqual((figures["ended"], figures["failed"]), (20, 0))
        for call, watch in zip(slow, watches):
            self.catch_up(call, watch)
        return figures

    def catch_up(self, call, watch):
        """Reads what came while nothing was read, and the rest over another connection."""
        try:
            for message in call:
                self.take(watch, message)
        except grpc.RpcError as error:
            self.assertEqual(error.code(), grpc.StatusCode.CANCELLED, error)
        follow(self.server, watch)
        self.figures["stalled_got"] = len(watch.entries)

    def take(self, watch, message):
        for event in message.events:
            watch.add(event)


class IdleTest(CrowdTest):
    """F13."""

    flags = ("--workers=1", "--max-watchers=10001", "--max-watchers-per-peer=10001")

    def test_ten_thousand_idle_watchers_are_cheap(self):
        running = submit(self.server, self.history, endless_and_slow(), "running").name
        name = submit(self.server, self.history, endless_and_slow(), "queued").name
        wait_for(lambda: self.server.get(running).state == Job.RUNNING)
        alone = self.load()
        crowd = self.crowd(name, 10_000, 100)
        load = self.load() - alone
        resident = status_of(self.server, "VmRSS")
        self.server.cancel(name)
        figures = self.figures_of(crowd)
        self.assertEqual((figures["ended"], figures["failed"]), (10_000, 0))
        self.server.cancel(running)
        self.assertPromises(self.server)
        self.figures |= dict(attached_s=round(crowd.attached_s, 1))
        # 280 MB are gRPC's: each watcher has two calls in the process, the gateway's and the service's.
        self.assertKept("resident", resident, 450, "MB", slack=1)
        self.assertKept("load", load, 0.05, "cores")
        self.assertKept("event_reached_all", figures["max"] / 1000, 1)

    def load(self):
        """Cores used by all threads of the server but the busiest, its worker."""
        before, start = cpu_by_thread(self.server), time.monotonic()
        time.sleep(2)
        elapsed = time.monotonic() - start
        used = sorted(seconds - before.get(thread, 0)
                      for thread, seconds in cpu_by_thread(self.server).items())
        return sum(used[:-1]) / elapsed


if __name__ == "__main__":
    unittest.main()
