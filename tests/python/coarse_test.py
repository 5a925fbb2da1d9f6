"""Figures say what their samples are too few for, and show what the ledger knows all the same."""

import json
import pathlib
import unittest

import numpy as np
from contact.v1 import job_pb2
from contactsim.figures import PRESETS, Mark, channels_figure, preset_figure
from contactsim.figures.characters import text
from contactsim.figures.coarse import parted, spread
from contactsim.figures.draw import drawn
from contactsim.figures.figure import keep_largest, points_csv
from contactsim.figures.look import Look
from contactsim.figures.shown import Part
from sample_run import run_of, sample_run

Cycle = job_pb2.Cycle
REFERENCE = pathlib.Path(__file__).parents[1] / "reference/coarse.json"


def bouncing(period, samples, length=0.1, cut=False):
    """A ball that bounces on a floor ten times a second or more, in a second with so many samples: its
    force is half a sine whose peaks grow by 1 N from cycle to cycle."""
    job = job_pb2.Job(name="jobs/ball", state=job_pb2.Job.SUCCEEDED, spec_sha256="00" * 8)
    job.scenario.bodies.add(name="ball", mass_kg=1, radius_m=0.5)
    contact = job.scenario.contacts.add(name="floor", between=["ball"], stiffness=1e6, restitution=1)
    contact.wall.position_m = 0
    time = np.linspace(0, 1, samples)
    force = np.zeros(samples)
    for number in range(1, round(1 / period)):
        start, end = (number - 0.5) * period, (number - 0.5 + length) * period
        job.cycles.add(contact="floor", number=number, start_time_s=start, end_time_s=end,
                       turn_time_s=(start + end) / 2, end=Cycle.SEPARATION, status=Cycle.CONVERGED,
                       delta_max_m=1e-3 * number, peak_force_n=number)
        within = (time >= start) & (time <= end)
        force[within] = number * np.sin(np.pi * (time[within] - start) / (end - start))
    if cut:
        job.cycles.add(contact="floor", number=99, start_time_s=0.99, end_time_s=1, end=Cycle.RUN_END,
                       status=Cycle.CUT, peak_force_n=float("nan"))
    columns = {"time": ("time", "s", time), "ball.velocity": ("velocity", "m/s", np.cos(time)),
               "ball.position": ("position", "m", np.sin(time)),
               "floor.contact_force": ("contact_force", "N", force),
               "floor.external_force": ("external_force", "N", force),
               "floor.deformation": ("deformation", "m", 1e-3 * force),
               "floor.deformation_velocity": ("deformation_velocity", "m/s", force)}
    return run_of(job, columns)


def texts(page):
    return [text.get_text() for ax in page.axes for text in ax.texts]


