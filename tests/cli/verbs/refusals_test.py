"""What verbs refuse, with which exit code and in which words, where no other test asks."""

import json
import os
import unittest

from cli_case import CHAIN, SCENARIOS, SPRING, CliTest

TABLE_3 = SCENARIOS / "table-3-sweep.yaml"
NOWHERE = "127.0.0.1:1"  # Where no server is.


class LocalRefusals(CliTest):
    """Refused before any server is asked."""

    def refused(self, *arguments, code=2):
        printed, said = self.run_it(*arguments, code=code, server=NOWHERE)
        self.assertEqual(printed, "")
        return said

    def test_words_that_a_verb_does_not_know(self):
        self.assertIn("did you mean 'bash'?", self.refused("completion", "bahs"))
        self.assertIn("did you mean 'sweep'?", self.refused("schema", "sweeep"))
        self.assertIn("did you mean 'force'?", self.refused("plot", "x", "forse"))
        self.assertIn("did you mean 'none'?", self.refused("run", CHAIN, "--iterations", "nonee"))
        self.assertIn("did you mean 'cycles'?", self.refused("export", "x", "--table", "cylces"))

    def test_numbers_out_of_range(self):
        for arguments in (["export", "x", "--every", "0"], ["export", "x", "--max-points", "-5"],
                          ["export", "x", "--precision", "18"], ["series", "x", "--points", "0"],
                          ["compare", "x", "y", "--rel", "-1"], ["list", "--limit", "-1"],
                          ["list", "--limit", "0"]):
            with self.subTest(arguments):
                self.assertLess(len(self.refused(*arguments)), 200)
        self.assertIn("--limit: is -1; must be a number of at least 1",
                      self.refused("list", "--limit", "-1"))
        self.refused("list", "--limit", "5", "--all")

    def test_drawn_cells_need_axes_and_one_way_to_draw(self):
        axes = ("--grid", "contacts[*].restitution=0.5:0.9")
        self.refused("sweep", "run", CHAIN, "--random", 5)
        self.refused("sweep", "run", CHAIN, "--seed", 5)
        self.refused("sweep", "run", CHAIN, *axes, "--random", 5, "--lhs", 5)
        self.refused("sweep", "run", CHAIN, *axes, "--random", 1_000_001)

    def test_grid_that_is_no_assignment(self):
        self.assertIn("--grid", self.refused("sweep", "run", CHAIN, "--grid", "restitution"))

    def test_zero_is_told_as_what_was_given(self):
        self.assertIn("--set: end_time_s: is 0; must be in (0, 1e6]",
                      self.refused("run", CHAIN, "--set", "end_time_s=0", code=3))

    def test_template_that_is_not_there_is_told_with_the_nearest_one(self):
        for verb in ["run"], ["sweep", "run"], ["submit"]:
            self.assertIn("did you mean 'three-ball-chain'?", self.refused(*verb, "-t", "threeball"))

    def test_scenario_and_sweep_are_not_taken_for_each_other(self):
        for source in ([CHAIN], ["-t", "two-balls"]):
            said = self.refused("sweep", "run", *source)
            name = " ".join(map(str, source))
            self.assertIn(f"{name} is a scenario: `contactctl run {name}` solves it", said)
            self.assertIn(f"`contactctl sweep run {name} --grid FIELD=VALUES` many of it", said)
        for source in ([TABLE_3], ["-t", "table-3-sweep"]):
            self.assertIn("is a sweep, with axes of its own",
                          self.refused("sweep", "run", *source, "--grid", "bodies[0].mass_kg=1,2"))

    def test_metric_of_a_cycle_is_told_with_its_list(self):
        self.assertIn("did you mean 'cycles.max.peak_force_n', or cycles[NAME].last.peak_force_n",
                      self.refused("sweep", "run", CHAIN, "--grid", "contacts[*].restitution=0.7,0.8",
                                   "--metric", "peak_force", code=3))

    def test_flags_of_a_scenario_are_not_those_of_a_sweep(self):
        self.assertIn("--set is for scenarios; a sweep has axes",
                      self.refused("validate", SCENARIOS / "table-3-sweep.yaml", "--set",
                                   "title=T"))

    def test_format_in_the_place_of_a_file(self):
        for arguments in (["report", "x"], ["server", "backup"], ["paper"]):
            with self.subTest(arguments):
                self.assertIn("prints no json", self.refused(*arguments, "-o", "json"))
        self.assertEqual(list(self.folder.glob("json*")), [])

    def test_config_without_a_home_or_a_folder_to_write_to(self):
        os.environ.pop("XDG_CONFIG_HOME", None)
        home = os.environ.pop("HOME", None)
        try:
            self.assertIn("set HOME", self.refused("config", "set", "server", "a:1", code=11))
            blocked = self.folder / "file"
            blocked.write_text("")
            os.environ["HOME"] = str(blocked)  # A file has no folders in it.
            self.assertIn("cannot write ", self.refused("config", "set", "server", "a:1", code=11))
        finally:
            os.environ.pop("HOME", None)
            if home is not None:
                os.environ["HOME"] = home


