"""contactctl report: one page that needs nothing but itself."""

import html
import html.parser
import re
import unittest

import yaml
from cli_case import CHAIN, SPRING, CliTest
from contactsim.figures.living import SCRIPT


class Balanced(html.parser.HTMLParser):
    """Fails unless every element is closed in order; keeps links."""

    def __init__(self):
        super().__init__()
        self.open, self.links = [], []

    def handle_starttag(self, tag, attributes):
        if tag not in ("meta",):
            self.open.append(tag)
        self.links += [v for k, v in attributes if k in ("href", "src", "xlink:href")]

    def handle_startendtag(self, tag, attributes):
        self.links += [v for k, v in attributes if k in ("href", "src", "xlink:href")]

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, tag


class ReportTest(CliTest):

    def solve(self, scenario, *flags):
        return self.run_it("run", scenario, *flags, "-o", "name")[0].strip()

    def report(self, *jobs):
        path = self.folder / "report.html"
        _, said = self.run_it("report", *jobs, "-o", path)
        self.assertIn("opens offline", said)
        return path.read_text("utf-8")

    def check_is_offline(self, page):
        self.assertNotIn("http", page)
        self.assertEqual(page.count("<script"), page.count(SCRIPT))
        self.assertEqual(page.count(SCRIPT), 1)
        parser = Balanced()
        parser.feed(page)
        self.assertEqual(parser.open, [])
        for link in parser.links:
            self.assertTrue(link.startswith("#"), link)

    def test_one_run_with_everything(self):
        name = self.solve(CHAIN)
        page = self.report(name)
        self.check_is_offline(page)
        self.assertLess(len(page), 300_000)
        self.assertEqual(page.count("<svg"), 9)
        job = self.server.get(name)
        for words in ("Triple-ball chain", "CONVERGED", job.spec_sha256, job.server_version,
                      "2.259378e+08", "run --like " + name, "Momentum", "Iteration of μ",
                      "NEWTON_COUPLED"):
            self.assertIn(words, page)

    def test_the_scenario_inside_runs_again(self):
        name = self.solve(CHAIN)
        scenario = html.unescape(re.search(r"<h3>Scenario</h3>\n<pre>(.*?)</pre>",
                                           self.report(name), re.S)[1])
        self.assertEqual(yaml.safe_load(scenario)["title"], "Triple-ball chain")
        self.assertNotIn("UNSPECIFIED", scenario)
        path = self.folder / "scenario.yaml"
        path.write_text(scenario)
        again = self.server.get(self.solve(path))
        self.assertEqual(again.spec_sha256, self.server.get(name).spec_sha256)

    def test_long_run_is_thinned(self):
        page = self.report(self.solve(SPRING, "--set", "end_time_s=0.5"))
        self.check_is_offline(page)
        self.assertLess(len(page), 1_400_000)  # Of 25 000 samples with 160 cycles.

    def test_several_runs_are_compared(self):
        page = self.report(self.solve(CHAIN), self.solve(CHAIN, "--set", "title=<b>&"))
        self.check_is_offline(page)
        self.assertLess(page.index("<h2 id=\"differences"), page.index("<h2 id=\"run-"))
        self.assertEqual(page.count("<svg"), 19)  # One with both.
        self.assertIn("&lt;b&gt;&amp;", page)
        self.assertNotIn("<b>&", page)

    def test_run_without_trajectory_is_reported(self):
        name = self.solve(CHAIN, "--set", "output.ledger_only=true")
        self.assertEqual(self.report(name).count("<svg"), 2)

    def test_wrong_uses_are_told(self):
        self.run_it("report", "nix", code=6)
        self.run_it("report", code=2)
        name = self.solve(CHAIN)
        self.run_it("report", name, "-o", "/nowhere/r.html", code=11)


if __name__ == "__main__":
    unittest.main()
