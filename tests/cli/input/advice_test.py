"""What contactctl says of files that are valid, but will probably not show what is wanted."""

import pathlib
import re
import tempfile
import unittest

from cli_case import CHAIN, CliTest

BALLS = CHAIN.parent / "two-balls.yaml"
SWEEP = CHAIN.parent / "table-3-sweep.yaml"
COARSE = CHAIN.read_text("utf-8").replace("solver: {", "solver: {method: RK4, step_s: 1.0e-4, ")


class FileTest(CliTest):

    def write(self, name, text):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = pathlib.Path(folder.name) / name
        path.write_text(text, "utf-8")
        return path


class AdviceTest(FileTest):

    def test_coarse_step_is_told_at_its_place_and_is_no_error(self):
        path = self.write("coarse.yaml", COARSE)
        line = next(i for i, text in enumerate(COARSE.splitlines(), 1) if "step_s" in text)
        column = COARSE.splitlines()[line - 1].index("1.0e-4") + 1
        warning = (f"{path}:{line}:{column}: warning: solver.step_s: gives a contact of B1-B2 16.1 "
                   "steps; it lasts about 0.0016 s at 0.2 m/s — 8e-06 gives it 200\n")
        printed, said = self.run_it("validate", path)
        self.assertEqual(said, warning)
        self.assertIn("valid; 3 bodies", printed)
        for command in ("run", "submit"):
            self.assertIn(warning, self.run_it(command, path, code=None)[1])

    def test_override_is_told_as_such(self):
        said = self.run_it("validate", CHAIN, "--set", "output.sample_interval_s=1e-3", "--set",
                           "output.samples_per_contact=0")[1]
        self.assertTrue(said.startswith("--set: warning: output.sample_interval_s: gives"), said)

    def test_job_keeps_the_advice_that_concerns_its_result(self):
        name = self.run_it("run", self.write("coarse.yaml", COARSE), "-o", "name", code=None)[0]
        self.assertIn("solver.step_s: gives a contact of B1-B2 16.1 steps",
                      self.run_it("describe", name.strip())[0])

    def test_sweep_is_told_at_the_place_in_its_base(self):
        base = self.write("three-ball-chain.yaml", COARSE)
        sweep = base.with_name("sweep.yaml")
        sweep.write_text(SWEEP.read_text("utf-8"), "utf-8")
        said = self.run_it("validate", sweep)[1]
        self.assertRegex(said, rf"^{re.escape(str(base))}:\d+:\d+: warning: solver.step_s: gives")

    def test_variable_that_is_used_nowhere_is_told_at_its_place(self):
        path = self.write("unused.yaml", "variables: {speed: 2}\n" + CHAIN.read_text("utf-8"))
        warning = (f"{path}:1:13: warning: variables.speed: is used nowhere — ${{speed}} stands "
                   "for its value\n")
        self.assertEqual(self.run_it("validate", path)[1], warning)
        self.assertIn(warning, self.run_it("sweep", "run", path, "--grid", "end_time_s=1e-3",
                                           "-o", "name", code=None)[1])

    def test_neighbours_without_a_contact_are_told_before_and_after(self):
        text = CHAIN.read_text("utf-8")
        lonely = "\n".join(line for line in text.splitlines() if "between: [B2, B3]" not in line)
        path = self.write("lonely.yaml", lonely.replace("position_m: 0.2}",
                                                        "position_m: 0.2, velocity_m_per_s: -1}"))
        said = self.run_it("validate", path)[1]
        self.assertIn("warning: contacts: have none between B2 and B3", said)
        name = self.run_it("run", path, "-o", "name", code=None)[0].strip()
        self.assertIn("which passed into each other", self.run_it("describe", name)[0])

    def test_contact_deeper_than_the_radius_is_told_before_and_after(self):
        path = self.write("soft.yaml", BALLS.read_text("utf-8").replace("1.0e8", "1.0"))
        said = self.run_it("validate", path)[1]
        self.assertIn(f"{path}:", said)
        self.assertIn("warning: contacts[0].stiffness: makes", said)
        name = self.run_it("run", path, "--set", "contacts[0].exponent=1", "--set", "end_time_s=4",
                           "-o", "name", code=None)[0].strip()
        self.assertRegex(self.run_it("describe", name)[0], "deep in cycle 1, more than the radius")

    def test_run_that_touches_nothing_says_so(self):
        name = self.run_it("run", CHAIN, "--set", "bodies[B1].velocity_m_per_s=-1", "-o",
                           "name")[0].strip()
        self.assertIn("contacts: were not touched in 0.004 s", self.run_it("describe", name)[0])

    def test_shipped_scenarios_and_sweeps_need_none(self):
        for path in sorted(CHAIN.parent.glob("*.yaml")):
            with self.subTest(path.stem):
                self.assertEqual(self.run_it("validate", path)[1], "")


class EstimateTest(FileTest):

    flags = ("--max-steps", "5000000", "--max-wall-time", "1h")

    def test_server_estimates_beside_its_limits(self):
        rows = self.estimate(BALLS)
        self.assertEqual(list(rows), ["TAKES", "steps", "samples", "output", "memory", "wall time"])
        self.assertRegex(rows["steps"], r"^\d+ +5000000$")
        self.assertRegex(rows["samples"], r"^1001 +\d+$")
        self.assertRegex(rows["output"], r"^[\d.]+ kB +4 GB$")
        self.assertRegex(rows["wall time"], r"^[\d.]+ [µm]?s +")

    def test_estimate_of_a_sweep_is_that_of_its_cells(self):
        base = BALLS.read_text("utf-8").replace("\n", "\n  ")
        sweep = self.write("sweep.yaml", f"base:\n  {base}\naxes:\n"
                           "- field: contacts[0].restitution\n"
                           "  linear: {low: 0.5, high: 0.9, count: 50}\nmetrics: [iterations]\n")
        one, all_cells = (float(self.estimate(path)["steps"].split()[0])
                          for path in (BALLS, sweep))
        self.assertAlmostEqual(all_cells / one, 50, delta=3)  # Two digits are shown.

    def test_steps_of_coupled_contacts_are_not_told(self):
        rows = self.estimate(CHAIN)
        self.assertRegex(rows["steps"], r"^- +5000000$")
        self.assertRegex(rows["wall time"], r"^- +")

    def estimate(self, path):
        printed = self.run_it("validate", path, "--on-server")[0]
        return dict(re.split(r"  +", line.strip(), maxsplit=1)
                    for line in printed.splitlines()[2:] if "  " in line)


if __name__ == "__main__":
    unittest.main()
