"""What figures show of a run, as plain values, whatever draws them."""

import math
import unittest

import numpy as np
from contact.v1 import event_pb2, job_pb2, scenario_pb2
from contactsim.figures import (PRESETS, Curve, Figure, FigureError, Mark, Panel, channels_figure,
                                preset_figure, presets_figure)
from contactsim.figures.characters import text
from contactsim.figures.draw import drawn
from contactsim.figures.figure import keep_largest, number_text, points_csv, thin
from contactsim.figures.look import Look
from contactsim.figures.overlay import overlay_figure
from contactsim.figures.shown import Part
from sample_run import run_of, sample_run


def panel_of(preset, run, part=Part()):
    return preset_figure(preset, run, part).panels[0]


def named(panel, label):
    return next(curve for curve in panel.curves if curve.label == label)


def columns_of(run, without=""):
    return {name: (name.rpartition(".")[2], run.units[name], values)
            for name, values in run.arrays.items() if not without or not name.endswith(without)}


class PresetsTest(unittest.TestCase):

    def setUp(self):
        self.run_ = sample_run()
        self.first, self.second = self.run_.job.cycles

    def complaint(self, preset, run):
        try:
            preset_figure(preset, run)
        except FigureError as error:
            return str(error)
        return ""

    def test_every_preset_shows_curves_whose_axes_have_units(self):
        for preset in PRESETS:
            with self.subTest(preset):
                figure = preset_figure(preset, self.run_)
                self.assertEqual(figure.title, "Two balls & a <wall>")
                self.assertEqual(len(figure.sources), 1)
                for panel in figure.panels:
                    self.assertTrue(panel.curves)
                    self.assertTrue(panel.counted_x or panel.x_label.endswith("]"))
                    for curve in panel.curves:
                        self.assertEqual(len(curve.x), len(curve.y))

    def test_a_column_that_is_missing_is_named(self):
        for preset, column in (("position", ".position"), ("velocity", ".velocity"),
                               ("force", ".contact_force"), ("force", ".external_force"),
                               ("deformation-velocity", ".deformation_velocity"),
                               ("hysteresis", ".deformation")):
            with self.subTest(f"{preset} {column}"):
                run = run_of(self.run_.job, columns_of(self.run_, column))
                said = self.complaint(preset, run)
                self.assertIn(column, said)
                self.assertIn("output.ledger_only", said)

    def test_a_column_that_an_older_server_did_not_record_is_told(self):
        for preset, column in (("acceleration", ".acceleration"), ("supports", ".support_force"),
                               ("energy", "_energy"), ("energy", ".load_work")):
            with self.subTest(f"{preset} {column}"):
                run = run_of(self.run_.job, columns_of(self.run_, column))
                if preset == "supports":
                    run = run_of(self.run_.job, columns_of(run, "_energy"))
                said = self.complaint(preset, run)
                self.assertIn("an older server made it, so run it again", said)
        self.assertIn("output.ledger_only", self.complaint("energy", run_of(self.run_.job, {})))
        del self.run_.job.scenario.supports[:]
        self.assertEqual(self.complaint("supports", self.run_), "this run has no supports")

    def test_energy_has_the_parts_that_are_not_0_and_their_balance(self):
        panel = panel_of("energy", self.run_)
        self.assertEqual([curve.label for curve in panel.curves],
                         ["kinetic", "contacts", "supports", "dissipated", "load work",
                          "sum less load work"])
        np.testing.assert_allclose(panel.curves[-1].y, 8, rtol=1e-15)

    def test_supports_have_a_panel_for_force_and_one_for_energy(self):
        force, energy = preset_figure("supports", self.run_).panels
        self.assertEqual((force.y_label, energy.y_label), ("force [N]", "energy [J]"))
        self.assertEqual(named(force, "A-ground").y[-1], -20)
        self.assertEqual(named(energy, "A-ground").y[-1], 20)

    def test_ledger_and_iterations_need_no_trajectory(self):
        run = run_of(self.run_.job, {}, self.run_.passes)
        self.assertEqual(self.complaint("restitution", run), "")
        self.assertEqual(self.complaint("iterations", run), "")

    def test_what_has_nothing_to_show_is_told(self):
        del self.run_.job.cycles[:]
        run = run_of(self.run_.job, columns_of(self.run_))
        for preset in ("hysteresis", "restitution"):
            self.assertEqual(self.complaint(preset, run), "this run has nothing to show there")
        self.assertEqual(self.complaint("iterations", run), "this run iterated nothing")
        self.assertEqual(self.complaint("velocity", run), "")

    def test_bands_of_contacts_that_overlap_are_one(self):
        self.assertEqual(panel_of("force", self.run_).bands, [(0, 1)])  # They touch.
        self.first.end_time_s = 0.25
        self.assertEqual(panel_of("force", self.run_).bands, [(0, 0.25), (0.5, 1)])
        self.run_.job.groups.add(contact="W", start_time_s=0.4, end_time_s=1)
        self.assertEqual(panel_of("force", self.run_).bands, [(0, 0.25), (0.4, 1)])

    def test_cycle_has_the_restitution_of_its_group(self):
        self.second.group = 1
        self.run_.job.groups.add(contact="W", number=1, restitution_out=0.8)
        panel = panel_of("restitution", self.run_)
        self.assertEqual(named(panel, "W").y.tolist(), [0.8])
        self.assertEqual(named(panel, "A-B").y.tolist(), [0.79])

    def test_errors_of_the_restitution_have_a_logarithmic_panel_unless_none_was_asked_for(self):
        self.second.restitution_out = 0.8
        values, errors = preset_figure("restitution", self.run_).panels
        self.assertTrue(errors.log_y)
        self.assertAlmostEqual(errors.curves[0].y[0], 0.0125, delta=1e-12)
        self.assertEqual(errors.curves[1].y.tolist(), [1e-17])
        for cycle in self.run_.job.cycles:
            cycle.restitution_in = math.nan
        self.assertEqual(len(preset_figure("restitution", self.run_).panels), 1)

    def test_marks_stand_where_the_ledger_says_and_not_at_the_nearest_sample(self):
        self.first.delta_end_m = 0.01
        self.first.approach_velocity_m_per_s = 3
        force = panel_of("force", self.run_)
        self.assertEqual(named(force, "A-B starts").y.tolist(), [0])
        self.assertAlmostEqual(named(force, "A-B ends").y[0], 1e8 * 0.001)  # k δ^1.5
        speed = panel_of("deformation-velocity", self.run_)
        self.assertEqual(named(speed, "A-B starts").y.tolist(), [3])

    def test_damper_that_does_not_fade_has_a_force_at_the_start(self):
        contact = self.run_.job.scenario.contacts[0]
        contact.damping, contact.exponent = scenario_pb2.Contact.KELVIN_VOIGT, 1
        self.first.mu, self.first.approach_velocity_m_per_s = 20, 3
        self.assertEqual(named(panel_of("force", self.run_), "A-B starts").y.tolist(), [60])

    def test_end_of_a_cycle_that_the_run_cuts_is_that_of_the_curve(self):
        self.first.end, self.first.end_time_s = job_pb2.Cycle.RUN_END, 31.5 / 64
        between = self.run_["A-B.contact_force"][31:33].mean()
        self.assertAlmostEqual(named(panel_of("force", self.run_), "A-B ends").y[0], between)

    def test_displacement_is_the_position_less_that_at_the_start(self):
        moved, here = panel_of("displacement", self.run_), panel_of("position", self.run_)
        np.testing.assert_array_equal(named(moved, "B").y, named(here, "B").y - 1)
        self.assertEqual(named(moved, "B, A-B ends").y.tolist(), [0])

    def test_wall_is_where_the_centre_of_the_ball_stops_at_first_touch(self):
        self.assertEqual(panel_of("position", self.run_).dotted, [1.25])

    def test_loops_hold_the_samples_of_their_cycle_and_close_where_it_separates(self):
        panel = panel_of("hysteresis", self.run_)
        self.assertEqual(len(named(panel, "A-B").x), 33)  # 31 samples, and both ends.
        self.assertEqual((named(panel, "A-B").x[-1], named(panel, "A-B").y[-1]), (0, 0))
        self.run_.job.cycles.add().CopyFrom(self.first)
        self.run_.job.cycles[-1].number = 2
        panel = panel_of("hysteresis", self.run_)
        self.assertTrue(named(panel, "A-B").keyed)  # It alone is in the key.
        self.assertFalse(named(panel, "A-B #2").keyed)

    def test_peaks_of_cycles_with_too_few_samples_have_no_label(self):
        self.assertEqual(len(panel_of("force", self.run_).labels), 2)
        self.first.end_time_s = 8 / 64
        self.assertEqual([label.x for label in panel_of("force", self.run_).labels], [0.75])

    def test_of_many_peaks_the_largest_have_labels_in_the_order_of_time(self):
        for peak in range(30):
            cycle = self.run_.job.cycles.add()
            cycle.CopyFrom(self.second)
            cycle.turn_time_s, cycle.peak_force_n = 0.03 * peak, 200 + peak
        labels = panel_of("force", self.run_).labels
        self.assertEqual([label.y for label in labels], list(range(218, 230)))

    def test_episode_with_the_most_passes_is_shown(self):
        unknown = event_pb2.Iteration.Unknown(contact="W", number=1, mu=2)
        more = [event_pb2.Iteration(episode=2, number=number, unknowns=[unknown])
                for number in range(5)]
        run = run_of(self.run_.job, {}, [*self.run_.passes, *more])
        panel = panel_of("iterations", run)
        self.assertEqual((panel.x_label, panel.curves[0].label), ("pass of episode 2", "W #1"))

    def test_damping_factors_have_the_unit_of_their_exponent(self):
        def unit():
            return preset_figure("iterations", self.run_).panels[0].y_label
        self.assertEqual(unit(), "μ [N·s/m^(5/2)]")
        first, second = self.run_.job.scenario.contacts
        first.exponent = second.exponent = 1
        self.assertEqual(unit(), "μ [N·s/m^2]")
        first.damping = second.damping = scenario_pb2.Contact.KELVIN_VOIGT
        self.assertEqual(unit(), "μ [N·s/m]")
        second.damping = scenario_pb2.Contact.EXACT
        self.assertEqual(unit(), "μ [N·s/m^(n+1)]")

    def test_several_presets_are_panels_with_letters(self):
        figure = presets_figure(["force", "iterations"], self.run_)
        self.assertEqual([(panel.letter, panel.y_label.split(" [")[0]) for panel in figure.panels],
                         [("(a)", "force"), ("(b)", "μ"), ("(c)", "|W_r/W_c + ε²|")])
        self.assertEqual(figure.note, "o start, × end of a contact cycle")
        page = drawn(figure, Look(style="springer"))
        letters = [text.get_text() for ax in page.axes for text in ax.texts]
        self.assertLessEqual({"(a)", "(b)", "(c)"}, set(letters))
        self.assertIn("+- (a) force", text(figure, 80))
        self.assertEqual(presets_figure(["force"], self.run_).panels[0].letter, "")

    def test_channels_have_a_panel_for_each_quantity(self):
        figure = channels_figure(["A.velocity", "W.contact_force", "B.velocity"], self.run_)
        self.assertEqual([panel.y_label for panel in figure.panels],
                         ["velocity [m/s]", "contact force [N]"])
        self.assertEqual([len(panel.curves) for panel in figure.panels], [2, 1])
        with self.assertRaisesRegex(FigureError, "did you mean 'A.velocity'"):
            channels_figure(["A.velocty"], self.run_)
        with self.assertRaisesRegex(FigureError, "there are A.position, A.velocity, A.acceleration$"):
            channels_figure(["A.speed"], self.run_)


