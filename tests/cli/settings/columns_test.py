"""--columns chooses which columns tables and csv have."""

import subprocess
import unittest

from cli_case import CHAIN, CONTACTCTL, CliTest
from contactd import PATIENCE_S

TABLE3 = CHAIN.parent / "table-3-sweep.yaml"


class ColumnsTest(CliTest):

    def header(self, *arguments):
        return self.run_it(*arguments)[0].splitlines()[0]

    def test_list_has_those_that_are_asked_for_in_their_order(self):
        self.run_it("run", CHAIN, "--label", "a=b", "-o", "name")
        self.assertEqual(self.header("list", "--columns", "state,job,cycles").split(),
                         ["STATE", "JOB", "CYCLES"])
        self.assertEqual(self.header("list", "--columns", "STATE", "--columns", "Job").split(),
                         ["STATE", "JOB"])
        lines = self.run_it("list", "-o", "csv", "--columns", "labels,state,reason")[0]
        self.assertEqual(lines, "labels,state,reason\na=b,SUCCEEDED,\n")
        self.assertEqual(self.header("list", "-o", "csv"),
                         "job,state,title,kind,reason,convergence,missed,created,ended,labels,cycles,"
                         "attempt")

    def test_ledger_has_them_and_the_rest_stays(self):
        name = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        shown = self.run_it("describe", name, "--columns", "contact,peak_force,ε OUT")[0]
        self.assertIn("\nCONTACT  PEAK FORCE [N]  ε OUT\nB1-B2          104.6521    0.8\n", shown)
        self.assertIn("BODY", shown)
        shown = self.run_it("run", CHAIN, "--columns", "work_compression,contact")[0]
        self.assertIn("\n    W_c [J]  CONTACT\n", shown)

    def test_sweep_has_them_in_table_and_csv(self):
        sweep = self.run_it("sweep", "run", TABLE3, "-o", "name")[0].strip()
        shown = self.run_it("sweep", "watch", sweep, "--columns", "verdict,iterations,cell")[0]
        self.assertIn("\nVERDICT  iterations  CELL\nFULL ", shown)
        field = "contacts[*].restitution"
        lines = self.run_it("sweep", "export", sweep, "-o", "csv", "--columns",
                            f"{field},cycles[B1-B2].alpha,state")[0].splitlines()
        self.assertEqual(lines[0], f"{field},cycles[B1-B2].alpha,state")
        self.assertEqual(len(lines), 51)
        self.assertTrue(all(line.endswith(",SUCCEEDED") for line in lines[1:]))
        every = self.run_it("sweep", "export", sweep, "-o", "csv")[0].splitlines()
        self.assertEqual(every[0].split(",")[-3:], ["state", "convergence", "message"])
        self.assertEqual(every[1].split(",")[2], lines[1].split(",")[0])

    def test_models_have_them(self):
        self.assertEqual(self.header("model", "list", "--columns", "source,law").split(),
                         ["SOURCE", "LAW"])
        compare = ("model", "compare", "flores", "hu-guo", "--restitution", "0.5,0.9")
        self.assertEqual(self.header(*compare, "--columns", "0.9,law").split(), ["0.9", "LAW"])
        self.assertEqual(self.header(*compare, "-o", "csv", "--columns", "miss,law"), "miss,law")

    def test_unknown_column_is_told_before_anything_is_done(self):
        for arguments in (("list",), ("run", CHAIN), ("describe", "x"), ("model", "list"),
                          ("sweep", "run", TABLE3)):
            said = self.run_it(*arguments, "--columns", "no_such", code=2)[1]
            self.assertIn("--columns: there is no column 'no_such' — there are ", said)
        self.assertIn("no column 'stat', did you mean 'state'? — there are job, state, title,",
                      self.run_it("list", "--columns", "job,stat", code=2)[1])
        self.assertEqual(self.run_it("list", "-o", "name")[0], "")

    def test_columns_of_json_are_refused(self):
        self.assertIn("--columns are those of a table or csv",
                      self.run_it("list", "-o", "json", "--columns", "job", code=2)[1])

    def test_names_are_completed(self):
        def offered(*words):
            run = subprocess.run([CONTACTCTL, "__complete", *words], capture_output=True,
                                 encoding="utf-8", timeout=PATIENCE_S, check=True)
            return [line.split("\t")[0] for line in run.stdout.splitlines()]
        self.assertIn("restitution_out", offered("describe", "x", "--columns", "rest"))
        self.assertEqual(offered("list", "--columns", "job,sta"), ["job,state", ":nospace"])


if __name__ == "__main__":
    unittest.main()