class RefusalsOfAServer(CliTest):
    """Refused for what the server has."""

    def setUp(self):
        super().setUp()
        self.job = self.run_it("run", CHAIN, "-o", "name")[0].strip()

    def refused(self, *arguments, code):
        printed, said = self.run_it(*arguments, code=code)
        self.assertEqual(printed, "")
        return said

    def test_artifact_that_the_job_does_not_have(self):
        here = self.folder / "x.csv"
        self.refused("artifact", "get", self.job, "nothing.csv", "-f", here, code=6)
        self.assertEqual(list(self.folder.glob("x.csv*")), [])
        self.refused("artifact", "get", self.job, "trajectory.csv", "-f", "/nowhere/x", code=11)

    def test_time_range_that_is_empty(self):
        self.assertIn("end_time_s", self.refused("series", self.job, "--from", "2e-3", "--to",
                                                 "1e-3", code=2))

    def test_job_that_has_ended_is_not_cancelled(self):
        for _ in range(2):
            printed, said = self.run_it("cancel", self.job)
            self.assertEqual((printed, said), (
                f"{self.job}  SUCCEEDED\n", f"{self.job} has ended, so there is nothing to cancel\n"))
        running = self.submit_long()
        self.assertEqual(self.run_it("cancel", running)[1], "")

    def test_labels_and_request_ids_that_break_a_rule(self):
        self.assertIn("request_id", self.refused("submit", CHAIN, "--request-id", "x" * 200,
                                                 code=2))
        self.assertIn("priority", self.refused("submit", CHAIN, "--priority", 101, code=2))
        self.assertEqual(len(json.loads(self.run_it("list", "-o", "json")[0])["jobs"]), 1)

    def test_request_id_of_another_scenario(self):
        self.run_it("submit", CHAIN, "--request-id", "mine", "-o", "name")
        self.refused("submit", SPRING, "--request-id", "mine", code=1)

    def test_sweep_where_a_run_is_wanted(self):
        sweep = self.run_it("sweep", "run", CHAIN, "--grid", "contacts[*].restitution=0.7,0.8",
                            "-o", "name")[0].strip()
        self.assertIn("is a sweep; see sweep export",
                      self.refused("report", sweep, "-f", self.folder / "r.html", code=2))
        self.assertIn("is a sweep, not a run", self.refused("run", "--like", sweep, code=2))
        self.assertEqual(list(self.folder.glob("r.html")), [])
        self.assertIn(f"contactctl sweep run {TABLE_3}", self.refused("run", TABLE_3, code=2))
        later = self.run_it("submit", TABLE_3, "-o", "name")[0].strip()
        shipped = self.run_it("sweep", "run", "-t", "table-3-sweep", "-o", "name")[0].strip()
        self.run_it("wait", later)
        self.assertEqual(self.server.get(later).spec_sha256, self.server.get(shipped).spec_sha256)
        kinds = self.run_it("list", "-o", "csv", "--columns", "job,kind")[0].splitlines()
        for name in (sweep, later, shipped):
            self.assertIn(f"{name.removeprefix('jobs/')},sweep", kinds)
        self.assertIn("there is no cell 2; the last is 1",
                      self.refused("sweep", "cell", sweep, 2, code=2))

    def test_heat_map_of_three_axes(self):
        grids = [f"--grid=bodies[{i}].velocity_m_per_s=0.7,0.8" for i in range(3)]
        sweep = self.run_it("sweep", "run", CHAIN, *grids, "-o", "name")[0].strip()
        self.assertIn("heat map is of a grid of two axes",
                      self.refused("sweep", "heatmap", sweep, code=2))


if __name__ == "__main__":
    unittest.main()
