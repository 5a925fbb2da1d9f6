"""How jobs are named and recognised, and how a user learns which cycles miss their restitution."""

import json
import subprocess
import unittest

from cli_case import CHAIN, SCENARIOS, CliTest
from contactd import PATIENCE_S, three_ball_chain

HARD = ("--set", "solver.max_iterations=1", "--set", "solver.restitution_tolerance=1e-12")


class NamingJobsTest(CliTest):

    def run_of(self, scenario, *flags, code=0):
        return self.run_it("run", scenario, *flags, "-o", "name", code=code)[0].strip()

    def test_last_counts_from_the_newest_job(self):
        names = [self.run_of(SCENARIOS / "two-balls.yaml") for _ in range(3)]
        for text, name in (("last", names[2]), ("last~0", names[2]), ("last~2", names[0])):
            self.assertEqual(self.run_it("describe", text, "-o", "name")[0], name + "\n")
        self.assertIn("the server has 3 jobs", self.run_it("describe", "last~3", code=6)[1])
        self.run_it("delete", "last")
        self.assertEqual(self.run_it("describe", "last", "-o", "name")[0], names[1] + "\n")

    def test_first_letters_do_where_one_job_has_them(self):
        names = {self.server.create(three_ball_chain()).name for _ in range(33)}
        identifiers = sorted(name.removeprefix("jobs/") for name in names)
        for one in identifiers[:5]:
            shortest = next(n for n in range(1, 11)
                            if sum(other.startswith(one[:n]) for other in identifiers) == 1)
            self.assertEqual(self.run_it("wait", one[:shortest], "-o", "name")[0],
                             f"jobs/{one}\n")
        letters = [one[0] for one in identifiers]  # Of 32: one is there twice.
        twice = max(letters, key=letters.count)
        said = self.run_it("describe", twice, code=2)[1]
        self.assertIn(f"several jobs begin with '{twice}':", said)
        for one in [one for one in identifiers if one[0] == twice][:10]:
            self.assertIn(f"\n  {one}  ", said)
        self.assertIn("Triple-ball chain", said)

    def test_list_and_completion_tell_the_title(self):
        name = self.run_of(CHAIN).removeprefix("jobs/")
        self.assertRegex(self.run_it("list")[0], rf"(?m)^{name}  SUCCEEDED  Triple-ball chain ")
        self.assertEqual(json.loads(self.run_it("list", "-o", "json")[0])["jobs"][0]["title"],
                         "Triple-ball chain")
        program, *server = self.command()
        offered = subprocess.run([program, "__complete", *server, "describe", name[:3]],
                                 capture_output=True, encoding="utf-8", timeout=PATIENCE_S,
                                 check=True).stdout
        self.assertIn(f"{name}\tSUCCEEDED Triple-ball chain\n", offered)

    def test_sweep_has_the_title_of_its_base(self):
        self.run_it("sweep", "run", CHAIN, "--grid", "contacts[*].restitution=0.7,0.8")
        self.assertEqual(self.run_it("list", "-o", "csv", "--columns", "title,missed")[0],
                         "title,missed\nTriple-ball chain,0\n")


class MissedCyclesTest(CliTest):

    def setUp(self):
        super().setUp()
        self.printed, self.said = self.run_it("run", CHAIN, *HARD, code=7)
        self.job = self.server.list().jobs[0]

    def test_run_and_list_count_them(self):
        missed = self.job.summary.cycles_not_converged + self.job.summary.cycles_infeasible
        self.assertGreater(missed, 0)
        self.assertEqual(self.job.summary.cycles, 2)
        self.assertIn(f"convergence PARTIAL ({missed} of 2 cycles);", self.printed)
        self.assertEqual(self.run_it("list", "-o", "csv", "--columns", "missed")[0],
                         f"missed\n{missed}\n")

    def test_describe_shows_them_alone(self):
        whole = self.run_it("describe", "last")[0]
        missed = [line.split() for line in whole.splitlines() if " NOT_CONVERGED " in line]
        self.assertGreater(len(missed), 0)
        shown = self.run_it("describe", "last", "--only-missed")[0].splitlines()
        self.assertEqual([line.split() for line in shown if line.startswith(("B1-B2", "B2-B3"))],
                         missed)
        full = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        printed, said = self.run_it("describe", full, "--only-missed")
        self.assertNotIn("STATUS", printed)
        self.assertEqual(said, "no cycle misses its restitution\n")

    def test_hint_after_the_run_mends_it(self):
        hint = next(line for line in self.said.splitlines() if line.startswith("Try:"))
        flag, value = hint.split()[1:3]
        self.assertTrue(value.startswith("solver.max_iterations="), hint)
        self.run_it("run", CHAIN, "--set", "solver.restitution_tolerance=1e-10", flag, value)


if __name__ == "__main__":
    unittest.main()
