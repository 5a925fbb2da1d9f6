"""Axes show readable units; sizes, fonts and labels are read and written as people write them."""

import json
import math
import pathlib
import re
import unittest

from contact.v1 import event_pb2, field_rules_pb2, job_pb2, scenario_pb2
from contactsim.figures import FigureError
from contactsim.figures.axes import AxisUnit, chosen_unit, named_unit, readable_unit, unit_of
from contactsim.figures.figure import Curve, Mark
from contactsim.figures.look import PRINT, Look, parse_font, parse_size
from contactsim.figures.scale import typeset
from contactsim.figures.words import WORDS
from contactsim.labels import axis_label, metric_label
from contactsim.units import ENDINGS
from google.protobuf import json_format

TESTS = pathlib.Path(__file__).parents[1]
PRINTED = json.loads((TESTS / "reference/words.json").read_text("utf-8"))


def fields_of(messages):
    """The names of all numbers in messages and in those inside them."""
    names = set()
    for message in messages:
        names |= {field.name for field in message.fields
                  if field.cpp_type == field.CPPTYPE_DOUBLE} | fields_of(message.nested_types)
    return names


class ReadableUnitTest(unittest.TestCase):

    def test_accelerations_may_be_in_g(self):
        unit = named_unit("acceleration [m/s^2]", "g")
        self.assertEqual((unit.size, unit.label), (9.80665, "acceleration [g]"))
        self.assertIsNone(named_unit("velocity [m/s]", "g"))

    def test_numbers_have_few_digits_as_in_the_dashboard(self):
        for label, largest, shown, size in PRINTED["units"]:
            unit = readable_unit(label, largest)
            self.assertEqual(unit.label, shown)
            self.assertTrue(math.isclose(unit.size, size), unit)

    def test_axes_without_numbers_stay_as_they_are(self):
        for none in (math.nan, math.inf):
            self.assertEqual(readable_unit("force [N]", none), AxisUnit(1, "force [N]"))

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
        for label, shown in PRINTED["typeset"]:
            self.assertEqual(typeset(label), shown)
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
        styles = self.lines(Look(style="paper"), 10)
        self.assertEqual(len({str(sorted(style.items())) for style in styles}), 10)
        self.assertLessEqual({style["color"] for style in styles}, set(WORDS["paper_inks"]))
        beside = Look(style="paper").line(Curve("", 1, None, None, Mark.DASHED))
        self.assertNotIn(beside, styles)
        two = [Look(style="paper").line(Curve("", colour, None, None, Mark.DASHED)) for colour in (0, 1)]
        self.assertNotEqual(*two)

    def test_figures_for_a_publisher_have_its_column_and_letters(self):
        for style, width, points in (("springer", 84, 8), ("elsevier", 90, 7), ("ieee", 88.9, 8),
                                     ("aps", 86, 8)):
            look = Look(style=style)
            self.assertAlmostEqual(look.inches(1)[0] * 25.4, width)
            self.assertEqual(look.rc["font.size"], points)
            self.assertTrue(look.paper)
        self.assertEqual(set(PRINT), {"paper", "springer", "elsevier", "ieee", "aps"})
        self.assertEqual(Look(style="ieee", family="Courier").rc["font.family"][0], "Courier")


class LabelsTest(unittest.TestCase):

    def test_axes_name_the_quantity_its_owner_and_its_unit_as_in_the_dashboard(self):
        sweep = json_format.ParseDict({"base": PRINTED["base"]}, scenario_pb2.Sweep())
        for field, label in PRINTED["axes"]:
            sweep.axes.add(field=field)
            self.assertEqual(axis_label(sweep, len(sweep.axes) - 1), label)
        sweep.axes.add(field="end_time_s", label="var:end")
        self.assertEqual(axis_label(sweep, len(sweep.axes) - 1), "var:end")

    def test_names_end_as_in_the_tables_of_the_server(self):
        server = (TESTS.parent / "server/wire/column_name.cpp").read_text("utf-8")
        self.assertEqual(re.findall(r'\{"(_\w+)", "(.+?)"\}', server), ENDINGS)

    def test_every_ending_is_one_that_names_of_the_contract_have(self):
        names = set()
        for file in (scenario_pb2, job_pb2, event_pb2):
            names |= fields_of(file.DESCRIPTOR.message_types_by_name.values())
        found = [next((ending for ending, _ in ENDINGS if name.endswith(ending)), "")
                 for name in names]
        self.assertEqual(set(found) - {""}, {ending for ending, _ in ENDINGS})

    def test_channels_and_their_units_are_those_that_the_server_records(self):
        server = (TESTS.parent / "server/wire/scenario/channels.cpp").read_text("utf-8")
        channels = dict(re.findall(r'Channel\([^()]+, "(\w+)", "([^"]+)"\)', server))
        listed = re.search(r"for \(const char\* quantity :\s+\{([^}]+)\}\)", server).group(1)
        channels |= {name: "J" for name in re.findall(r'"(\w+)"', listed)}
        self.assertEqual(WORDS["channels"], channels)

    def test_contacts_have_as_many_samples_of_their_own_as_the_contract_says(self):
        field = scenario_pb2.Output.DESCRIPTOR.fields_by_name["samples_per_contact"]
        rule = field.GetOptions().Extensions[field_rules_pb2.rule]
        self.assertEqual(WORDS["coarse"]["own"], rule.default_number)

    def test_metrics_name_the_quantity_its_owner_and_its_unit_as_in_the_dashboard(self):
        for metric, label in PRINTED["metrics"]:
            self.assertEqual(metric_label(metric), label)


if __name__ == "__main__":
    unittest.main()
