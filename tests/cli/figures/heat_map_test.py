"""Heat maps of a sweep: scales of colour, lines of equal value, and the verb that draws them."""

import collections
import re
import unittest

from cli_case import CHAIN, CliTest

METRIC = "final_bodies[B1].velocity_m_per_s"
WHITE = re.compile(r"stroke='rgb\(255, *255, *255\)'\s+d='M")


class HeatMapTest(CliTest):

    def sweep(self, masses, restitutions, metric=METRIC):
        return self.run_it("sweep", "run", CHAIN, "--grid", f"bodies[1].mass_kg={masses}",
                           "--grid", f"contacts[*].restitution={restitutions}", "--metric", metric,
                           "-o", "name", code=None)[0].strip()

    def cells(self, job):
        rows = [line.split(",") for line in
                self.run_it("sweep", "export", job, "-o", "csv")[0].splitlines()[1:]]
        return [(float(row[3]), row[5]) for row in rows]

    def draw(self, job, file, *flags, code=0):
        path = self.folder / file
        printed, said = self.run_it("sweep", "heatmap", job, "-o", path, *flags, code=code)
        if code != 0:
            return said
        self.assertEqual((printed, said), ("", f"{path}\n"))
        return path.read_bytes()

    def test_file_is_the_one_that_export_draws(self):
        job = self.sweep("0.5:4:4", "0.3:0.9:4")
        other = self.folder / "other.svg"
        for flags in ((), ("--scale", "log"), ("--contour",), ("--metric", METRIC)):
            drawn = self.draw(job, "map.svg", *flags)
            self.assertIn(b"</svg>", drawn)
            self.assertEqual(self.draw(job, "map.svg", *flags), drawn)
            self.run_it("sweep", "export", job, "--heatmap", other, *flags)
            self.assertEqual(other.read_bytes(), drawn)
        for form, start in (("png", b"\x89PNG"), ("pdf", b"%PDF"), ("tex", b"% title")):
            self.assertTrue(self.draw(job, f"map.{form}", "--contour").startswith(start), form)

    def test_without_a_file_it_is_printed(self):
        job = self.sweep("0.5:4:4", "0.3:0.9:4")
        printed, _ = self.run_it("sweep", "heatmap", job)
        self.assertTrue(printed.startswith(f"{METRIC} over bodies[1].mass_kg (down)"), printed)
        self.assertIn(printed, self.run_it("sweep", "watch", job)[0])

    def test_sweep_over_one_axis_is_a_line(self):
        job = self.run_it("sweep", "run", CHAIN, "--grid", "contacts[*].restitution=0.5:0.9:5",
                          "--metric", METRIC, "--heatmap", self.folder / "run.svg", "-o",
                          "name")[0].strip()
        drawn = self.draw(job, "line.svg")
        self.assertEqual((self.folder / "run.svg").read_bytes(), drawn)
        for text in (b"restitution of all contacts [1]", b"final velocity of B1"):
            self.assertIn(text, drawn)
        rows = self.draw(job, "line.csv").decode().splitlines()[1:]
        self.assertEqual([round(float(row.split(",")[1]), 9) for row in rows],
                         [0.5, 0.6, 0.7, 0.8, 0.9])
        printed, said = self.run_it("sweep", "plot", job)
        self.assertIn("final velocity of B1", printed)
        self.assertEqual(said, "")

    def test_values_without_logarithm_are_told_and_have_no_colour(self):
        job = self.sweep("0.3:4:6", "0.3:0.9:4")
        negative = sum(value <= 0 for value, _ in self.cells(job))
        self.assertIn(negative, range(1, 24))
        svg = self.draw(job, "map.svg", "--scale", "log").decode()
        self.assertIn(f"white: {negative} values &lt;= 0", svg)
        linear = self.draw(job, "map.svg").decode()
        self.assertNotIn("&lt;= 0", linear)
        numbers = re.compile(r"<text>-?[0-9.e-]+</text>")
        self.assertLess(len(numbers.findall(svg)), len(numbers.findall(linear)))  # In the cells.
        printed, _ = self.run_it("sweep", "heatmap", job, "--scale", "log")
        self.assertEqual(printed.count("--") - 1, negative)  # One stands in the legend.
        self.assertIn(f"log scale;  ! not converged, ×× failed, -- no value ({negative} are <= 0)",
                      printed)

    def labels(self, svg):
        """The numbers that stand in the figure, each as often as it does."""
        return collections.Counter(re.findall(r"<text>(-?[0-9.e-]+)</text>", svg.decode()))

    def test_lines_of_equal_value_are_labelled_with_values_of_the_map(self):
        job = self.sweep("0.5:4:12", "0.3:0.9:12", "cycles[B1-B2].alpha")
        values = [value for value, _ in self.cells(job)]
        for scale, levels in (("linear", ("1", "2")), ("log", ("0.5", "1", "2"))):
            self.assertTrue(all(min(values) < float(level) < max(values) for level in levels))
            plain = self.labels(self.draw(job, "map.svg", "--scale", scale))
            lined = self.labels(self.draw(job, "map.svg", "--contour", "--scale", scale))
            for level in levels:
                self.assertGreater(lined[level], plain[level], f"{level} {scale}")

    def test_cells_that_did_not_converge_have_no_lines(self):
        base = CHAIN.read_text().replace("\n", "\n  ")
        path = self.folder / "sweep.yaml"
        lines = []
        for few in (50, 1):  # Passes of the first two columns.
            path.write_text(f"base:\n  {base}\naxes:\n"
                            "- {field: 'bodies[1].mass_kg', values: [0.5, 1, 2, 4]}\n"
                            f"- {{field: 'solver.max_iterations', values: [{few}, {few + 1}, 60]}}\n"
                            "metrics: ['final_bodies[B3].velocity_m_per_s']\n")
            job = self.run_it("sweep", "run", path, "-o", "name", code=None)[0].strip()
            svg = self.draw(job, "map.svg", "--contour").decode()
            lines.append(len(WHITE.findall(svg)))
        self.assertGreater(lines[0], 0)
        self.assertEqual(lines[1], 0)  # One column alone has nothing to lie between.

    def test_map_of_one_value_has_no_lines_and_no_complaints(self):
        job = self.run_it("sweep", "run", CHAIN, "--grid", "bodies[0].velocity_m_per_s=0.1,0.2",
                          "--grid", "contacts[*].restitution=0.7,0.8", "--metric", "convergence",
                          "-o", "name")[0].strip()
        for scale in ("linear", "log"):
            self.assertIn(b"</svg>", self.draw(job, "map.svg", "--contour", "--scale", scale))

    def test_what_cannot_be_drawn_is_told(self):
        job = self.sweep("0.5:4:3", "0.3:0.9:3")
        self.assertIn("none of this name", self.draw(job, "a.svg", "--metric", "x", code=2))
        self.assertIn("svg, png, pdf or tex", self.draw(job, "a.csv", code=2))
        run = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        self.assertIn("is no sweep", self.draw(run, "a.svg", code=2))
        self.assertIn("/nowhere/a.svg: No such file",
                      self.run_it("sweep", "heatmap", job, "-o", "/nowhere/a.svg", code=11)[1])
        self.run_it("sweep", "heatmap", job, "--scale", "cubic", code=2)


if __name__ == "__main__":
    unittest.main()
