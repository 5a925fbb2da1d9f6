"""Axes show readable units; sizes, fonts and labels are read and written as people write them."""

import math
import unittest

from contact.v1 import scenario_pb2
from contactsim.figures import FigureError
from contactsim.figures.axes import AxisUnit, chosen_unit, named_unit, readable_unit, unit_of
from contactsim.figures.draw import typeset
from contactsim.figures.figure import Curve, Mark
from contactsim.figures.look import Look, parse_font, parse_size
from contactsim.figures.words import WORDS
from contactsim.labels import axis_label, metric_label


class ReadableUnitTest(unittest.TestCase):

    def check(self, label, largest, shown, size):
        unit = readable_unit(label, largest)
        self.assertEqual(unit.label, shown)
        self.assertTrue(math.isclose(unit.size, size), unit)

    def test_prefix_leaves_one_to_three_digits(self):
        self.check("time [s]", 0.004, "time [ms]", 1e-3)
        self.check("deformation [m]", 2.3e-5, "deformation [µm]", 1e-6)
        self.check("force [N]", 10_507, "force [kN]", 1e3)
        self.check("velocity [m/s]", 0.02, "velocity [mm/s]", 1e-3)
        self.check("μ [N·s/m^(n+1)]", 2.3e8, "μ [MN·s/m^(n+1)]", 1e6)

    def test_numbers_from_a_tenth_to_a_thousand_need_none(self):
        for largest in (0.1, 1, 999.9):
            self.check("velocity [m/s]", largest, "velocity [m/s]", 1)
        self.check("force [N]", 1000, "force [kN]", 1e3)
        self.check("deformation [m]", 1e-3, "deformation [mm]", 1e-3)

    def test_what_takes_no_prefix_has_a_power_of_ten(self):
        self.check("error [1]", 2e-6, "error [10^-6]", 1e-6)
        self.check("mass [kg]", 3e-5, "mass [10^-6 kg]", 1e-6)
        self.check("area [m^2]", 3e-5, "area [10^-6 m^2]", 1e-6)
        self.check("iterations [1]", 4000, "iterations [1]", 1)

    def test_nobody_says_kiloseconds(self):
        self.check("time [s]", 3600, "time [s]", 1)
        self.check("time [s]", 2e6, "time [10^6 s]", 1e6)

    def test_labels_without_unit_and_axes_without_numbers_stay_as_they_are(self):
        self.check("pass", 1e6, "pass", 1)
        for none in (0, math.nan, math.inf):
            self.check("force [N]", none, "force [N]", 1)

    def test_logarithmic_axes_have_no_prefix(self):
        self.assertEqual(chosen_unit("μ [N·s/m]", 1e10, True, ()), AxisUnit(1, "μ [N·s/m]"))

    def test_units_may_be_named(self):
        self.assertEqual(named_unit("force [N]", "kN"), AxisUnit(1e3, "force [kN]"))
        for micro in ("um", "µm", "μm"):
            self.assertEqual(named_unit("deformation [m]", micro).label, "deformation [µm]")
        for label, unit in (("force [N]", "kg"), ("force [N]", "xN"), ("pass", "ms")):
            self.assertIsNone(named_unit(label, unit))
        self.assertEqual(unit_of("cycles[B1-B2] of a [m/s]"), "m/s")
        self.assertEqual(unit_of("cycles[0] of"), "")

    def test_powers_and_indices_are_typeset(self):
        self.assertEqual(typeset("error [10^-6]"), "error [10⁻⁶]")
        self.assertEqual(typeset("μ [N·s/m^(n+1)]"), "μ [N·s/mⁿ⁺¹]")
        self.assertEqual(typeset("k [N/m^1.5]"), "k [N/m¹·⁵]")
        self.assertEqual(typeset("|W_r/W_c + ε²|"),
                         r"|W$_\mathrm{r}$/W$_\mathrm{c}$ + ε²|")
        self.assertEqual(typeset("a $ b_c"), r"a \$ b_c")