class CoarseTest(unittest.TestCase):

    def test_a_run_with_enough_samples_has_no_stamp_no_range_and_all_its_lines(self):
        for run in sample_run(), bouncing(0.1, 2000):
            for preset in set(PRESETS) & {"velocity", "force", "hysteresis", "position"}:
                for panel in preset_figure(preset, run).panels:
                    self.assertEqual((panel.stamp, panel.ranges, panel.cut), ("", [], []))
                    self.assertTrue(all(parted(curve) == [curve] for curve in panel.curves))

    def test_contacts_between_samples_are_counted_and_have_the_ranges_of_the_ledger(self):
        panel = preset_figure("force", bouncing(0.1, 600)).panels[0]  # Six samples in a contact.
        self.assertEqual(panel.stamp, "9 of 9 contacts have fewer than 10 samples")
        (shown,) = panel.ranges
        np.testing.assert_allclose(shown.high, np.arange(1, 10))
        np.testing.assert_allclose(shown.low, 0)
        np.testing.assert_allclose(shown.end - shown.start, 0.01)
        self.assertEqual(len(parted(panel.curves[0])), 1, "between contacts the line is right")

    def test_only_channels_whose_extremes_are_known_have_ranges(self):
        run = bouncing(0.1, 600)
        for channel, highest in (("floor.deformation", 9e-3), ("floor.contact_force", 9)):
            (shown,) = channels_figure([channel], run).panels[0].ranges
            self.assertAlmostEqual(shown.high.max(), highest)
        for channel in "floor.deformation_velocity", "ball.velocity":
            panel = channels_figure([channel], run).panels[0]
            self.assertEqual(panel.ranges, [])
            self.assertIn("9 of 9", panel.stamp)

    def test_samples_rarer_than_contacts_are_points_that_no_line_joins(self):
        run = bouncing(0.01, 300)
        for preset, drifts in (("velocity", True), ("position", True), ("force", False),
                               ("deformation-velocity", False)):
            panel = preset_figure(preset, run).panels[0]
            line, *dots = parted(panel.curves[0])
            self.assertEqual((line.mark, [each.mark for each in dots]),
                             (Mark.LINE, [Mark.RARE] * drifts))
            known = np.isfinite(line.y).sum()
            self.assertLess(known, 12, "before the first and after the last")
            self.assertEqual(sum(len(each.y) for each in dots), (300 - known) * drifts)
            marks = [part for curve in panel.curves if curve.is_mark for part in parted(curve)]
            self.assertLess(sum(len(mark.x) for mark in marks), 4)
        self.assertEqual(preset_figure("hysteresis", run).panels[0].curves[0].mark, Mark.RARE)

    def test_a_swing_that_samples_miss_is_a_range_and_no_slow_swing(self):
        run = bouncing(0.01, 300)
        time = run.arrays["time"]
        run.arrays["ball.velocity"] = 2 + 3 * np.sin(2 * np.pi * 301 * time)  # Sampled: once a second.
        panel = preset_figure("velocity", run).panels[0]
        (shown,) = spread(panel)
        self.assertLess(shown.end - shown.start, 1)
        np.testing.assert_allclose((shown.low, shown.high), [[-1], [5]], atol=1e-2)
        self.assertEqual(len(parted(panel.curves[0])), 1)
        self.assertEqual(spread(preset_figure("force", run).panels[0]), [], "the ledger tells more")
        page = drawn(preset_figure("velocity", run))
        self.assertIn("range of samples too rare to show the motion",
                      [text.get_text() for text in page.axes[0].get_legend().get_texts()])
        lines = text(preset_figure("velocity", run), 80).splitlines()
        self.assertTrue(any(":" * 60 in line for line in lines))
        self.assertFalse(any("*" * 7 in line or "×" * 3 in line for line in lines))
        self.assertIn(" 99 of 99 contacts have fewer than 10 samples", lines)

    def test_a_window_counts_what_it_shows(self):
        part = Part(start=0.2, end=0.5)
        panel = preset_figure("force", bouncing(0.1, 600), part).panels[0]
        self.assertEqual(panel.stamp, "3 of 3 contacts have fewer than 10 samples")
        self.assertGreaterEqual(panel.ranges[0].start.min(), 0.2)

    def test_data_are_those_that_were_recorded(self):
        rows = points_csv(preset_figure("velocity", bouncing(0.01, 300))).splitlines()
        self.assertEqual(sum(row.startswith("ball,") for row in rows if "floor" not in row), 300)

    def test_the_dashboard_shows_the_same(self):
        """client/web/test/coarse.test.ts has the same runs, as few columns as it needs."""
        for case in json.loads(REFERENCE.read_text("utf-8"))["cases"]:
            panel = preset_figure("force", bouncing(**case["run"])).panels[0]
            ranges = [row for each in panel.ranges
                      for row in zip(each.start, each.end, each.low, each.high)]
            self.assertEqual(panel.stamp, case["stamp"])
            for name, shown in (("ranges", ranges), ("loose", panel.curves[0].loose),
                                ("cut", panel.cut)):
                self.assertEqual(np.shape(shown), np.shape(case[name]), name)
                np.testing.assert_allclose(shown, case[name], rtol=1e-12, atol=1e-12)

    def test_stamp_ranges_and_cuts_are_drawn_in_every_look(self):
        run = bouncing(0.1, 300, cut=True)
        for look in Look(), Look(style="paper"), Look(provenance=False, title=False):
            for preset in "velocity", "force", "hysteresis", "force-map", "force-waterfall":
                figure = preset_figure(preset, run)
                keep_largest(figure)
                self.assertIn("9 of 10 contacts have fewer than 10 samples",
                              texts(drawn(figure, look)), preset)
        panel = preset_figure("force", run).panels[0]
        self.assertEqual(panel.cut, [(0.99, 1.0)])
        page = drawn(preset_figure("force", run))
        words = [text.get_text() for text in page.axes[0].get_legend().get_texts()]
        self.assertIn("cut by the end of the run", words)
        self.assertIn("range in contacts too short for samples", words)
        self.assertGreater(page.axes[0].get_ylim()[1], 9, "the range lies within the axes")


if __name__ == "__main__":
    unittest.main()
