"""Watches over a link that is cut again and again hear every durable event once."""

import json
import os
import subprocess
import unittest
from unittest import mock

from contactd import PATIENCE_S, Job, ServerTest, spring_wall
from contactsim import Client, watching
from cutting_proxy import CuttingProxy

CONTACTCTL = os.environ["CONTACTCTL"]
CUTS = 20
PASSING = ("progress", "bookmark", "gap")


class CutLinkTest(ServerTest):
    """A job that makes events while the link to it is cut 20 times."""

    def setUp(self):
        super().setUp()
        # A run of some hundred cycles with 4 MB of samples.
        scenario = spring_wall(end_time_s=2.0)
        scenario.output.sample_interval_s = 3e-5
        self.job = self.server.create(scenario).name
        # A message has at most about 256 KiB: every second connection gets further. The first one
        # must: contactctl tries again only what it has heard something of.
        self.proxy = CuttingProxy(self.server.port, CUTS, (300_000, 5_000))
        self.addCleanup(self.proxy.close)

    def assertHeardAll(self, heard):
        """`heard` has (sequence, kind) of all that came."""
        durable = [entry for entry in heard if entry[1] not in PASSING]
        whole = [(event.sequence, event.WhichOneof("payload"))
                 for event in self.server.events(self.job)
                 if event.WhichOneof("payload") not in PASSING]
        self.assertEqual(self.proxy.cuts, CUTS)
        self.assertEqual(durable, whole)
        self.assertEqual(self.server.get(self.job).state, Job.SUCCEEDED)

    def test_contactctl_watch(self):
        run = subprocess.run(
            [CONTACTCTL, "--server", self.proxy.address, "watch", self.job, "-o", "jsonl"],
            capture_output=True, encoding="utf-8", timeout=5 * PATIENCE_S, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        events = map(json.loads, run.stdout.splitlines())
        self.assertHeardAll([
            (int(event.get("sequence", 0)),
             next(iter(event.keys() - {"sequence", "event_time"}))) for event in events])
        # Cuts before anything came are of one outage.
        lost = run.stderr.count("connection lost")
        self.assertEqual(run.stderr.splitlines().count("connected again"), lost)
        self.assertIn(lost, range(1, CUTS + 1))

    def test_python_watch(self):
        with mock.patch.object(watching, "_FIRST_PAUSE_S", 0.01), \
                Client(self.proxy.address) as client:
            self.assertHeardAll([(event.sequence, event.WhichOneof("payload"))
                                 for event in client.watch(self.job, timeout_s=5 * PATIENCE_S)])

    def test_python_result_is_that_of_a_whole_link(self):
        self.proxy = CuttingProxy(self.server.port, CUTS, (1_000,))
        self.addCleanup(self.proxy.close)
        with mock.patch.object(watching, "_FIRST_PAUSE_S", 0.01), \
                Client(self.proxy.address) as client, \
                Client(f"127.0.0.1:{self.server.port}") as straight:
            result = client.result(self.job, timeout_s=5 * PATIENCE_S)
            self.assertEqual(self.proxy.cuts, CUTS)
            self.assertTrue(result.series.equals(straight.result(self.job).series))

    def test_artifact_download_goes_on_where_it_was(self):
        self.server.events(self.job)
        path = self.folder / "motion.csv"
        arguments = ["artifact", "get", self.job, "trajectory.csv", "-f", str(path)]
        for address, target in ((self.proxy.address, path),
                                (f"127.0.0.1:{self.server.port}", self.folder / "straight.csv")):
            arguments[-1] = str(target)
            run = subprocess.run([CONTACTCTL, "--server", address, *arguments],
                                 capture_output=True, encoding="utf-8",
                                 timeout=5 * PATIENCE_S, check=False)
            self.assertEqual(run.returncode, 0, run.stderr)
        self.assertGreater(self.proxy.cuts, 0)
        self.assertEqual(path.read_bytes(), (self.folder / "straight.csv").read_bytes())

    def test_part_of_a_download_is_kept_and_a_wrong_one_is_not(self):
        self.server.events(self.job)
        whole, path = self.folder / "whole.csv", self.folder / "motion.csv"
        part = self.folder / "motion.csv.part"

        def get(target):
            return subprocess.run(
                [CONTACTCTL, "--server", f"127.0.0.1:{self.server.port}", "artifact", "get",
                 self.job, "trajectory.csv", "-f", str(target)],
                capture_output=True, encoding="utf-8", timeout=PATIENCE_S, check=False)

        self.assertEqual(get(whole).returncode, 0)
        part.write_bytes(whole.read_bytes()[:100_000])
        self.assertEqual(get(path).returncode, 0)
        self.assertEqual(path.read_bytes(), whole.read_bytes())
        part.write_bytes(b"x" * 100_000)
        run = get(path)
        self.assertEqual(run.returncode, 1)
        self.assertIn("is not what the server has", run.stderr)
        self.assertFalse(part.exists())
        self.assertEqual(get(path).returncode, 0)


if __name__ == "__main__":
    unittest.main()