class PartTest(unittest.TestCase):

    def setUp(self):
        self.run_ = sample_run()

    def test_contacts_named_and_their_bodies_are_shown_in_their_colours(self):
        part = Part(["W"])
        force = panel_of("force", self.run_, part)
        self.assertEqual({curve.colour for curve in force.curves}, {1})
        self.assertEqual(force.bands, [(0.5, 1)])
        self.assertEqual({curve.label[0] for curve in
                          panel_of("velocity", self.run_, part).curves}, {"B"})
        with self.assertRaisesRegex(FigureError, "nothing"):
            preset_figure("iterations", self.run_, part)
        with self.assertRaisesRegex(FigureError, "did you mean 'A-B'"):
            preset_figure("force", self.run_, Part(["A-C"]))

    def test_window_cuts_curves_where_it_ends(self):
        line = named(panel_of("velocity", self.run_, Part(start=0.205, end=0.505)), "A")
        self.assertEqual((line.x[0], line.x[-1]), (0.205, 0.505))
        np.testing.assert_allclose(line.y, 2 * line.x, rtol=1e-12)
        with self.assertRaisesRegex(FigureError, "before"):
            preset_figure("force", self.run_, Part(start=1, end=1))


class ManyCurvesTest(unittest.TestCase):

    def curves(self, *heights):
        return [Curve(f"c{place}", place, np.array([0.0, 1.0]), np.array([0.0, height]))
                for place, height in enumerate(heights)]

    def test_key_is_left_to_the_largest_in_their_order_each_with_a_colour(self):
        figure = Figure("", [Panel("x", "y", self.curves(1, 5, 4, 2, 6))], most_colours=3)
        keep_largest(figure)
        kept = [curve for curve in figure.panels[0].curves if curve.keyed]
        self.assertEqual([(c.label, c.colour) for c in kept], [("c1", 0), ("c2", 1), ("c4", 2)])
        self.assertEqual(figure.crowd, 2)
        again = [curve.mark for curve in figure.panels[0].curves]
        keep_largest(figure)
        self.assertEqual([curve.mark for curve in figure.panels[0].curves], again)

    def test_rows_beyond_twelve_have_the_colour_of_their_place(self):
        for count, shades in ((12, {None}), (13, {place / 12 for place in range(13)})):
            figure = Figure("", [Panel("x", "y", self.curves(*range(1, count + 1)))])
            keep_largest(figure)
            self.assertEqual({curve.shade for curve in figure.panels[0].curves}, shades)
            self.assertEqual(sum(curve.is_faint for curve in figure.panels[0].curves), count - 10)

    def test_spans_may_count_instead_of_heights(self):
        curves = self.curves(1, 1)
        curves[0].y = np.array([8.0, 9.0])
        curves[1].y = np.array([0.0, 2.0])
        figure = Figure("", [Panel("x", "y", curves, by_span=True)], most_colours=1)
        keep_largest(figure)
        self.assertEqual([c.label for c in figure.panels[0].curves if c.keyed], ["c1"])

    def test_of_a_panel_of_marks_alone_the_others_are_dots(self):
        curves = self.curves(1, 2)
        for curve in curves:
            curve.mark = Mark.END
        figure = Figure("", [Panel("x", "y", curves)], most_colours=1)
        keep_largest(figure)
        self.assertEqual([curve.mark for curve in curves], [Mark.FAINT_DOTS, Mark.END])

    def test_thinned_curves_keep_ends_and_extremes_in_order(self):
        y = np.sin(np.arange(1000.0))
        y[333], y[777] = 5, -5
        figure = Figure("", [Panel("x", "y", [Curve("c", 0, np.arange(1000.0), y)])])
        thin(40, figure)
        curve = figure.panels[0].curves[0]
        self.assertLessEqual(len(curve.x), 40)
        self.assertEqual((curve.x[0], curve.x[-1], curve.y.max(), curve.y.min()), (0, 999, 5, -5))
        self.assertTrue((np.diff(curve.x) > 0).all())


    def test_thinned_loops_keep_their_area(self):
        phase = np.linspace(0, 1, 5000)**4  # Most samples lie where it starts.
        x = np.sin(np.pi * phase)
        y = x**1.5 + 0.3 * np.sin(2 * np.pi * phase) * x
        figure = Figure("", [Panel("deformation [m]", "contact force [N]", [Curve("c", 0, x, y)])])
        thin(500, figure)
        curve = figure.panels[0].curves[0]
        self.assertLessEqual(len(curve.x), 500)
        self.assertAlmostEqual(np.trapz(curve.y, curve.x) / np.trapz(y, x), 1, delta=0.01)


