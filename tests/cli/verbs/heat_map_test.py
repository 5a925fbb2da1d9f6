"""Heat maps of a sweep: the verbs that draw them; tests/python/maps_test.py tests what is drawn."""

import unittest

from cli_case import CHAIN, CliTest

METRIC = "final_bodies[B1].velocity_m_per_s"


class HeatMapTest(CliTest):

    def sweep(self, masses, restitutions, metric=METRIC):
        return self.run_it("sweep", "run", CHAIN, "--grid", f"bodies[1].mass_kg={masses}",
                           "--grid", f"contacts[*].restitution={restitutions}", "--metric", metric,
                           "-o", "name", code=None)[0].strip()

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
        flags = ("--scale", "log", "--contour", "--metric", METRIC)
        drawn = self.draw(job, "map.svg", *flags)
        self.assertIn(b"</svg>", drawn)
        self.run_it("sweep", "export", job, "--heatmap", other, *flags)
        self.assertEqual(other.read_bytes(), drawn)
        self.assertIn(f"scenario_sha256: {self.server.get(job).spec_sha256}".encode(), drawn)
        for form, start in (("png", b"\x89PNG"), ("pgf", b"% title")):
            self.assertTrue(self.draw(job, f"map.{form}", "--contour").startswith(start), form)

    def test_without_a_file_it_is_printed(self):
        job = self.sweep("0.5:4:4", "0.3:0.9:4")
        printed, _ = self.run_it("sweep", "heatmap", job)
        self.assertTrue(printed.startswith(f"{METRIC} over bodies[1].mass_kg (down)"), printed)
        self.assertIn(printed, self.run_it("sweep", "watch", job)[0])

    def test_values_without_logarithm_are_told(self):
        job = self.sweep("0.3:4:6", "0.3:0.9:4")
        rows = [line.split(",") for line in
                self.run_it("sweep", "export", job, "-o", "csv")[0].splitlines()[1:]]
        negative = sum(float(row[3]) <= 0 for row in rows)
        self.assertIn(negative, range(1, 24))
        svg = self.draw(job, "map.svg", "--scale", "log").decode()
        self.assertIn(f"white: {negative} values &lt;= 0", svg)
        printed, _ = self.run_it("sweep", "heatmap", job, "--scale", "log")
        self.assertIn(f"log scale;  ! not converged, ×× failed, -- no value ({negative} are <= 0)",
                      printed)

    def test_sweep_over_one_axis_is_a_line(self):
        job = self.run_it("sweep", "run", CHAIN, "--grid", "contacts[*].restitution=0.5:0.9:5",
                          "--metric", METRIC, "--heatmap", self.folder / "run.svg", "-o",
                          "name")[0].strip()
        for text in (b"restitution of all contacts [1]", b"final velocity of B1"):
            self.assertIn(text, (self.folder / "run.svg").read_bytes())
        rows = self.draw(job, "line.csv").decode().splitlines()[1:]
        self.assertEqual([round(float(row.split(",")[1]), 9) for row in rows],
                         [0.5, 0.6, 0.7, 0.8, 0.9])
        printed, said = self.run_it("sweep", "plot", job)
        self.assertIn("final velocity of B1", printed)
        self.assertEqual(said, "")

    def test_what_cannot_be_drawn_is_told(self):
        job = self.sweep("0.5:4:3", "0.3:0.9:3")
        self.assertIn("none of this name", self.draw(job, "a.svg", "--metric", "x", code=2))
        self.assertIn("svg, png, pdf, eps or pgf", self.draw(job, "a.csv", code=2))
        run = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        self.assertIn("is no sweep", self.draw(run, "a.svg", code=2))
        self.assertIn("/nowhere/a.svg: No such file",
                      self.run_it("sweep", "heatmap", job, "-o", "/nowhere/a.svg", code=11)[1])
        self.run_it("sweep", "heatmap", job, "--scale", "cubic", code=2)


if __name__ == "__main__":
    unittest.main()
