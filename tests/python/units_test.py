"""Units of fields and metrics, and factors between units."""

import unittest

from contact.v1 import scenario_pb2
from contactsim.units import (factor, field_at, in_si, steps_of, unit_of, unit_of_metric,
                              usual_units)


class UnitsTest(unittest.TestCase):

    def test_paths_are_names_with_brackets(self):
        self.assertEqual(steps_of("contacts[A.1-B].restitution"),
                         [("contacts", "A.1-B"), ("restitution", "")])
        for text in ("", "a..b", ".a", "a.", "a[", "a]b", "a[].b"):
            self.assertEqual(steps_of(text), [], text)

    def test_fields_have_the_unit_of_their_rule_or_name(self):
        for path, unit in (("bodies[0].velocity_m_per_s", "m/s"), ("bodies[*].mass_kg", "kg"),
                           ("contacts[A-B].stiffness", "N/m^exponent"),
                           ("supports[0].damping_n_s_per_m", "N·s/m"),
                           ("contacts[0].restitution", "1"), ("contacts[0].damping", ""),
                           ("nothing", "")):
            field = field_at(scenario_pb2.Scenario.DESCRIPTOR, path)
            self.assertEqual(unit_of(field), unit, path)

    def test_metrics_have_the_unit_of_the_number_at_their_end(self):
        for metric, unit in (("iterations", "1"), ("kinetic_energy_j", "J"),
                             ("cycles[B1-B2].last.peak_force_n", "N"), ("cycles.count", "1"),
                             ("final_bodies[B1].velocity_m_per_s", "m/s"), ("convergence", ""),
                             ("cycles[0].mu", "N·s/m^(n+1)"),
                             ("series[B1.acceleration].max", "m/s²"),
                             ("series[B1.acceleration].time_of_max", "s")):
            self.assertEqual(unit_of_metric(metric), unit, metric)

    def test_factors_are_those_of_prefixes_and_quotients(self):
        for unit, si, value in (("mm", "m", 1e-3), ("kN", "N", 1e3), ("ms", "s", 1e-3),
                                ("mm/s", "m/s", 1e-3), ("km/h", "m/s", 1 / 3.6), ("s", "s", 1)):
            self.assertAlmostEqual(factor(unit, si), value, places=15)
        for unit, si in (("m", "s"), ("m", "m/s"), ("inch", "m"), ("mmm", "m")):
            self.assertIsNone(factor(unit, si))

    def test_units_of_other_systems_are_exact(self):
        for unit, si, value in (("g", "m/s^2", 9.80665), ("gn", "m/s²", 9.80665),
                                ("mm/s2", "m/s^2", 1e-3), ("ft/s^2", "m/s^2", 0.3048),
                                ("mph", "m/s", 0.44704), ("in", "m", 0.0254),
                                ("kgf", "N", 9.80665), ("lbf", "N", 4.4482216152605)):
            self.assertEqual(factor(unit, si), value, unit)
        self.assertIsNone(factor("g", "m/s"))
        self.assertIsNone(factor("m/s", "m/s^2"))
        for si in ("s", "m", "m/s", "m/s^2", "N"):
            for unit in usual_units(si).split(", "):
                self.assertIsNotNone(factor(unit, si), unit)

    def test_milliseconds_are_the_same_numbers_as_seconds(self):
        for i in range(1000):
            self.assertEqual(in_si(float(i), 1e-3), i / 1000)


if __name__ == "__main__":
    unittest.main()