class CsvTest(unittest.TestCase):

    def test_points_stand_below_the_names_of_the_axes(self):
        curve = Curve("a, b", 0, np.array([0.0, 1.0]), np.array([0.1, 1e-300]))
        self.assertEqual(points_csv(Figure("", [Panel("time [s]", "force [N]", [curve])])),
                         'curve,time [s],force [N]\n"a, b",0,0.1\n"a, b",1,1e-300\n')

    def test_numbers_are_the_shortest_that_read_back(self):
        for value, text in ((0.0001, "1e-04"), (0.0012, "0.0012"), (100000.0, "1e+05"),
                            (123456.0, "123456"), (-0.5, "-0.5"), (1e22, "1e+22"), (3.0, "3"),
                            (5e-324, "5e-324"), (math.nan, "nan")):
            self.assertEqual(number_text(value), text)
        for value in np.random.default_rng(1).normal(size=600) * 10.0**np.arange(-300, 300):
            self.assertEqual(float(number_text(value)), value)


class OverlayTest(unittest.TestCase):

    def test_runs_are_named_by_the_one_parameter_in_which_they_differ(self):
        first, other = sample_run(), sample_run()
        other.job.scenario.contacts[0].restitution = 0.7
        figure = overlay_figure([first, other])
        self.assertTrue(figure.title.endswith(": contacts[0].restitution"))
        self.assertEqual([curve.label for curve in figure.panels[0].curves], ["0.8", "0.7"])
        self.assertEqual(figure.panels[0].y_label, "contact force of A-B [N]")
        self.assertEqual([curve.label for curve in figure.panels[1].curves], ["", ""])

    def test_runs_that_differ_in_more_are_named_by_their_job_too(self):
        first, other = sample_run(), sample_run()
        other.job.name = "jobs/other"
        other.job.scenario.contacts[0].restitution = 0.7
        other.job.scenario.end_time_s = 2
        label = overlay_figure([first, other]).panels[0].curves[1].label
        self.assertEqual(label, "jobs/other, contacts[0].restitution = 0.7, end_time_s = 2")
        with self.assertRaisesRegex(FigureError, "recorded no C.velocity"):
            overlay_figure([first, other], ["C.velocity"])


if __name__ == "__main__":
    unittest.main()
