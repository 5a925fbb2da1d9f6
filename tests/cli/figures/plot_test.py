"""contactctl plot: figures of a run, drawn by gnuplot."""

import csv
import os
import re
import subprocess
import unittest

import numpy as np
from PIL import Image
from cli_case import CHAIN, SCENARIOS, SPRING, CliTest
from contact.v1 import job_pb2
from contactd import PATIENCE_S

PRESETS = ("position", "displacement", "velocity", "force", "deformation-velocity", "hysteresis",
           "restitution", "iterations", "energy")
UNDAMPED = "glass-balls", "iterations"  # Its μ is 0 without a search.


class PlotTest(CliTest):

    def setUp(self):
        super().setUp()
        self.name = self.submit(CHAIN)
        self.job = self.server.get(self.name)

    def submit(self, scenario, *flags):
        return self.run_it("run", scenario, *flags, "-o", "name")[0].strip()

    def plot(self, preset, file, *flags, name=None, code=0):
        path = self.folder / file
        printed, said = self.run_it("plot", name or self.name, preset, "-f", path, *flags,
                                    code=code)
        if code == 0:
            self.assertEqual((printed, said), (f"{path}\n", ""))
        return path.read_bytes() if code == 0 else said

    def curves(self, preset):
        """Points by name of curve."""
        rows = list(csv.reader(self.plot(preset, "data.csv").decode().splitlines()))
        curves = {}
        for name, x, y in rows:
            if name != "curve":
                curves.setdefault(name, []).append((float(x), float(y)))
        return {name: np.array(points) for name, points in curves.items()}

    def test_every_preset_draws_every_shipped_scenario_in_silence(self):
        for scenario in sorted(set(SCENARIOS.glob("*.yaml")) - set(SCENARIOS.glob("*-sweep.yaml"))):
            name = self.submit(scenario)
            for preset in PRESETS:
                with self.subTest(f"{scenario.stem} {preset}"):
                    if (scenario.stem, preset) == UNDAMPED:
                        said = self.plot(preset, "plot.svg", name=name, code=2)
                        self.assertIn("iterated nothing", said)
                        continue
                    self.assertIn(b"</svg>", self.plot(preset, "plot.svg", name=name))

    def test_format_is_that_of_the_file_or_of_the_flag(self):
        self.assertTrue(self.plot("force", "a.png").startswith(b"\x89PNG"))
        self.assertTrue(self.plot("force", "a.pdf").startswith(b"%PDF"))
        self.assertTrue(self.plot("force", "a.dat", "-o", "png").startswith(b"\x89PNG"))
        self.assertTrue(self.plot("force", "a.csv").startswith(b"curve,time [s],force [N]"))

    def test_same_run_gives_the_same_figure(self):
        for form in ("svg", "png", "pdf"):
            first = self.plot("hysteresis", f"same.{form}")
            self.assertEqual(self.plot("hysteresis", f"same.{form}"), first, form)
            for instant in (b"/CreationDate", b"tIME"):
                self.assertNotIn(instant, first)

    def test_script_draws_the_figure_without_us(self):
        drawn = self.plot("force", "alone.svg")
        (self.folder / "alone.svg").unlink()
        self.plot("force", "alone.gp")
        subprocess.run(["gnuplot", "-d", self.folder / "alone.gp"], check=True,
                       timeout=PATIENCE_S)
        def drawing_of(svg):
            return svg[svg.index(b"</desc>"):]
        self.assertEqual(drawing_of((self.folder / "alone.svg").read_bytes()), drawing_of(drawn))

    def test_script_and_data_are_kept_on_request(self):
        keep = self.folder / "new" / "kept"
        self.plot("energy", "e.png", "--keep", keep)
        self.assertEqual({path.name for path in keep.iterdir()},
                         {"energy.gp", "energy.csv"})

    def test_every_figure_tells_where_it_comes_from(self):
        svg = self.plot("force", "a.svg").decode()
        script = self.plot("force", "a.gp").decode()
        source = {"title": "Triple-ball chain", "job": self.name,
                  "scenario_sha256": self.job.spec_sha256, "version": self.job.server_version,
                  "revision": self.job.server_revision}
        described = re.search("<desc>(.*?)</desc>", svg, re.DOTALL)[1].splitlines()
        self.assertEqual(described, [f"{name}: {value}" for name, value in source.items()])
        self.assertEqual(script.splitlines()[:5], [f"# {line}" for line in described])
        self.assertIn("<title>Triple-ball chain</title>", svg)
        self.plot("force", "a.png")
        png = Image.open(self.folder / "a.png").text
        self.assertEqual((png["Title"], png["Description"].splitlines()),
                         ("Triple-ball chain", described))
        self.plot("force", "a.pdf")
        pdf = subprocess.run(["pdfinfo", self.folder / "a.pdf"], check=True, text=True,
                             capture_output=True, timeout=PATIENCE_S).stdout
        self.assertIn("Title:           Triple-ball chain\n", pdf)
        for line in described:
            self.assertIn(line, pdf)
        self.assertIn(f"{self.name} ({self.job.spec_sha256[:12]}), contactd ", svg)

    def test_heat_maps_tell_where_they_come_from_too(self):
        sweep = self.run_it("sweep", "run", SCENARIOS / "table-3-sweep.yaml", "-o", "name")[0]
        sha256 = self.server.get(sweep.strip()).spec_sha256
        for form in ("svg", "png", "pdf"):
            path = self.folder / f"map.{form}"
            self.run_it("sweep", "export", sweep.strip(), "--heatmap", path)
            told = (path.read_text("utf-8") if form == "svg" else
                    Image.open(path).text["Description"] if form == "png" else
                    subprocess.run(["pdfinfo", path], check=True, capture_output=True, text=True,
                                   timeout=PATIENCE_S).stdout)
            self.assertIn(f"scenario_sha256: {sha256}", told, form)

    def test_comments_of_a_script_stay_comments(self):
        name = self.submit(CHAIN, "--set", 'title="set output \'pwned\'"')
        self.plot("force", "t.gp", name=name)
        self.assertIn("# title: set output 'pwned'\n", (self.folder / "t.gp").read_text())

    def test_loops_have_the_area_of_the_energy_lost(self):
        curves = self.curves("hysteresis")
        for cycle in self.job.cycles:
            delta, force = curves[cycle.contact].T
            lost = cycle.work_compression_j + cycle.work_restitution_j
            self.assertAlmostEqual(np.trapz(force, delta), lost, delta=1e-3 * lost)

    def test_marks_stand_where_cycles_start_and_end(self):
        curves = self.curves("deformation-velocity")
        for c in self.job.cycles:
            np.testing.assert_array_equal(curves[f"{c.contact} starts"],
                                          [(c.start_time_s, c.approach_velocity_m_per_s)])
            np.testing.assert_array_equal(curves[f"{c.contact} ends"],
                                          [(c.end_time_s, c.separation_velocity_m_per_s)])

    def test_loops_go_from_end_to_end_as_the_ledger_says(self):
        self.name = self.submit(SPRING)
        job = self.server.get(self.name)
        curves = self.curves("hysteresis")
        law = job.scenario.contacts[0]
        for cycle in job.cycles:
            if cycle.end == job_pb2.Cycle.RUN_END:
                continue
            name = law.name or cycle.contact
            loop = curves[name if cycle.number == 1 else f"{name} #{cycle.number}"]
            for point, delta in ((loop[0], cycle.delta_start_m), (loop[-1], cycle.delta_end_m)):
                np.testing.assert_allclose(point, (delta, law.stiffness * delta ** 1.5),
                                           rtol=1e-9, atol=1e-12)

    def test_part_of_a_run_is_drawn_on_request(self):
        whole = self.curves("velocity")
        rows = self.plot("velocity", "part.csv", "--contacts", "B2-B3", "--from", "1e-3", "--to",
                         "2e-3").decode()
        self.assertNotIn("\nB1,", rows)
        times = [float(row.split(",")[-2]) for row in rows.splitlines() if row.startswith("B2,")]
        self.assertEqual((times[0], times[-1]), (1e-3, 2e-3))
        self.assertLess(len(times), len(whole["B2"]))
        self.assertIn("did you mean 'B1-B2'?",
                      self.plot("force", "x.svg", "--contacts", "B1-B4", code=2))
        self.assertIn("before", self.plot("force", "x.svg", "--from", "2", "--to", "1", code=2))

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
        plain = self.plot("force", "a.svg").decode()
        self.assertIn("time [ms]", plain)
        look = self.plot("force", "b.svg", "--size", "3x2", "--font", "Courier,9", "--no-title",
                         "--no-provenance", "--unit", "us,kN").decode()
        self.assertIn('width="300" height="200"', look)
        for seen, there in (("Courier", True), ("time [µs]", True), ("force [kN]", True),
                            ("<text>Triple-ball chain", False), (f"<text>{self.name}", False)):
            self.assertEqual(seen in look, there, seen)
        self.assertIn(f"job: {self.name}", look)  # In <desc>.
        paper = self.plot("velocity", "c.svg", "--style", "paper").decode()
        self.assertNotIn("<text>Triple-ball chain", paper)
        colours = set(re.findall(r"stroke='rgb\(([ 0-9]+), *([ 0-9]+), *([ 0-9]+)\)'", paper))
        self.assertTrue(all(len(set(map(int, colour))) == 1 for colour in colours), colours)
        script = self.plot("force", "d.gp", "--log").decode()
        self.assertIn("\nset logscale y\n", script)
        for wrong in (("--unit", "kg"), ("--size", "big"), ("--font", "'"), ("--style", "nice")):
            self.plot("force", "x.svg", *wrong, code=2)

    def test_output_takes_a_format_or_a_file(self):
        path = self.folder / "fig.pdf"
        self.assertEqual(self.run_it("plot", self.name, "force", "-o", path)[0], f"{path}\n")
        self.assertTrue(path.read_bytes().startswith(b"%PDF"))
        for flag in ("-o", "--output"):
            self.assertTrue(self.plot("force", "a.dat", flag, "png").startswith(b"\x89PNG"))
        said = self.run_it("plot", self.name, "force", "-o", "fig.jpg", code=2)[1]
        self.assertIn("fig.jpg is neither", said)
        self.assertIn(".svg, .png", said)
        self.assertIn("did you mean 'svg'?",
                      self.run_it("plot", self.name, "force", "-o", "svgg", code=2)[1])
        self.run_it("plot", self.name, "force", "-o", path, "-f", path, code=2)
        law = self.folder / "law.svg"
        self.run_it("model", "plot", "alpha", "-o", law)
        self.assertIn("</svg>", law.read_text("utf-8"))

    def test_many_contacts_are_legible(self):
        name = self.submit(self.row(40))
        for preset in ("force", "restitution", "velocity", "hysteresis"):
            svg = self.plot(preset, "row.svg", name=name).decode()
            left_out = re.findall(r"<text>(\d+) smaller</text>", svg)
            self.assertEqual(set(left_out), {"30" if preset == "velocity" else "29"}, preset)
            named = re.findall(r"<text>(C\d+|B\d+)</text>", svg)
            self.assertEqual(len(named), 10, preset)

    def row(self, balls):
        path = self.folder / "row.yaml"
        bodies = "".join(f"  - {{name: B{i}, mass_kg: 0.5, radius_m: 0.05, position_m: "
                         f"{0.1 * i:.1f}, velocity_m_per_s: {0.2 if i == 0 else 0}}}\n"
                         for i in range(balls))
        contacts = "".join(f"  - {{name: C{i}, between: [B{i}, B{i + 1}], stiffness: 1e8, "
                           "restitution: 0.9, damping: FLORES}\n" for i in range(balls - 1))
        path.write_text(f"bodies:\n{bodies}contacts:\n{contacts}end_time_s: 0.04\n")
        return path

    def test_loops_of_a_short_contact_are_smooth_without_many_samples(self):
        few = self.submit(SCENARIOS / "bouncing-ball.yaml", "--set", "output={}", "--set",
                          "output.samples_per_contact=100")
        self.name = few
        cycle = self.server.get(few).cycles[0]
        loop = self.curves("hysteresis")[cycle.contact]
        self.assertGreater(len(loop), 80)
        lost = cycle.work_compression_j + cycle.work_restitution_j
        self.assertAlmostEqual(np.trapz(loop[:, 1], loop[:, 0]), lost, delta=2e-3 * lost)

    def test_energy_ends_at_the_kinetic_energy_of_the_summary(self):
        total = self.curves("energy")["sum"][:, 1]
        self.assertAlmostEqual(total[0], 0.01, delta=1e-15)
        self.assertAlmostEqual(total[-1], self.job.summary.kinetic_energy_j, delta=1e-12)

    def test_energy_of_gravity_is_in_the_sum(self):
        self.name = self.submit(SCENARIOS / "bouncing-ball.yaml")
        curves = self.curves("energy")
        total = curves["sum"][:, 1]
        self.assertAlmostEqual(curves["constant loads"][0, 1], 0.5 * 9.81 * 1.0, delta=1e-12)
        falling = curves["sum"][:, 0] < 0.44  # Before the ball touches the floor.
        np.testing.assert_allclose(total[falling], total[0], rtol=1e-9)
        self.assertLess(np.diff(total).max(), 1e-6 * total[0])

    def test_cycles_between_samples_are_told_with_what_shows_them(self):
        name = self.submit(SCENARIOS / "bouncing-ball.yaml", "--set", "output={}")
        path = self.folder / "coarse.svg"
        said = self.run_it("plot", name, "force", "-f", path)[1]
        command = re.search("contactctl (run --like .*)", said)[1].split()
        self.assertRegex(said, "contact cycles have fewer than 10 samples")
        self.assertNotIn("μ/k", path.read_text())
        again = self.run_it(*command, "-o", "name")[0].strip()
        self.assertIn(b"\xce\xbc/k", self.plot("force", "fine.svg", name=again))

    def test_long_curves_are_drawn_thinned_and_kept_whole(self):
        name = self.submit(CHAIN, "--set", "output.sample_interval_s=1e-7")
        svg = self.plot("position", "long.svg", name=name)
        self.assertLess(len(svg), 400_000)  # Three curves of 40 000 samples.
        points = self.plot("position", "long.csv", name=name).splitlines()
        self.assertGreater(len(points), 120_000)

    def test_residual_falls_to_the_tolerance(self):
        points = self.curves("iterations")["B1-B2 #1"]
        passes = len(points) // 2  # μ, then the residual.
        self.assertEqual(points[passes - 1, 1], self.job.cycles[0].mu)
        self.assertLess(points[-1, 1], 2e-8)  # 2 ε² ξ

    def test_words_of_a_user_cannot_become_commands(self):
        title = "it's '; system \"touch pwned\" \\\" `touch pwned` $x @x {/Bold x}"
        name = self.submit(CHAIN, "--set", f"title={title}")
        svg = self.plot("force", "title.svg", name=name).decode()
        self.assertIn("touch pwned", svg)
        self.assertFalse(os.path.exists("pwned"))

    def test_what_cannot_be_drawn_is_told(self):
        name = self.submit(CHAIN, "--set", "output.ledger_only=true")
        self.assertIn("ledger_only", self.plot("force", "x.svg", name=name, code=2))
        self.assertIn("</svg>", self.plot("iterations", "x.svg", name=name).decode())
        self.assertIn("hysteresis", self.plot("histeresis", "x.svg", code=2))
        self.assertIn("/nowhere/x.svg: No such file",
                      self.run_it("plot", self.name, "force", "-f", "/nowhere/x.svg", code=11)[1])

    def test_what_gnuplot_says_is_repeated_without_the_path_of_a_file_that_is_gone(self):
        program = self.folder / "gnuplot"
        program.write_text('#!/bin/sh\necho "\\"$2\\" line 3: warning: odd" >&2\n')
        program.chmod(0o755)
        run = subprocess.run(self.command("plot", self.name, "force", "-f", self.folder / "x.svg"),
                             env={**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}"},
                             capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual((run.returncode, run.stderr), (0, "gnuplot: line 3: warning: odd\n"))

    def test_missing_gnuplot_is_told_with_what_to_do(self):
        run = subprocess.run(self.command("plot", self.name, "force", "-f", self.folder / "x.svg"),
                             env={**os.environ, "PATH": str(self.folder)}, capture_output=True,
                             text=True, timeout=PATIENCE_S)
        self.assertEqual(run.returncode, 11)
        self.assertIn("apt-get install gnuplot-nox", run.stderr)


if __name__ == "__main__":
    unittest.main()
