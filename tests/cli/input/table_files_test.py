"""Tables of loads and motions in files: the server solves the same however they are written."""

import json
import math
import time
import unittest

from cli_case import CliTest

RAMP = [(0.0, 0.0), (0.5, 40.0), (1.5, 90.5), (2.0, 12.25), (20.0, 12.25)]  # In ms and N.


def rows(table, separator=",", decimal="."):
    return "".join(f"{t}{separator}{f}\n".replace(".", decimal) for t, f in table)


class TableFilesTest(CliTest):

    def solve(self, table, end=0.02, kind="loads", **more):
        """The job of a ball before a wall under a table, without what differs from job to job."""
        ball = {"name": "B", "mass_kg": 0.5, "radius_m": 0.05, "position_m": -0.0501}
        scenario = {"bodies": [ball], "end_time_s": end, **more}
        if kind == "loads":
            scenario["loads"] = [{"body": "B", **table}]
            scenario["contacts"] = [{"between": ["B"], "stiffness": 1e8, "restitution": 0.7,
                                     "wall": {"side": "RIGHT"}}]
        path = self.folder / "s.json"
        path.write_text(json.dumps(scenario))
        self.job = json.loads(self.run_it("run", path, "-o", "json", code=None)[0])
        return self.job

    def numbers(self, table):
        """Trajectory and ledger as bytes."""
        job = self.solve({"table": table})
        samples = self.run_it("export", job["name"], "-o", "csv")[0]
        return samples, json.dumps(job["cycles"]), json.dumps(job["final_bodies"])

    def write(self, content):
        (self.folder / "m.csv").write_bytes(content if isinstance(content, bytes)
                                            else content.encode())

    def test_points_lists_and_files_of_each_dialect_give_the_same_bytes(self):
        times, forces = [t / 1000 for t, _ in RAMP], [f for _, f in RAMP]
        points = [{"time_s": t, "force_n": f} for t, f in zip(times, forces)]
        expected = self.numbers({"points": points})
        self.assertGreater(len(json.loads(expected[1])), 0, "the ball hits the wall")
        self.assertEqual(self.numbers({"times_s": times, "forces_n": forces}), expected)
        headers = "t [ms],F [N]\n"
        for content in (
                headers + rows(RAMP), headers.replace(",", ";") + rows(RAMP, ";", ","),
                headers.replace(",", "\t") + rows(RAMP, "\t"),
                headers.replace(",", "   ") + rows(RAMP, "   "),
                "Logger\nRate;2\nTime;Force\nms;N\n" + rows(RAMP, ";", ","),
                (headers + rows(RAMP)).replace("\n", "\r\n"),
                b"\xff\xfe" + (headers + rows(RAMP)).encode("utf-16-le"),
                b"\xef\xbb\xbf" + (headers + rows(RAMP)).encode()):
            self.write(content)
            self.assertEqual(self.numbers({"file": "m.csv"}), expected, content)

    def test_sampled_sine_is_a_sine_to_the_order_of_interpolation(self):
        amplitude, frequency, end = 30.0, 50.0, 0.0937

        def final(load):
            job = self.solve(load, end, kind="free", loads=[{"body": "B", **load}])
            return float(job["final_bodies"][0]["velocity_m_per_s"])

        exact = final({"sine": {"amplitude_n": amplitude, "frequency_hz": frequency}})
        self.assertGreater(abs(exact), 0.01)

        def miss(count):
            period = 1 / frequency
            table = [(period * i / count, amplitude * math.sin(2 * math.pi * i / count))
                     for i in range(count + 1)]
            self.write("t [s],F [N]\n" + "".join(f"{t!r},{f!r}\n" for t, f in table))
            return abs(final({"table": {"file": "m.csv", "period_s": period}}) - exact)

        self.assertAlmostEqual(math.log2(miss(50) / miss(100)), 2, delta=0.05)
        self.assertLess(miss(1000), 5e-6 * abs(exact))

    def test_hundred_thousand_rows_take_steps_that_do_not_look_at_all(self):
        def seconds(count):
            self.write("t [us],F [N]\n" + "".join(f"{i},{i % 7}\n" for i in range(count)))
            start = time.monotonic()
            job = self.solve({"table": {"file": "m.csv"}}, count * 1e-6,
                             output={"ledger_only": True})
            self.assertGreaterEqual(int(job["summary"]["steps"]), count - 1)
            return time.monotonic() - start

        short, long = seconds(10_000), seconds(100_000)
        print(f"10,000 rows in {short:.2f} s, 100,000 in {long:.2f} s")
        self.assertLess(long, 30 * max(short, 0.5))

    def test_compare_reads_the_same_files(self):
        job = self.solve({"table": {"times_s": [0, 1], "forces_n": [50, 50]}})["name"]
        text = self.run_it("export", job, "-o", "csv", "--channels", "B.velocity", "--every", 7)[0]
        lines = text.splitlines()[1:]
        table = [tuple(float(x) for x in line.split(",")) for line in lines]
        self.write(b"\xff\xfe" + ("Logger\n\nTime;B.velocity\nms;mm/s\n" + rows(
            [(t * 1000, v * 1000) for t, v in table], ";", ",")).encode("utf-16-le"))
        self.run_it("compare", job, self.folder / "m.csv", "--rel", "1e-9")

    def test_mistakes_have_the_line_of_the_file(self):
        self.write("t [s],F [kN]\n0,1\n1,nan\n1,2\n")
        path = self.folder / "s.yaml"
        path.write_text("bodies: [{name: B, mass_kg: 1}]\nend_time_s: 1\n"
                        "loads: [{body: B, table: {file: m.csv}}]\n")
        said = self.run_it("validate", path, code=3)
        self.assertIn(f"{self.folder}/m.csv:3:3: loads[0].table: is nan", "".join(said))


if __name__ == "__main__":
    unittest.main()
