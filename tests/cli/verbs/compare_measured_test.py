"""contactctl compare with a file of measured data."""

import csv
import io
import json
import unittest

from cli_case import CHAIN, SCENARIOS, CliTest

FORCE, VELOCITY = "B1-B2.contact_force", "B3.velocity"


class CompareMeasuredTest(CliTest):

    def setUp(self):
        super().setUp()
        self.job = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        text, _ = self.run_it("export", self.job, "-o", "csv", "--channels", f"{VELOCITY},{FORCE}",
                              "--every", 7)
        rows = list(csv.reader(io.StringIO(text)))
        self.assertEqual(rows[0], ["time [s]", f"{VELOCITY} [m/s]", f"{FORCE} [N]"])
        self.rows = [[float(value) for value in row] for row in rows[1:]]

    def measured(self, header, row, name="measured.csv"):
        """A file with a line for each sample, made by `row` of time, velocity and force."""
        path = self.folder / name
        lines = [header] + [",".join(repr(value) for value in row(*sample))
                            for sample in self.rows]
        path.write_text("\n".join(lines) + "\n", "utf-8")
        return path

    def compare(self, path, *flags, code=0):
        return self.run_it("compare", self.job, path, *flags, code=code)

    def test_run_is_its_own_measurement_in_other_units(self):
        path = self.measured(f"time [ms],{VELOCITY} [mm/s],{FORCE} [kN]",
                             lambda t, v, f: (t * 1e3, v * 1e3, f / 1e3))
        for names in ((self.job, path), (path, self.job)):
            text, _ = self.run_it("compare", *names, "--rel", "1e-9")
            self.assertIn("within tolerance", text)
        compared = json.loads(self.compare(path, "-o", "json")[0])
        self.assertTrue(compared["holds"])
        signals = {signal["name"]: signal for signal in compared["signals"]}
        self.assertEqual(set(signals), {VELOCITY, FORCE})
        self.assertEqual(signals[FORCE]["unit"], "N")
        self.assertEqual(signals[FORCE]["points"], len(self.rows))
        self.assertLess(signals[FORCE]["rms"], 1e-9)

    def test_signal_beyond_its_tolerance_has_exit_code_8(self):
        path = self.measured(f"time,{VELOCITY},{FORCE}", lambda t, v, f: (t, v, 1.1 * f))
        text, _ = self.compare(path, code=8)
        self.assertRegex(text, rf"{FORCE} \[N\].*DIFFERS")
        self.assertRegex(text, rf"{VELOCITY} \[m/s\].*ok")
        self.compare(path, "--rel", 0.1)
        self.compare(path, "--tolerance", f"{FORCE}=10%")
        self.compare(path, "--tolerance", f"{FORCE}=0.02 kN")
        self.compare(path, "--tolerance", f"{FORCE}=5 N", code=8)
        rows = list(csv.DictReader(io.StringIO(self.compare(path, "-o", "csv", code=8)[0])))
        self.assertEqual([row["verdict"] for row in rows], ["ok", "DIFFERS"])

    def test_late_clock_is_found(self):
        path = self.measured("t,force_N", lambda t, v, f: (t + 0.25, f))
        map_ = ("--map", f"force_N={FORCE.replace('contact_', '')}")
        self.assertIn("no measured point", self.compare(path, *map_, code=2)[1])
        self.compare(path, *map_, "--shift", -0.25)
        compared = json.loads(
            self.compare(path, *map_, "--fit-shift", "-0.255:-0.245", "-o", "json")[0])
        self.assertAlmostEqual(compared["shift_s"], -0.25, delta=1e-6)

    def test_measured_points_are_drawn_over_the_run(self):
        path = self.measured(f"time,{FORCE}", lambda t, v, f: (t, f))
        points = self.folder / "both.csv"
        _, said = self.compare(path, "--plot", points)
        self.assertEqual(said, f"{points}\n")
        rows = list(csv.reader(points.read_text("utf-8").splitlines()))
        self.assertEqual(rows[0], ["curve", "time [s]", "contact force of B1-B2 [N]"])
        self.assertEqual(sum(row[0] == str(path) for row in rows), len(self.rows))
        self.assertGreater(sum(row[0] == self.job for row in rows), len(self.rows))
        svg = self.folder / "both.svg"
        self.compare(path, "--plot", svg)
        self.assertIn("contact force of B1-B2 [N]", svg.read_text("utf-8"))

    def test_mistakes_are_told_with_what_there_is(self):
        path = self.measured("time,speed", lambda t, v, f: (t, v))
        self.assertIn("--map HEADER=CHANNEL joins them", self.compare(path, code=2)[1])
        said = self.compare(path, "--map", "speed=B3.velocty", code=2)[1]
        self.assertIn("did you mean 'B3.velocity'?", said)
        self.compare(path, "--map", "speed=B3.velocity", "--fit-shift", "1:0", code=2)
        self.compare(path, "--map", "speed=B3.velocity", "--shift", 0, "--fit-shift", "0:1", code=2)
        self.assertIn("left out, no channels: speed",
                      self.compare(self.measured("time,speed,B3.velocity",
                                                 lambda t, v, f: (t, 1, v)))[1])
        path.write_text("time,B3.velocity\n0,x\n")
        self.assertIn(f"{path}:2:3: expected a number, got 'x'", self.compare(path, code=3)[1])
        self.assertIn("goes with a file of measured data",
                      self.run_it("compare", self.job, self.job, "--shift", 1, code=2)[1])
        self.run_it("compare", self.job, self.job, path, code=2)

    def test_run_without_trajectory_is_told(self):
        path = self.measured(f"time,{FORCE}", lambda t, v, f: (t, f))
        bare = self.run_it("run", SCENARIOS / "two-balls.yaml", "--set", "output.ledger_only=true",
                           "-o", "name")[0].strip()
        self.assertIn("recorded no trajectory", self.run_it("compare", bare, path, code=2)[1])


if __name__ == "__main__":
    unittest.main()
