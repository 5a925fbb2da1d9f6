"""contactctl plot: its flags, files and exit codes; tests/python tests what contactsim draws."""

import csv
import math
import re
import subprocess
import unittest

import numpy as np
from cli_case import CHAIN, SCENARIOS, CliTest
from contactd import PATIENCE_S
from contactsim.figures.look import PRINT


class PlotTest(CliTest):

    def setUp(self):
        super().setUp()
        self.name = self.submit(CHAIN)

    def submit(self, scenario, *flags):
        return self.run_it("run", scenario, *flags, "-o", "name")[0].strip()

    def plot(self, preset, file, *flags, name=None, code=0):
        path = self.folder / file
        printed, said = self.run_it("plot", name or self.name, preset, "-f", path, *flags,
                                    code=code)
        if code == 0:
            self.assertEqual((printed, said), (f"{path}\n", ""))
        return path.read_bytes() if code == 0 else said

    def test_format_is_that_of_the_file_or_of_the_flag(self):
        self.assertTrue(self.plot("force", "a.png").startswith(b"\x89PNG"))
        self.assertTrue(self.plot("force", "a.dat", "-o", "pdf").startswith(b"%PDF"))
        self.assertTrue(self.plot("force", "a.csv").startswith(b"curve,time [s],force [N]"))
        path = self.folder / "fig.pgf"
        self.assertEqual(self.run_it("plot", self.name, "force", "-o", path)[0], f"{path}\n")
        self.assertIn("pgfpicture", path.read_text("utf-8"))
        run = subprocess.run(self.command("plot", self.name, "force", "-o", "eps"),
                             cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual((run.returncode, run.stdout), (0, "force.eps\n"), run.stderr)

    def test_output_that_is_neither_format_nor_file_is_refused(self):
        said = self.run_it("plot", self.name, "force", "-o", "fig.jpg", code=2)[1]
        self.assertIn("fig.jpg is neither", said)
        self.assertIn(".svg, .png", said)
        self.assertIn("did you mean 'svg'?",
                      self.run_it("plot", self.name, "force", "-o", "svgg", code=2)[1])
        self.run_it("plot", self.name, "force", "-o", "a.pdf", "-f", "a.pdf", code=2)

    def test_data_and_a_script_that_draws_them_are_kept_on_request(self):
        keep = self.folder / "new" / "kept"
        self.plot("energy", "e.csv", "--keep", keep)
        self.assertEqual({path.name for path in keep.iterdir()}, {"energy.py", "energy.csv"})
        subprocess.run(["/usr/bin/python3", "energy.py"], cwd=keep, check=True, timeout=PATIENCE_S,
                       env={"MPLBACKEND": "Agg"})
        self.assertIn(b"</svg>", (keep / "energy.svg").read_bytes())

    def test_part_of_a_run_is_drawn_on_request(self):
        rows = self.plot("velocity", "part.csv", "--contacts", "B2-B3", "--from", "1e-3", "--to",
                         "2e-3").decode()
        self.assertNotIn("\nB1,", rows)
        times = [float(row.split(",")[-2]) for row in rows.splitlines() if row.startswith("B2,")]
        self.assertEqual((times[0], times[-1]), (1e-3, 2e-3))
        self.assertIn("did you mean 'B1-B2'?",
                      self.plot("force", "x.svg", "--contacts", "B1-B4", code=2))
        self.assertIn("before", self.plot("force", "x.svg", "--from", "2", "--to", "1", code=2))
        self.plot("force", "x.svg", "--from", "soon", code=2)

    def test_channels_are_drawn_instead_of_a_preset(self):
        path = self.folder / "channels.csv"
        self.run_it("plot", self.name, "--channels", "B1.velocity,B1-B2.contact_force", "-f", path)
        text = path.read_text("utf-8")
        self.assertIn("curve,time [s],velocity [m/s]\nB1.velocity,0,", text)
        self.assertIn("curve,time [s],contact force [N]\nB1-B2.contact_force,0,", text)
        self.assertIn("did you mean 'B1.velocity'?",
                      self.run_it("plot", self.name, "--channels", "B1.velocty", code=2)[1])
        self.assertIn("do not go together",
                      self.run_it("plot", self.name, "force", "--channels", "B1.velocity",
                                  code=2)[1])
        self.assertIn("say what to draw", self.run_it("plot", self.name, code=2)[1])

    def test_figure_looks_as_it_is_asked_to(self):
        look = self.plot("force", "b.svg", "--size", "3x2", "--font", "Courier,9", "--no-title",
                         "--no-provenance", "--unit", "us,kN", "--style", "paper").decode()
        for seen in ('width="216pt" height="144pt"', "Courier", "time [µs]", "force [kN]"):
            self.assertIn(seen, look)
        for wrong in (("--unit", "kg"), ("--size", "big"), ("--font", "'"), ("--style", "nice")):
            self.plot("force", "x.svg", *wrong, code=2)

    def test_styles_for_print_are_those_of_contactsim(self):
        for style, (inches, _, _) in PRINT.items():
            width = float(re.search(r'<svg [^>]*width="([0-9.]+)pt"',
                                    self.plot("force", "s.svg", "--style", style).decode())[1])
            self.assertAlmostEqual(width, 72 * inches, places=4)

    def test_several_presets_are_panels_with_letters_of_one_figure(self):
        run = subprocess.run(self.command("plot", self.name, "force", "hysteresis"),
                             cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual((run.returncode, run.stdout), (0, "force-hysteresis.svg\n"), run.stderr)
        drawn = (self.folder / "force-hysteresis.svg").read_text("utf-8")
        self.assertEqual(re.findall(r">\(([a-z])\)</text>", drawn), ["a", "b"])
        self.assertIn("did you mean 'energy'?", self.plot("force", "x.svg", "enrgy", code=2))

    def test_loops_of_a_short_contact_are_smooth_without_many_samples(self):
        few = self.submit(SCENARIOS / "bouncing-ball.yaml", "--set", "output={}", "--set",
                          "output.samples_per_contact=100")
        cycle = self.server.get(few).cycles[0]
        rows = csv.reader(self.plot("hysteresis", "loop.csv", name=few).decode().splitlines())
        loop = np.array([(float(x), float(y)) for name, x, y in rows if name == cycle.contact])
        self.assertGreater(len(loop), 80)
        lost = cycle.work_compression_j + cycle.work_restitution_j
        self.assertAlmostEqual(np.trapz(loop[:, 1], loop[:, 0]), lost, delta=2e-3 * lost)

    def test_a_swing_seen_once_in_its_period_is_drawn_with_its_amplitude(self):
        scenario = self.folder / "swing.yaml"  # 2000 rad/s; a sample is taken each π/1000 s.
        scenario.write_text("bodies: [{name: ball, mass_kg: 0.5, position_m: 0.001}]\n"
                            "supports: [{body: ball, stiffness_n_per_m: 2.0e6}]\n"
                            f"end_time_s: {math.pi / 10}\noutput: {{sample_interval_s: {math.pi / 1000}}}\n")
        name = self.submit(scenario)
        rows = list(csv.reader(self.plot("position", "swing.csv", name=name).decode().splitlines()))
        swing = np.array([(float(x), float(y)) for label, x, y in rows if label == "ball"])
        for start in np.arange(100) * math.pi / 1000:
            seen = swing[(swing[:, 0] >= start - 1e-9) & (swing[:, 0] <= start + math.pi / 1000 + 1e-9), 1]
            np.testing.assert_allclose([seen.min(), seen.max()], [-1e-3, 1e-3], rtol=1e-6)

    def test_cycles_between_samples_are_told_with_what_shows_them(self):
        name = self.submit(SCENARIOS / "bouncing-ball.yaml", "--set", "output={}", "--set",
                           "output.samples_per_contact=0")
        path = self.folder / "coarse.svg"
        said = self.run_it("plot", name, "force", "-f", path)[1]
        command = re.search("contactctl (run --like .*)", said)[1].split()
        self.assertRegex(said, "contact cycles have fewer than 10 samples")
        self.assertNotIn("μ/k", path.read_text("utf-8"))
        again = self.run_it(*command, "-o", "name")[0].strip()
        self.assertIn("μ/k", self.plot("force", "fine.svg", name=again).decode())

    def test_long_curves_are_drawn_thinned_and_kept_whole(self):
        name = self.submit(CHAIN, "--set", "output.sample_interval_s=1e-7")
        svg = self.plot("position", "long.svg", name=name)
        self.assertLess(len(svg), 400_000)  # Three curves of 40 000 samples.
        points = self.plot("position", "long.csv", name=name).splitlines()
        self.assertGreater(len(points), 120_000)

    def test_job_that_failed_is_drawn(self):
        failed = self.run_it("run", CHAIN, "--set", "solver.max_iterations=1", "--set",
                             "solver.on_not_converged=FAIL", "-o", "name", code=1)[0].strip()
        self.assertIn(b"B1-B2 #1", self.plot("iterations", "failed.csv", name=failed))

    def test_what_cannot_be_drawn_is_told(self):
        name = self.submit(CHAIN, "--set", "output.ledger_only=true")
        self.assertIn("ledger_only", self.plot("force", "x.svg", name=name, code=2))
        self.assertIn("hysteresis", self.plot("histeresis", "x.svg", code=2))
        self.assertIn("/nowhere/x.svg: No such file",
                      self.run_it("plot", self.name, "force", "-f", "/nowhere/x.svg", code=11)[1])
        self.run_it("plot", "0000000000", "force", code=6)


if __name__ == "__main__":
    unittest.main()
