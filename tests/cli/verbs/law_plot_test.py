"""contactctl model plot: curves of damping laws, without a server where they have a closed form."""

import csv
import json
import subprocess
import unittest

from cli_case import CliTest
from contactd import PATIENCE_S

NOWHERE = "127.0.0.1:1"  # Where no server is.


class LawPlotTest(CliTest):

    def plot(self, *arguments, file="a.svg", code=0, server=NOWHERE):
        path = self.folder / file
        printed, said = self.run_it("model", "plot", *arguments, "-f", path, code=code,
                                    server=server)
        if code != 0:
            return said
        self.assertEqual((printed, said), (f"{path}\n", ""))
        return path.read_bytes()

    def curves(self, *arguments, server=NOWHERE):
        """Values by law and restitution asked for."""
        rows = csv.reader(self.plot(*arguments, file="a.csv", server=server).decode().splitlines())
        curves = {}
        for name, x, y in rows:
            if name not in ("curve", ""):
                curves.setdefault(name, {})[round(float(x), 6)] = float(y)
        return curves

    def closed_laws(self):
        laws = json.loads(self.run_it("model", "list", "-o", "json")[0])
        return [law["law"] for law in laws if law["closed_form"]]

    def test_every_law_with_a_closed_form_is_drawn_without_a_server(self):
        for what in ("alpha", "restitution"):
            self.assertEqual(list(self.curves(what)), self.closed_laws())
            svg = self.plot(what).decode()
            for law in self.closed_laws():
                self.assertIn(law, svg)

    def test_alpha_is_that_of_the_formula(self):
        curves = self.curves("alpha", "hu-guo", "paper-eq23")
        self.assertEqual(list(curves), ["HU_GUO", "PAPER_EQ23"])
        self.assertAlmostEqual(curves["HU_GUO"][0.5], 1.5, delta=1e-12)
        self.assertAlmostEqual(curves["PAPER_EQ23"][0.5], 1.4112832524024523, delta=1e-9)

    def test_restitution_is_the_one_that_compare_tells(self):
        told = json.loads(self.run_it("model", "compare", "flores", "exact", "--restitution",
                                      "0.3,0.9", "-o", "json")[0])
        curves = self.curves("restitution", "flores", "exact")
        for point in told:
            self.assertAlmostEqual(curves[point["law"]][point["requested"]], point["delivered"],
                                   delta=1e-12)

    def test_law_without_a_closed_form_is_run(self):
        law = next(law["law"] for law in json.loads(self.run_it("model", "list", "-o", "json")[0])
                   if not law["closed_form"])
        server = f"127.0.0.1:{self.server.port}"
        delivered = self.curves("restitution", law, server=server)[law]
        self.assertEqual(len(delivered), 96)
        self.assertIn("is a function of ε alone", self.plot("alpha", law, code=2))

    def test_forms_are_those_of_plot(self):
        for form, start in (("png", b"\x89PNG"), ("pdf", b"%PDF"), ("pgf", b"%% Creator"),
                            ("eps", b"%!PS")):
            drawn = self.plot("alpha", file=f"a.{form}")
            self.assertTrue(drawn.startswith(start), drawn[:40])
            self.assertEqual(self.plot("alpha", file=f"a.{form}"), drawn)
        printed, _ = self.run_it("model", "plot", "alpha", "-o", "txt", server=NOWHERE)
        self.assertEqual(printed.splitlines()[0].strip(), "Coefficient α of the damping factor")
        run = subprocess.run(self.command("model", "plot", "restitution"), cwd=self.folder,
                             capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual(run.stdout, "restitution.svg\n", run.stderr)

    def test_wrong_uses_are_told(self):
        self.assertIn("did you mean 'HU_GUO'?", self.plot("alpha", "hu-gua", code=2))
        self.plot("beta", code=2)
        self.assertIn("/nowhere/a.svg: No such file",
                      self.run_it("model", "plot", "alpha", "-f", "/nowhere/a.svg", code=11)[1])
        self.run_it("model", "plot", "alpha", "-o", "json", code=2)


if __name__ == "__main__":
    unittest.main()
