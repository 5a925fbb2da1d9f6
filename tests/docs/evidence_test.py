"""The evidence is computed, holds, and says so where it does not."""

import csv
import dataclasses
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "client" / "docs" / "evidence"
sys.path.insert(0, str(FOLDER))

import report  # noqa: E402
import rows  # noqa: E402


def evidence(*arguments):
    return subprocess.run([FOLDER / "run", *arguments], capture_output=True, encoding="utf-8",
                          env=os.environ, timeout=600)


def read(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


class EvidenceTest(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_every_fast_row_holds_and_is_written_down(self):
        run = evidence("--fast", "--write", str(self.folder))
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        table = read(self.folder / "table.csv")
        self.assertGreater(len(table), 100)
        self.assertEqual({row["holds"] for row in table}, {"True"})
        self.assertEqual([row["row"] for row in read(self.folder / "history.csv")],
                         [row["row"] for row in table])
        page = (self.folder / "table.md").read_text("utf-8")
        self.assertEqual([row["row"] for row in table if f" `{row['row']}` |" not in page], [])

    def test_the_table_of_the_site_has_the_rows_that_there_are(self):
        listed = evidence("--list")
        self.assertEqual(listed.returncode, 0, listed.stderr)
        self.assertEqual([row["row"] for row in read(FOLDER / "table.csv")],
                         listed.stdout.split())

    def test_a_row_runs_alone_and_an_unknown_one_is_refused(self):
        self.assertIn("1 of 1 rows hold", evidence("mu-0.5").stdout)
        self.assertNotEqual(evidence("no-such-row").returncode, 0)


class RowsTest(unittest.TestCase):

    def claim(self, ours, theirs, **changes):
        row = rows.Row("key", "group", "what", "source", 1e-3, lambda _: (ours, theirs))
        return rows.measure(dataclasses.replace(row, **changes), None)

    def test_a_number_too_far_off_and_nan_do_not_hold(self):
        self.assertTrue(self.claim(1.0009, 1).holds)
        self.assertFalse(self.claim(1.0011, 1).holds)
        self.assertFalse(self.claim(float("nan"), 1).holds)
        self.assertFalse(self.claim((1, float("nan")), (1, 2)).holds)
        self.assertIn("**missed**", report.line(self.claim(2, 1)))

    def test_of_several_numbers_the_one_that_differs_most_is_kept(self):
        self.assertAlmostEqual(self.claim((100, 1.01), (100, 1)).difference, 1e-4)
        self.assertAlmostEqual(self.claim((100, 1.01), (100, 1), each=True).difference, 0.01)
        with self.assertRaises(ValueError):
            self.claim((1, 2), (1,))

    def test_a_balance_is_absolute(self):
        self.assertEqual(self.claim(5e-4, 0).difference, 5e-4)


if __name__ == "__main__":
    unittest.main()