class LookTest(unittest.TestCase):

    def test_sizes_have_units(self):
        self.assertEqual(parse_size("3.4x2.5"), (3.4, 2.5))
        width, height = parse_size("254x127mm")
        self.assertAlmostEqual(width, 10)
        self.assertAlmostEqual(height, 5)
        for wrong in ("4", "4x", "x3", "4x3m", "0.5x3", "4x101", "-1x3", ""):
            with self.assertRaisesRegex(FigureError, "--size"):
                parse_size(wrong)

    def test_fonts_have_a_family_a_size_or_both(self):
        self.assertEqual(parse_font("Times,9"), ("Times", 9))
        self.assertEqual(parse_font("Nimbus Sans"), ("Nimbus Sans", 0))
        self.assertEqual(parse_font("9.5"), ("", 9.5))
        for wrong in ("", ",", "1", "'", "Times,1", "Times,9,9"):
            with self.assertRaisesRegex(FigureError, "--font"):
                parse_font(wrong)

    def lines(self, look, count):
        return [look.line(Curve("", colour, None, None)) for colour in range(count)]

    def test_colours_come_again_with_other_dashes(self):
        many = len(WORDS["palette"]) * len(WORDS["dashes"])
        styles = {str(sorted(style.items())) for style in self.lines(Look(), many)}
        self.assertEqual(len(styles), many)

    def test_paper_has_no_colours_and_tells_ten_curves_apart(self):
        styles = self.lines(Look(paper=True), 10)
        self.assertEqual(len({str(sorted(style.items())) for style in styles}), 10)
        self.assertLessEqual({style["color"] for style in styles}, set(WORDS["paper_inks"]))
        beside = Look(paper=True).line(Curve("", 1, None, None, Mark.DASHED))
        self.assertNotIn(beside, styles)


class LabelsTest(unittest.TestCase):

    def setUp(self):
        base = scenario_pb2.Scenario()
        base.bodies.add(name="B1")
        base.bodies.add(name="B2")
        base.contacts.add(between=["B1", "B2"])
        base.contacts.add(name="end", between=["B2"]).wall.position_m = 1
        base.loads.add(body="B2").constant.force_n = 1
        self.sweep = scenario_pb2.Sweep(base=base)

    def test_axes_name_the_quantity_its_owner_and_its_unit(self):
        for field, label in (
                ("bodies[0].velocity_m_per_s", "velocity of B1 [m/s]"),
                ("contacts[0].restitution", "restitution of B1-B2 [1]"),
                ("contacts[1].wall.position_m", "wall position of end [m]"),
                ("contacts[*].stiffness", "stiffness of all contacts [N/m^exponent]"),
                ("loads[0].constant.force_n", "constant force of loads[0] on B2 [N]"),
                ("end_time_s", "end time [s]"),
                ("solver.max_iterations", "solver max iterations"),
                ("contacts[0].damping", "damping of B1-B2"),
                ("bodies[7].mass_kg", "mass of bodies[7] [kg]"),
                ("bodies[0].colour", "bodies[0].colour"), ("bodies[", "bodies[")):
            self.sweep.axes.add(field=field)
            self.assertEqual(axis_label(self.sweep, len(self.sweep.axes) - 1), label)
        self.sweep.axes.add(field="end_time_s", label="var:end")
        self.assertEqual(axis_label(self.sweep, len(self.sweep.axes) - 1), "var:end")

    def test_metrics_name_the_quantity_its_owner_and_its_unit(self):
        for metric, label in (
                ("final_bodies[B3].velocity_m_per_s", "final velocity of B3 [m/s]"),
                ("cycles[B1-B2].mu_over_k_s_per_m", "mu over k of B1-B2 [s/m]"),
                ("cycles[2].peak_force_n", "peak force of cycles[2] [N]"),
                ("cycles[B1-B2].restitution_out", "restitution out, B1-B2 [1]"),
                ("groups[B1-B2].mu", "group mu of B1-B2 [N·s/m^(n+1)]"),
                ("iterations", "iterations"), ("summary.energy_residual", "energy residual [1]"),
                ("convergence", "convergence"), ("nonsense", "nonsense"), ("summary", "summary"),
                ("cycles[A-B].last.mu", "cycles[A-B].last.mu")):
            self.assertEqual(metric_label(metric), label)


if __name__ == "__main__":
    unittest.main()
