"""Units of fields and metrics, and factors between units."""

import unittest

from contact.v1 import scenario_pb2
from contactsim.units import factor, field_at, steps_of, unit_of, unit_of_metric


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


if __name__ == "__main__":
    unittest.main()
