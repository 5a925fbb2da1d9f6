"""A metric of a sweep as a line or a map: what it shows of cells that failed, missed, or have no value."""

import math
import unittest

import matplotlib.pyplot as plt
import numpy as np
from contact.v1 import event_pb2, job_pb2, scenario_pb2
from contactsim import SweepResult
from contactsim.figures import FigureError, Mark
from contactsim.figures.maps import _levels, draw_map
from contactsim.figures.sweeps import heat_map, sweep_line
from matplotlib.patches import Rectangle

METRIC = "cycles[B1-B2].peak_force_n"
FULL, PARTIAL = job_pb2.Job.FULL, job_pb2.Job.PARTIAL


def sweep_of(axes, rows):
    """A sweep over fields; rows are values, the metric, and fields of the cell."""
    job = job_pb2.Job(name="jobs/s", spec_sha256="ab", server_version="1")
    job.sweep.base.title = "a sweep"
    job.sweep.base.bodies.add(name="B1")
    job.sweep.base.contacts.add(between=["B1", "B2"])
    job.sweep.metrics.append(METRIC)
    for field in axes:
        job.sweep.axes.add(field=field)
    cells = [event_pb2.SweepCell(index=i, values=values, metrics=[metric],
                                 **{"state": job_pb2.Job.SUCCEEDED, "convergence": FULL, **more})
             for i, (values, metric, more) in enumerate(rows)]
    return SweepResult(job, cells)


def line_of(*rows):
    return sweep_of(["bodies[0].mass_kg"], [([x], y, more) for x, y, more in rows])


def grid_of(rows, columns, value, **fields):
    return sweep_of(["bodies[0].mass_kg", "contacts[0].restitution"],
                    [([r, c / 10], value(r, c), fields)
                     for r in range(rows) for c in range(columns)])


FAILED = {"state": job_pb2.Job.FAILED}
MISSED = {"convergence": PARTIAL}
CUT = {"sources": [event_pb2.SweepCell.CUT]}
UNTOUCHED = {"sources": [event_pb2.SweepCell.NO_CONTACT]}


class LineTest(unittest.TestCase):

    def test_it_goes_through_the_cells_in_the_order_of_their_values(self):
        figure = sweep_line(line_of((2, 20, {}), (3, 30, {}), (1, 10, {})), METRIC)
        panel = figure.panels[0]
        self.assertEqual(panel.curves[0].x.tolist(), [1, 2, 3])
        self.assertEqual(panel.curves[0].y.tolist(), [10, 20, 30])
        self.assertEqual((panel.x_label, panel.y_label),
                         ("mass of B1 [kg]", "peak force of B1-B2 [N]"))
        self.assertEqual((figure.title, figure.note), ("a sweep", ""))

    def test_it_is_broken_where_no_value_is_known_and_crossed_where_a_cell_missed(self):
        figure = sweep_line(line_of((1, 10, {}), (2, 20, FAILED), (3, 30, MISSED), (4, 1, CUT),
                                    (5, 1, UNTOUCHED), (6, 60, {})), METRIC)
        line, missed = figure.panels[0].curves
        np.testing.assert_array_equal(line.y, [10, math.nan, 30, math.nan, math.nan, 60])
        self.assertEqual((missed.mark, missed.x.tolist()), (Mark.END, [3]))
        self.assertEqual(figure.note, "× not converged; 1 cell failed; 1 cell CUT by the end; "
                         "1 cell without contact")

    def test_logarithmic_axis_tells_what_it_cannot_show(self):
        figure = sweep_line(line_of((1, -1, {}), (2, 0, {}), (3, 10, {})), METRIC, log=True)
        self.assertTrue(figure.panels[0].log_y)
        self.assertEqual(figure.note, "2 values <= 0 not shown")
        with self.assertRaisesRegex(FigureError, "to show"):
            sweep_line(line_of((1, -1, {})), METRIC, log=True)

    def test_axis_of_an_enum_has_its_words_and_a_range_in_ratios_is_logarithmic(self):
        sweep = sweep_of(["contacts[0].damping"], [([2], 1, {}), ([6], 2, {})])
        self.assertEqual(sweep_line(sweep, METRIC).panels[0].x_words, {2: "EXACT", 6: "FLORES"})
        ratios = line_of((1, 1, {}), (10, 2, {}))
        ratios.job.sweep.axes[0].log.low = 1
        self.assertTrue(sweep_line(ratios, METRIC).panels[0].log_x)


