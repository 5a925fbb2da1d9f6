"""Runs beside each other, and beside measured data, without a server."""

import pathlib
import tempfile
import unittest

import numpy as np
import pandas as pd
from contact.v1 import event_pb2, job_pb2, scenario_pb2
from contactsim import Result, compare, compare_measured
from contactsim.recording import Recording


def pulse(time):
    return 100 * np.exp(-((time - 0.5) / 0.05)**2)


def recorded():
    """A pulse of 100 N at 0.5 s, sampled every millisecond."""
    time = np.linspace(0, 1, 1001)
    chunk = event_pb2.FrameChunk(samples=1001)
    chunk.columns.add(name="time", unit="s", values=time.tobytes())
    chunk.columns.add(name="C.contact_force", unit="N", values=pulse(time).tobytes())
    recording = Recording()
    recording.add(event_pb2.Event(frame_chunk=chunk))
    return Result(job_pb2.Job(name="jobs/r"), recording)


def solved(name, mu=1.0, **fields):
    job = job_pb2.Job(name=name, state=job_pb2.Job.SUCCEEDED)
    job.cycles.add(contact="C", number=1, mu=mu, status=job_pb2.Cycle.CONVERGED)
    job.scenario.contacts.add(**fields)
    return Result(job, Recording())


class CompareTest(unittest.TestCase):

    def test_only_parameters_that_differ_are_told(self):
        compared = compare(solved("jobs/a", restitution=0.8, stiffness=1),
                           solved("jobs/b", restitution=0.7, stiffness=1, exponent=2))
        self.assertEqual(compared.parameters.to_dict("index"),
                         {"contacts[0].exponent": {"jobs/a": None, "jobs/b": 2.0},
                          "contacts[0].restitution": {"jobs/a": 0.8, "jobs/b": 0.7}})

    def test_tolerance_decides(self):
        first, second = solved("jobs/a"), solved("jobs/b", mu=1.001)
        self.assertFalse(compare(first, second))
        self.assertEqual(list(compare(first, second).differing.index), ["C #1 μ"])
        self.assertAlmostEqual(compare(first, second).results.deviation["C #1 μ"], 1e-3)
        self.assertTrue(compare(first, second, rel_tol=1e-2))
        self.assertTrue(compare(first, second, abs_tol=1e-2))

    def test_words_and_missing_results_differ(self):
        first, second = solved("jobs/a"), solved("jobs/b")
        second.job.cycles[0].status = job_pb2.Cycle.JUMP
        second.job.final_bodies.add(name="B")
        self.assertEqual(list(compare(first, second).differing.index),
                         ["C #1 status", "B final position", "B final velocity"])

    def test_what_a_run_cost_is_not_judged(self):
        first, second = solved("jobs/a"), solved("jobs/b")
        second.job.summary.steps = 99
        self.assertTrue(compare(first, second))
        self.assertEqual(compare(first, second).results["jobs/b"]["steps"], 99)

    def test_one_run_is_not_enough(self):
        self.assertRaises(TypeError, compare, solved("jobs/a"))


class CompareMeasuredTest(unittest.TestCase):

    def setUp(self):
        self.result = recorded()
        self.time = 0.3 + 1.01e-3 * np.arange(400)

    def frame(self, lag=0.0, error=0.0, header="C.contact_force [N]"):
        signs = np.where(np.arange(400) % 2 == 0, 1, -1)
        return pd.DataFrame({"time [s]": self.time - lag, header: pulse(self.time) + error * signs})

    def test_errors_are_those_that_were_made(self):
        compared = compare_measured(self.result, self.frame(error=2))
        row = compared.table.loc["C.contact_force"]
        self.assertAlmostEqual(row.rms, 2, delta=0.01)
        self.assertAlmostEqual(abs(row.largest), 2, delta=0.02)
        self.assertAlmostEqual(row.simulated_peak, 100, delta=1e-9)
        self.assertEqual((row.points, row.outside), (400, 0))
        self.assertTrue(compared)
        self.assertFalse(compare_measured(self.result, self.frame(error=2), rel_tol=0.01))
        self.assertTrue(compare_measured(self.result, self.frame(error=2), rel_tol=0.01,
                                         tolerances={"C.contact_force": 3}))

    def test_units_and_headers_are_read(self):
        for header, map_, scale in (("C.contact_force [kN]", None, 1e-3), ("F (kN)",
                                    {"F": "C.force"}, 1e-3), ("F", {"F": "C.force [kN]"}, 1e-3),
                                    ("F_kN", {"F_kN": "C.force"}, 1e-3), ("C.force", None, 1)):
            frame = self.frame(header=header)
            frame[header] *= scale
            frame["other"] = "words"
            compared = compare_measured(self.result, frame, map=map_, rel_tol=1e-3)
            self.assertTrue(compared, header)

    def test_late_clock_is_found(self):
        late = self.frame(lag=0.04, error=1)
        self.assertFalse(compare_measured(self.result, late))
        self.assertTrue(compare_measured(self.result, late, shift_s=0.04))
        found = compare_measured(self.result, late, fit_shift_s=(-0.1, 0.1))
        self.assertAlmostEqual(found.shift_s, 0.04, delta=1e-4)

    def test_file_and_indexed_frame_are_read_as_well(self):
        frame = self.frame()
        self.assertTrue(compare_measured(self.result, frame.set_index("time [s]"), rel_tol=1e-3))
        for separator in ",;\t":
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder) / "m.csv"
                path.write_text("# run 7\n" + frame.to_csv(index=False, sep=separator))
                self.assertTrue(compare_measured(self.result, path, rel_tol=1e-3), separator)

    def test_points_outside_of_the_run_do_not_count(self):
        frame = pd.DataFrame({"t": [-1, 0.5, 2], "C.contact_force": [1e9, 100, 1e9]})
        row = compare_measured(self.result, frame).table.iloc[0]
        self.assertEqual((row.points, row.outside), (1, 2))

    def test_what_does_not_fit_is_told(self):
        frame = self.frame()
        for wrong, words in (
                (frame.rename(columns={"time [s]": "clock"}), "no column time among clock"),
                (frame.rename(columns={"C.contact_force [N]": "F"}), "no column of time"),
                (self.frame(header="C.contact_force [m]"), "'m' is no unit of a quantity in N"),
                (frame.assign(**{"time [s]": frame["time [s]"] + 9}), "no measured point of C")):
            with self.assertRaisesRegex(ValueError, words):
                compare_measured(self.result, wrong)
        with self.assertRaisesRegex(ValueError, "did you mean 'C.contact_force'"):
            compare_measured(self.result, self.frame(header="F"), map={"F": "C.contact_forse"})

    def test_points_are_drawn_over_the_line(self):
        compared = compare_measured(self.result, self.frame(lag=0.04), shift_s=0.04)
        line, points = compared.plot().lines
        self.assertEqual(len(points.get_xdata()), 400)
        self.assertAlmostEqual(points.get_xdata()[0], 0.3)
        self.assertAlmostEqual(line.get_xdata()[0], 0.26, delta=2e-3)
        self.assertIn("C.contact_force", compared._repr_html_())


if __name__ == "__main__":
    unittest.main()
