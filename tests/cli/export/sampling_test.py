"""Numbers of runs whose contacts lie between samples say so, in the words of the figures."""

import csv
import io
import json
import unittest

import netCDF4
import scipy.io
from cli_case import CHAIN, SCENARIOS, CliTest
from contactsim import Client
from contactsim.figures.coarse import stamp
from contactsim.figures.shown import Part, Shown

COARSE = ("--set", "output={}", "--set", "output.samples_per_contact=0")


class SamplingTest(CliTest):

    def run_and_stamp(self, scenario, *flags, part=Part()):
        name = self.run_it("run", scenario, *flags, "-o", "name")[0].strip()
        with Client(f"127.0.0.1:{self.server.port}") as client:
            return name, stamp(Shown(client.result(name), part))

    def test_every_form_of_the_series_has_the_stamp_of_the_figures(self):
        name, words = self.run_and_stamp(SCENARIOS / "bouncing-ball.yaml", *COARSE)
        self.assertRegex(words, r"^\d+ of \d+ contacts have fewer than 10 samples$")
        told = (f"{words}, too few to show. For more:\n"
                f"  contactctl run --like {name} --set output.samples_per_contact=100\n")
        for form in "table", "csv", "json":
            with self.subTest(form):
                printed, said = self.run_it("series", name, "-o", form)
                self.assertEqual(said, told)
                if form == "json":
                    self.assertEqual(json.loads(printed)["sampling"], words)
        for form in "csv", "jsonl":
            self.assertEqual(self.run_it("export", name, "-o", form)[1], told)
        for verb in "series", "export":
            for flags in [], ["--max-points" if verb == "export" else "--points", 100]:
                printed, said = self.run_it(verb, name, "-o", "csv", "--comments", *flags)
                self.assertEqual(said, told)
                self.assertIn(f"\n# sampling: {words}\n", printed)
        for ending in "nc", "mat":
            path = self.folder / f"a.{ending}"
            self.assertEqual(self.run_it("export", name, "-f", path)[1].rsplit(str(path))[0], told)
        with netCDF4.Dataset(self.folder / "a.nc") as file:
            self.assertEqual(file.sampling, words)
        mat = scipy.io.loadmat(self.folder / "a.mat", simplify_cells=True)
        self.assertEqual(mat["provenance"]["sampling"], words)

    def test_a_part_of_a_run_counts_its_own_contacts(self):
        part = Part(start=0.3, end=1.2)
        name, words = self.run_and_stamp(SCENARIOS / "bouncing-ball.yaml", *COARSE, part=part)
        _, whole = self.run_and_stamp(SCENARIOS / "bouncing-ball.yaml", *COARSE)
        self.assertNotEqual(words, whole)
        for verb in "series", "export":
            said = self.run_it(verb, name, "-o", "csv", "--from", part.start, "--to", part.end)[1]
            self.assertTrue(said.startswith(f"{words}, "), said)

    def test_samples_that_are_enough_are_not_mentioned(self):
        name, words = self.run_and_stamp(CHAIN)
        self.assertEqual(words, "")
        for verb, form in ("series", "table"), ("series", "json"), ("export", "csv"):
            printed, said = self.run_it(verb, name, "-o", form)
            self.assertEqual(said, "")
            self.assertNotIn("sampling", printed)
        path = self.folder / "a.nc"
        self.run_it("export", name, "-f", path)
        with netCDF4.Dataset(path) as file:
            self.assertNotIn("sampling", file.ncattrs())

    def test_tables_of_contacts_and_runs_without_a_trajectory_need_no_samples(self):
        name, _ = self.run_and_stamp(SCENARIOS / "bouncing-ball.yaml", *COARSE)
        for table in "cycles", "groups", "bodies":
            printed, said = self.run_it("export", name, "-o", "csv", "--table", table, "--comments")
            self.assertEqual((said, "sampling" in printed), ("", False), table)
        bare, _ = self.run_and_stamp(CHAIN, "--set", "output.ledger_only=true")
        self.assertEqual(self.run_it("export", bare, "-f", self.folder / "b.nc")[1].count("fewer"), 0)

    def test_a_series_longer_than_an_answer_is_counted_whole(self):
        name, words = self.run_and_stamp(CHAIN, "--set", "output.sample_interval_s=5e-9",
                                         "--set", "output.samples_per_contact=0")
        self.assertEqual((words, self.run_it("series", name)[1]), ("", ""))
        text = self.run_it("export", name, "-o", "csv", "--channels", "B1.velocity")[0]
        self.assertGreater(len(list(csv.reader(io.StringIO(text)))), 500_000)


if __name__ == "__main__":
    unittest.main()
