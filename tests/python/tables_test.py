"""Tables as loggers write them, for measured data and for loads and motions."""

import pathlib
import tempfile
import unittest

import numpy as np
from contactsim import load_scenario
from contactsim.errors import InvalidScenario
from contactsim.tables import Table, TableMistake

ROWS = [(0.0, 0.0), (1.5, 2.25), (3.0, -4.5), (4.5, 1.0)]


def written(header, separator=",", decimal=".", before="", units="", end="\n"):
    def text(number):
        return str(number).replace(".", decimal)
    lines = [header] + ([units] if units else [])
    lines += [separator.join(text(number) for number in row) for row in ROWS]
    return (before + end.join(lines) + end).encode()


#: The same table as loggers write it.
DIALECTS = {
    "commas": written("time [ms],force [kN]"),
    "semicolons": written("time [ms];force [kN]", ";", ","),
    "tabs": written("time [ms]\tforce [kN]", "\t", ","),
    "spaces": written("  time [ms]    force [kN]", "   ").replace(b"\n", b"\n  "),
    "spaces and decimal commas": written("time (ms) force (kN)", "  ", ","),
    "row of units": written("time,force", units="ms,kN"),
    "row of units in brackets": written("time;force", ";", units="[ms];[kN]"),
    "preamble": written("time [ms],force [kN]", before="Logger 7\nRate,2000\nDate,24.12.25\n\n"),
    "numbers before": written("time [ms];force [kN]", ";", ",", before="Channels;2\nRate;2000\n"),
    "comments": written("time [ms],force [kN]", before="# run 7\n# second line, of it\n"),
    "header in a comment": written("# time [ms],force [kN]"),
    "byte order mark": b"\xef\xbb\xbf" + written("time [ms],force [kN]"),
    "UTF-16, little": b"\xff\xfe" + written("time [ms],force [kN]").decode().encode("utf-16-le"),
    "UTF-16, big": b"\xfe\xff" + written("time [ms],force [kN]").decode().encode("utf-16-be"),
    "Windows": written("time [ms],force [kN]", before="Gr\xf6\xdfe,1\n".encode("latin-1").decode(
        "latin-1"), end="\r\n"),
    "quotes": written('"time [ms]","force [kN]"'),
    "separators at the end": written("time [ms];force [kN];", ";").replace(b"\n1", b";\n1"),
}