class MapTest(unittest.TestCase):

    def draw(self, sweep, log=False, contours=False):
        ax = plt.subplots()[1]
        self.addCleanup(plt.close, ax.figure)
        draw_map(heat_map(sweep, METRIC, log), ax, contours)
        ax.figure.canvas.draw()
        return ax

    def covers(self, ax):
        return [(patch.get_hatch(), patch.get_x() + 0.5, patch.get_y() + 0.5)
                for patch in ax.patches if isinstance(patch, Rectangle)]

    def test_first_axis_points_down_and_the_second_across_with_words_and_units(self):
        map_ = heat_map(grid_of(2, 3, lambda r, c: 10 * r + c), METRIC)
        self.assertEqual(map_.values.tolist(), [[0, 1, 2], [10, 11, 12]])
        ax = self.draw(grid_of(2, 3, lambda r, c: 10 * r + c))
        self.assertEqual((ax.get_ylabel(), ax.get_xlabel()),
                         ("mass of B1 [kg]", "restitution of B1-B2 [1]"))
        self.assertGreater(*ax.get_ylim())
        self.assertEqual([text.get_text() for text in ax.get_xticklabels()], ["0", "0.1", "0.2"])
        self.assertEqual([text.get_text() for text in ax.texts], ["0", "1", "2", "10", "11", "12"])

    def test_cells_that_missed_failed_or_have_no_value_are_covered(self):
        rows = [([0, 0], 1, {}), ([0, 1], 2, MISSED), ([1, 0], 3, CUT), ([1, 1], 4, FAILED),
                ([2, 0], 5, UNTOUCHED), ([2, 1], 6, {})]
        sweep = sweep_of(["bodies[0].mass_kg", "contacts[0].restitution"], rows)
        ax = self.draw(sweep)
        self.assertEqual(self.covers(ax), [("///", 1, 0), (None, 0, 1), (None, 0, 2)])
        self.assertEqual(len(ax.lines), 3)  # A bar, and a cross of two lines.
        self.assertEqual(heat_map(sweep, METRIC).counts, {
            "failed": 1, "CUT": 1, "no contact": 1, "<= 0": 0, "none": 0})

    def test_many_cells_have_no_numbers_and_few_ticks_at_round_steps(self):
        ax = self.draw(grid_of(50, 70, lambda r, c: r * c))
        self.assertFalse(ax.texts)
        for axis, step in ((ax.xaxis, 10), (ax.yaxis, 5)):
            self.assertEqual(set(np.diff(axis.get_ticklocs())), {step})

    def test_values_without_logarithm_are_counted(self):
        map_ = heat_map(grid_of(2, 2, lambda r, c: r * c), METRIC, log=True)
        self.assertEqual(map_.counts["<= 0"], 3)

    def test_lines_of_equal_value_of_a_plane_are_straight(self):
        ax = self.draw(grid_of(9, 9, lambda r, c: r), contours=True)
        lines = [path for one in ax.collections[1:] for path in one.get_paths()]
        self.assertGreater(len(lines), 2)
        for path in lines:
            self.assertLess(np.ptp(path.vertices[:, 1]), 1e-9)

    def test_no_line_goes_beside_a_cell_that_did_not_converge(self):
        sweep = grid_of(3, 3, lambda r, c: r + c)
        self.assertGreater(len(self.draw(sweep, contours=True).collections), 1)
        self.assertEqual(len(self.draw(grid_of(3, 3, lambda r, c: r + c, convergence=PARTIAL),
                                       contours=True).collections), 1)

    def test_one_value_has_a_range_and_no_lines(self):
        for value in (1.0, 0.0, -3.0):
            for log in (False, True):
                ax = self.draw(grid_of(2, 2, lambda r, c: value), log=log, contours=True)
                low, high = ax.collections[0].get_clim()
                self.assertLess(low, high)

    def test_levels_are_round_and_within_the_values(self):
        np.testing.assert_allclose(_levels(0.03, 3, True), [0.05, 0.1, 0.2, 0.5, 1, 2])
        np.testing.assert_allclose(_levels(1, 1e5, True), 10.0**np.arange(6))
        for low, high, log in ((2.1, 2.9, True), (-3, 5, False), (1e-3, 7, True)):
            levels = _levels(low, high, log)
            self.assertTrue(levels and low <= levels[0] and levels[-1] <= high)

    def test_it_is_of_grids_of_two_axes(self):
        with self.assertRaisesRegex(FigureError, "grid of two axes"):
            heat_map(line_of((1, 1, {})), METRIC)
        zipped = grid_of(2, 2, lambda r, c: 1)
        zipped.job.sweep.combination = scenario_pb2.Sweep.ZIP
        with self.assertRaisesRegex(FigureError, "grid of two axes"):
            heat_map(zipped, METRIC)


if __name__ == "__main__":
    unittest.main()
