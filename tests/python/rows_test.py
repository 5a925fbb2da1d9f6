"""Many curves as a map or a waterfall: a wave through any number of contacts is seen, no peak is lost."""

import math
import unittest

import numpy as np
from contactsim.figures import PRESETS, FigureError, preset_figure
from contactsim.figures.characters import text
from contactsim.figures.draw import drawn
from contactsim.figures.figure import Curve, Kind, Panel, keep_largest
from contactsim.figures.files import drawing, rendered
from contactsim.figures.look import Look
from contactsim.figures.picture import cells
from sample_run import row_run

COUNTS = (1, 5, 20, 100, 1000)
ROWS = [preset for preset in PRESETS if preset.endswith(("-map", "-waterfall"))]
LEAST_INCHES = 2.5


def page_of(preset, run):
    with drawing(Look()):
        figure = preset_figure(preset, run)
        keep_largest(figure)
        page = drawn(figure)
        page.draw_without_rendering()
    return page


class PictureTest(unittest.TestCase):

    def test_a_spike_of_one_sample_is_in_every_picture_with_its_sign(self):
        x, values = np.linspace(0, 1, 10_001), np.zeros((7, 10_001))
        values[4, 3333], values[2, 3333] = -9, 5
        panel = Panel("time [s]", "velocity [m/s]",
                      [Curve(str(row), row, x, y) for row, y in enumerate(values)], Kind.MAP)
        for columns in (1, 7, 1000):
            picture = cells(panel, columns, 7)
            self.assertEqual((picture.min(), picture.max()), (-9, 5))
            at = min(int(0.3333 * columns), columns - 1)
            self.assertEqual((picture[4, at], picture[2, at]), (-9, 5))
        self.assertEqual(cells(panel, 10, 2).min(), -9)  # Fewer rows than curves.

    def test_between_uneven_samples_a_curve_is_straight(self):
        x = np.array([0.0, 0.1, 0.9, 1.0, *np.linspace(2, 3, 96)])
        panel = Panel("time [s]", "force [N]", [Curve("A", 0, x, 2 * x)], Kind.MAP)
        picture = cells(panel, 100, 1)[0]
        self.assertEqual(len(picture), 100)
        # The largest value of a column lies at its end or at a sample before that.
        edges = np.linspace(0, 3, 101)
        self.assertTrue(((picture >= 2 * edges[:-1] - 1e-12) & (picture <= 2 * edges[1:] + 1e-12)).all())


class RowsTest(unittest.TestCase):

    def test_a_wave_is_seen_through_any_number_of_contacts(self):
        for count in COUNTS:
            run = row_run(count, 4000)
            (picture,) = page_of("force-map", run).axes[0].images
            values = picture.get_array()
            self.assertEqual(values.shape, (count, 1000))
            for row, cycle in enumerate(run.job.cycles):
                at = int(values[row].argmax())
                self.assertLessEqual(abs(at - 1000 * cycle.turn_time_s / 1e-3), 1.5, (count, row))
                self.assertTrue(math.isclose(values[row, at], cycle.peak_force_n, rel_tol=0.01))

    def test_panels_keep_a_useful_height(self):
        for count in COUNTS:
            run = row_run(count)
            for preset in ("force", "velocity", *ROWS):
                page = page_of(preset, run)
                height = page.axes[0].get_window_extent().height / page.dpi
                self.assertGreater(height, LEAST_INCHES, (preset, count))

    def test_ten_thousand_contacts_are_a_thousand_rows(self):
        x = np.linspace(0, 1, 50)
        panel = Panel("time [s]", "force [N]",
                      [Curve(f"C{place}", place, x, np.full(50, float(place)))
                       for place in range(10_000)], Kind.MAP)
        picture = cells(panel, 1000, 1000)
        self.assertEqual(picture.shape, (1000, 50))
        self.assertEqual(picture[:, 0].tolist(), list(range(9, 10_000, 10)))

    def test_a_waterfall_has_at_most_sixty_lines_above_each_other(self):
        for count in COUNTS:
            ax = page_of("force-waterfall", row_run(count)).axes[0]
            (lines,) = ax.collections
            bases = [path.vertices[:, 1].min() for path in lines.get_paths()]
            self.assertLessEqual(len(bases), 60)
            self.assertEqual(bases, sorted(bases, reverse=True))

    def test_velocities_to_both_sides_are_two_colours(self):
        run = row_run(5)
        run.arrays["B2.velocity"] = -run.arrays["B2.velocity"]
        (picture,) = page_of("velocity-map", run).axes[0].images
        self.assertEqual(picture.norm.vmin, -picture.norm.vmax)

    def test_a_decade_of_a_logarithmic_map_is_as_wide_as_another(self):
        run = row_run(5)
        run.arrays["B2.velocity"] = -1e-6 * run.arrays["B2.velocity"]
        for preset, signs in (("force-map", (1,)), ("velocity-map", (1, -1))):
            figure = preset_figure(preset, run)
            figure.panels[0].log_y = True
            with drawing(Look()):
                (picture,) = drawn(figure).axes[0].images
            for sign in signs:
                at = picture.norm(sign * picture.norm.vmax * np.array([1, 0.1, 0.01]))
                self.assertAlmostEqual(at[0] - at[1], at[1] - at[2], delta=0.02)
            self.assertTrue(rendered(figure, "png").startswith(b"\x89PNG"))
            with self.assertRaisesRegex(FigureError, "--log"):
                text(figure, 80)

    def test_pgf_has_no_maps_but_waterfalls(self):
        with self.assertRaisesRegex(FigureError, "no bitmaps"):
            rendered(preset_figure("force-map", row_run(5)), "pgf")
        self.assertIn(b"pgfpicture", rendered(preset_figure("force-waterfall", row_run(5)), "pgf"))

    def test_characters_show_the_wave_as_wide_as_the_terminal(self):
        for count, rows in ((5, 5), (1000, 19)):
            lines = text(preset_figure("force-map", row_run(count)), 80).splitlines()
            shown = [line for line in lines if line.endswith("|")]
            self.assertEqual(len(shown), rows)
            self.assertEqual({len(line) for line in shown}, {80})
            peaks = [max(range(80), key=lambda i: " .:-=+*#%@".find(line[i])) for line in shown]
            self.assertEqual(peaks, sorted(peaks, reverse=True))


if __name__ == "__main__":
    unittest.main()