class Case(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.path = self.folder / "m.csv"

    def table(self, content, skip=0):
        self.path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return Table(self.path, skip)

    def refused(self, content, column=1):
        with self.assertRaises(TableMistake) as caught:
            self.table(content).numbers(column, False)
        return [mistake.removeprefix(str(self.path)) for mistake in caught.exception.mistakes]


class TableTest(Case):

    def test_each_dialect_is_the_same_table(self):
        for name, content in DIALECTS.items():
            with self.subTest(name):
                table = self.table(content)
                self.assertEqual([c.name for c in table.columns[:2]], ["time", "force"])
                self.assertEqual([c.unit for c in table.columns[:2]], ["ms", "kN"])
                for column in (0, 1):
                    np.testing.assert_array_equal(table.numbers(column, False),
                                                  [row[column] for row in ROWS])

    def test_rows_without_headers_are_a_table(self):
        table = self.table("0 1\n2 3\n4 5\n")
        self.assertEqual(table.numbers(1, False).tolist(), [1, 3, 5])
        self.assertEqual(table.headers(), "1, 2")

    def test_lines_that_are_skipped_are_not_looked_at(self):
        text = "1,2\n3,4\nt,F\n5,6\n7,8\n"
        self.assertEqual(self.table(text, skip=2).numbers(0, False).tolist(), [5, 7])

    def test_mistakes_have_their_line_and_column(self):
        self.assertEqual(self.refused("t,F\n0,1\n1,x\n2,\n3,nan\n4,5\n5,6,7\n6,\"1,5\"\n8,9\n"), [
            ":3:3: expected a number, got 'x'", ":4:3: has no number", ":5:3: is nan",
            ":7:5: has 3 fields; others have 2 — decimals are written with a point",
            ":8:3: expected a number, got '1,5' — decimals are written with a point"])
        self.assertEqual(self.refused("t;F\n0,1;1\n1;2.5\n2;3\n3;4\n", 0), [
            ":2:1: expected a number, got '0,1' — decimals are written with a point"])
        self.assertEqual(self.refused("t;F\nx;1\n1;y\n2;3\n3;4\n"),
                         [":3:3: expected a number, got 'y'"])
        self.assertEqual(self.refused("t,F\n0,0,1,5\n0,5,2,5\n1,0,3,5\n"),
                         [":2:1: has 4 fields; the header has 2"])
        for text in ("", "t,F\n", "t\n1\n2\n", "only words\nand more\n"):
            self.assertIn(":1:1: has no rows of numbers", self.refused(text)[0])

    def test_gaps_are_nan_where_they_may_be(self):
        numbers = self.table("t,F\n0,1\n1,\n2,nan\n3,4\n").numbers(1, True)
        np.testing.assert_array_equal(numbers, [1, np.nan, np.nan, 4])


class FileTableTest(Case):

    def scenario(self, table, kind="table", **keys):
        table = {"file": str(self.path), **table}
        body = {"name": "B", "mass_kg": 1}
        if kind != "table":
            return load_scenario({"bodies": [{"name": "B", "motion": {kind: table}}]})
        return load_scenario({"bodies": [body], "loads": [{"body": "B", "table": table}]})

    def test_each_dialect_becomes_the_same_lists(self):
        for name, content in DIALECTS.items():
            with self.subTest(name):
                self.table(content)
                table = self.scenario({"period_s": 1}).loads[0].table
                self.assertEqual(list(table.times_s), [0, 0.0015, 0.003, 0.0045])
                self.assertEqual(list(table.forces_n), [0, 2250, -4500, 1000])
                self.assertEqual(table.period_s, 1)

    def test_keys_choose_scale_and_shift(self):
        self.table("a,F,t,G\n1,2,-3,4\n2,3,-1,7\n")
        table = self.scenario({"column": "G", "unit": "lbf", "scale": "-2", "time_unit": "ms",
                               "shift_s": 0.25}).loads[0].table
        self.assertEqual(list(table.times_s), [-0.003 + 0.25, -0.001 + 0.25])
        self.assertEqual(list(table.forces_n), [4 * 4.4482216152605 * -2, 7 * 4.4482216152605 * -2])
        table = self.scenario({"column": 2, "time_column": 1}).loads[0].table
        self.assertEqual((list(table.times_s), list(table.forces_n)), ([1, 2], [2, 3]))

    def test_motions_have_their_units(self):
        self.table("t,a [g],v [mph],x [in]\n0,1,2,3\n1,2,3,4\n")
        for kind, column, field, values in (
                ("acceleration_table", "a", "accelerations_m_per_s2", [9.80665, 2 * 9.80665]),
                ("velocity_table", "v", "velocities_m_per_s", [2 * 0.44704, 3 * 0.44704]),
                ("position_table", "x", "positions_m", [3 * 0.0254, 4 * 0.0254])):
            motion = self.scenario({"column": column}, kind).bodies[0].motion
            self.assertEqual(list(getattr(getattr(motion, kind), field)), values)

    def test_files_stand_beside_the_scenario(self):
        self.table(DIALECTS["tabs"])
        path = self.folder / "s.yaml"
        path.write_text("bodies: [{name: B, mass_kg: 1}]\n"
                        "loads: [{body: B, table: {file: m.csv, scale: 2}}]\n")
        self.assertEqual(load_scenario(path).loads[0].table.forces_n[1], 4500)

    def test_what_does_not_fit_is_told(self):
        self.table("t [s],F [V]\n0,1\n1,x\n2,3\n")
        at = "loads[0].table"
        both = self.folder / "both.csv"
        both.write_text("t [s],F [N]\n0,x\ny,1\n1,2,3\n2,3\n3,4\n4,5\n5,6\n")
        with self.assertRaises(InvalidScenario) as caught:
            self.scenario({"file": str(both)})
        self.assertEqual(len(caught.exception.violations), 3, "one a place, of both columns")
        for table, words in (
                ({}, f"{at}.unit: 'V' is no unit of a quantity in N — one of N, kN"),
                ({"unit": "mm"}, f"{at}.unit: 'mm' is no unit"),
                ({"unit": "N"}, f"{at}: {self.path}:3:3: expected a number, got 'x'"),
                ({"column": "G"}, f"{at}.column: {self.path} has no column 'G' — it has t"),
                ({"scale": "much"}, f"{at}.scale: expected a number, got 'much'"),
                ({"file": "none.csv"}, f"{at}.file: cannot read none.csv: No such file"),
                ({"points": []}, f"{at}.points: cannot stand beside file"),
                ({"colum": 1, "unit": "N"}, f"{at}.colum: unknown field")):
            with self.assertRaises(InvalidScenario) as caught:
                self.scenario(table)
            self.assertIn(words, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
