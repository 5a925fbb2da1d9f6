"""How files are checked, submitted and followed, and which columns a table has."""

import contextlib
import csv
import json
import re
import signal
import subprocess
import unittest

from cli_case import CHAIN, LONG, SPRING, CliTest
from contactd import PATIENCE_S


class FollowingTest(CliTest):

    def test_iterations_are_shown_as_many_as_asked_for(self):
        def rows(*flags):
            return self.run_it("run", SPRING, "--set", "end_time_s=0.2", *flags)[1]
        self.assertIn("… more iterations", rows())
        self.assertNotIn("EPISODE", rows("--iterations", "none"))
        every = rows("--iterations", "all")
        self.assertNotIn("… more", every)
        self.assertGreater(every.count(" accepted"), 60)
        self.run_it("run", SPRING, "--iterations", "few", code=2)

    def test_plain_progress_is_a_line_a_tenth(self):
        said = self.run_it("run", SPRING, "--set", "end_time_s=20", "--set",
                           "output.ledger_only=true", "--iterations", "none", "--progress",
                           "plain", "--timeout", "30s", code=None)[1]  # A few will do.
        told = [line for line in said.splitlines() if " % " in line]
        self.assertGreater(len(told), 0)
        self.assertLessEqual(len(told), 10)
        percents = [int(line.split()[0]) for line in told]
        self.assertEqual(percents, sorted(set(percents)))
        self.assertNotIn("\x1b", said)

    def test_progress_of_a_sweep_is_told_in_lines_too(self):
        said = self.run_it("sweep", "run", CHAIN, "-o", "csv", "--progress", "plain",
                           "--grid", "bodies[0].velocity_m_per_s=0.1:0.5:10000")[1]
        self.assertRegex(said, r"\d+ of 10000 cells, 0 failed, 0 not converged")

    def test_interrupt_cancels_where_asked_to(self):
        process = subprocess.Popen(self.command("run", SPRING, *LONG, "--cancel-on-interrupt"),
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        name = next(line for line in process.stderr if line.startswith("jobs/")).split()[0]
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(PATIENCE_S), 130)
        self.assertIn("is asked to stop", process.stderr.read())
        printed, _ = self.run_it("wait", name, code=1)
        self.assertIn("CANCELLED", printed)

    def test_wide_tables_have_more_columns(self):
        name = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        narrow, wide = (self.run_it("describe", name, *flags)[0] for flags in ((), ("-o", "wide")))
        self.assertNotIn("PEAK FORCE [N]", narrow)
        self.assertIn("PEAK FORCE [N]", wide)
        self.assertIn("104.6521", wide)
        rows = self.run_it("run", CHAIN, "-o", "wide")[1]
        self.assertRegex(rows, r"NEWTON +\[[-\d.e+]+, [-\d.e+]+\]\n")
        self.assertIn("ATTEMPT", self.run_it("list", "-o", "wide")[0])

    def test_server_is_asked_whether_it_would_take_a_file(self):
        printed, _ = self.run_it("validate", CHAIN, "--on-server")
        self.assertIn(f"contactd at 127.0.0.1:{self.server.port} would take it\n", printed)
        self.run_it("validate", CHAIN, "--on-server", server="127.0.0.1:1", code=4)
        self.assertEqual(self.run_it("list", "-o", "name")[0], "")

    def test_shipped_scenarios_run_without_a_file(self):
        name = self.run_it("run", "-t", "three-ball-chain", "--set",
                           "contacts[*].restitution=0.5", "-o", "name")[0].strip()
        self.assertEqual([c.restitution for c in self.server.get(name).scenario.contacts],
                         [0.5, 0.5])
        self.assertIn("did you mean 'two-balls'?",
                      self.run_it("run", "-t", "two-bals", code=2)[1])
        self.assertIn("contactctl sweep run -t table-3-sweep",
                      self.run_it("run", "-t", "table-3-sweep", code=2)[1])
        self.run_it("run", CHAIN, "-t", "two-balls", code=2)

    def test_lists_are_for_programs_too(self):
        names = [self.run_it("run", CHAIN, "--label", "study=one", *flags, "-o", "name")[0].strip()
                 for flags in ((), ("--label", "who=me"))]
        rows = list(csv.DictReader(self.run_it("list", "-o", "csv")[0].splitlines()))
        self.assertEqual([(f"jobs/{row['job']}", row["labels"], row["cycles"]) for row in rows],
                         [(names[1], "study=one, who=me", "2"), (names[0], "study=one", "2")])
        lines = self.run_it("list", "-o", "jsonl")[0].splitlines()
        self.assertEqual([json.loads(line)["name"] for line in lines], names[::-1])

    def test_next_steps_of_a_run_work(self):
        for flags, shown in (((), True), (("--set", "output.ledger_only=true"), False)):
            said = self.run_it("run", CHAIN, *flags)[1]
            steps = re.findall("contactctl ((?:watch|describe|plot) .*?)(?:   |  [a-z])", said)
            self.assertEqual([step.split()[0] for step in steps],
                             ["watch", "describe"] + ["plot"] * shown)
            for step in steps:
                with contextlib.chdir(self.folder):
                    self.run_it(*step.split())

    def test_hints_follow_the_result_where_both_go_to_one_file(self):
        for command in (("run", CHAIN), ("sweep", "run", CHAIN, "--grid",
                                         "contacts[*].restitution=0.5:0.9:60")):
            both = subprocess.run(self.command(*command), stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, encoding="utf-8", timeout=PATIENCE_S,
                                  check=True).stdout.splitlines()
            hint = next(i for i, line in enumerate(both) if line.startswith("Next:"))
            result = [i for i, line in enumerate(both) if line.startswith(("convergence", "jobs/"))]
            self.assertLess(max(result), hint)
            self.assertTrue(both[-1].lstrip().startswith(("Next:", "contactctl ")))

    def test_grid_of_a_scenario_is_a_sweep(self):
        printed = self.run_it("sweep", "run", CHAIN, "-o", "csv",
                              "--grid", "bodies[0].velocity_m_per_s=0.1,0.5",
                              "--grid", "contacts[*].restitution=0.9:0.5:3",
                              "--metric", "cycles[B1-B2].alpha")[0].splitlines()
        self.assertEqual(printed[0], "cell,bodies[0].velocity_m_per_s,contacts[*].restitution,"
                                     "cycles[B1-B2].alpha,state,convergence,message")
        self.assertEqual([tuple(line.split(",")[1:3]) for line in printed[1:]],
                         [("0.1", "0.9"), ("0.1", "0.7"), ("0.1", "0.5"),
                          ("0.5", "0.9"), ("0.5", "0.7"), ("0.5", "0.5")])
        for axis in ("nonsense", "end_time_s=1:2", "end_time_s=1:2:0", "end_time_s=a:b:3"):
            said = self.run_it("sweep", "run", CHAIN, "--grid", axis, code=2)[1]
            self.assertIn(f"--grid {axis}: expected FIELD=FIRST:LAST:COUNT", said)
        said = self.run_it("sweep", "run", CHAIN, "--grid", "contacts[0].restituton=0.5",
                           code=3)[1]
        self.assertIn("did you mean 'restitution'?", said)

    def test_cells_of_a_scenario_are_drawn(self):
        def draw(*how):
            printed = self.run_it("sweep", "run", CHAIN, "-o", "csv",
                                  "--grid", "contacts[*].restitution=0.5:0.9", *how)[0]
            return [float(line.split(",")[1]) for line in printed.splitlines()[1:]]

        evenly = draw("--lhs", "8")
        self.assertEqual(sorted(int((e - 0.5) / 0.05) for e in evenly), list(range(8)))
        drawn = draw("--random", "8", "--seed", "3")
        self.assertEqual(drawn, draw("--random", "8", "--seed", "3"))
        self.assertNotEqual(drawn, draw("--random", "8"))
        said = self.run_it("sweep", "run", CHAIN, "--grid", "end_time_s=1:2:3", "--lhs", "4",
                           code=2)[1]
        self.assertIn("expected FIELD=LOW:HIGH", said)
        self.run_it("sweep", "run", CHAIN, "--lhs", "4", code=2)


if __name__ == "__main__":
    unittest.main()
