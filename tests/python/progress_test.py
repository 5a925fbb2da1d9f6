"""The bar that tells how far a job is."""

import contextlib
import io
import pathlib
import sys
import unittest
from unittest import mock

from contact.v1 import job_pb2
from contactd import ServerTest
from contactsim import Client
from contactsim.progress import part_done

CHAIN = pathlib.Path(__file__).parents[2] / "client" / "scenarios" / "three-ball-chain.yaml"
PATIENCE_S = 60


class ProgressTest(ServerTest):

    def setUp(self):
        super().setUp()
        self.client = Client(f"127.0.0.1:{self.server.port}")
        self.addCleanup(self.client.close)

    def said(self, act):
        """What is shown meanwhile."""
        with contextlib.redirect_stderr(io.StringIO()) as stream:
            act()
        return stream.getvalue()

    def test_run_ends_at_100_percent(self):
        said = self.said(lambda: self.client.run(CHAIN, progress=True, timeout_s=PATIENCE_S))
        self.assertIn("  0 %|", said)
        self.assertTrue(said.splitlines()[-1].lstrip("\r").startswith("100 %|"), said)

    def test_sweep_tells_its_cells(self):
        said = self.said(lambda: self.client.sweep(
            CHAIN, {"contacts[*].restitution": [0.5 + i / 1000 for i in range(400)]},
            progress=True, timeout_s=PATIENCE_S))
        self.assertTrue(said.splitlines()[-1].lstrip("\r").startswith("100 %|"), said)
        self.assertRegex(said, r"\d+ of 400 cells, 0 failed")

    def test_nothing_is_shown_unless_asked_for(self):
        self.assertEqual(
            self.said(lambda: self.client.run(CHAIN, timeout_s=PATIENCE_S)), "")

    def test_without_tqdm_the_error_names_the_package_and_nothing_is_submitted(self):
        with mock.patch.dict(sys.modules, {"tqdm": None, "tqdm.auto": None}):
            with self.assertRaisesRegex(ImportError, "apt install python3-tqdm"):
                self.client.run(CHAIN, progress=True)
            self.client.run(CHAIN, timeout_s=PATIENCE_S)
        self.assertEqual(len(self.client.list()), 1)


class PartDoneTest(unittest.TestCase):

    def test_part_is_of_time_or_cells(self):
        self.assertEqual(part_done(job_pb2.Progress(time_s=1, end_time_s=4)), 0.25)
        self.assertEqual(part_done(job_pb2.Progress(cells=8, cells_done=2)), 0.25)
        self.assertEqual(part_done(job_pb2.Progress()), 0.0)


if __name__ == "__main__":
    unittest.main()
