"""contactctl export to MAT files and protobuf, and with fewer digits."""

import csv
import io
import json
import shutil
import subprocess
import unittest

import numpy as np
import scipy.io
from contact.v1 import event_pb2, job_pb2
from cli_case import CHAIN, CliTest
from contactd import PATIENCE_S


def delimited(data):
    """The messages of a file, each after its length as a varint."""
    at = 0
    while at < len(data):
        size = shift = 0
        while True:
            byte = data[at]
            at += 1
            size |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80:
                break
        yield data[at:at + size]
        at += size


class ExportFormsTest(CliTest):

    def setUp(self):
        super().setUp()
        self.name = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        self.job = self.server.get(self.name)

    def export(self, file, *flags, name=None):
        path = self.folder / file
        self.run_it("export", name or self.name, "-f", path, *flags)
        return path

    def rows(self, *flags):
        return list(csv.reader(io.StringIO(
            self.run_it("export", self.name, "-o", "csv", *flags)[0])))

    def columns(self, *flags):
        header, *rows = self.rows(*flags)
        return dict(zip((name.split(" [")[0] for name in header), zip(*rows)))

    def test_mat_has_every_table_as_csv_has_it(self):
        mat = scipy.io.loadmat(self.export("a.mat"), simplify_cells=True)
        for table in ("series", "cycles", "groups", "iterations", "bodies"):
            for name, texts in self.columns("--table", table).items():
                values = mat[table][name.replace(".", "_").replace("-", "_")]
                if np.asarray(values).dtype.kind in "OU":  # Empty ones are read as empty arrays.
                    self.assertEqual([str(v) if np.size(v) else "" for v in values], list(texts))
                else:
                    texts = [text or "nan" for text in texts]  # What is not known has no text.
                    np.testing.assert_array_equal(values, np.array(texts, float), name)

    def test_mat_tells_units_names_and_source(self):
        mat = scipy.io.loadmat(self.export("a.mat"), simplify_cells=True)
        self.assertEqual(mat["units"]["series"]["B1_B2_contact_force"], "N")
        self.assertEqual(mat["names"]["series"]["B1_B2_contact_force"], "B1-B2.contact_force")
        self.assertEqual(mat["descriptions"]["cycles"]["delta_max"], "largest deformation")
        self.assertEqual(mat["provenance"]["scenario_sha256"], self.job.spec_sha256)
        self.assertEqual(json.loads(mat["provenance"]["scenario"])["title"], "Triple-ball chain")
        for table in ("series", "cycles", "groups", "iterations", "bodies"):
            self.assertEqual(mat["units"][table].keys(), mat[table].keys())

    def test_mat_is_the_same_each_time_and_of_version_5(self):
        data = self.export("a.mat").read_bytes()
        self.assertTrue(data.startswith(b"MATLAB 5.0 MAT-file"))
        self.assertEqual(self.export("b.mat").read_bytes(), data)

    def test_names_that_become_the_same_stay_apart(self):
        name = self.run_it("run", CHAIN, "--set", "bodies[0].name=B-1", "--set",
                           "bodies[1].name=B_1", "--set", "contacts[0].between=[B-1,B_1]", "--set",
                           "contacts[1].between=[B_1,B3]", "-o", "name")[0].strip()
        mat = scipy.io.loadmat(self.export("a.mat", name=name), simplify_cells=True)
        names = mat["names"]["series"]
        self.assertEqual((names["B_1_velocity"], names["B_1_velocity_2"]),
                         ("B-1.velocity", "B_1.velocity"))

    def test_mat_has_the_part_that_is_asked_for_and_titles_of_all_alphabets(self):
        name = self.run_it("run", CHAIN, "--set", "title=Stöße μ", "-o", "name")[0].strip()
        mat = scipy.io.loadmat(self.export("a.mat", "--channels", "B1.velocity", "--every", 100,
                                           name=name), simplify_cells=True)
        self.assertEqual(list(mat["series"]), ["time", "B1_velocity"])
        self.assertEqual(len(mat["series"]["time"]), 11)
        self.assertEqual(mat["provenance"]["title"], "Stöße μ")

    def test_mat_of_a_run_without_contact_has_empty_tables(self):
        name = self.run_it("run", CHAIN, "--set", "bodies[0].velocity_m_per_s=0",
                           "--set", "output.ledger_only=true", "-o", "name")[0].strip()
        mat = scipy.io.loadmat(self.export("a.mat", name=name), simplify_cells=True)
        self.assertEqual(np.size(mat["cycles"]["mu"]), 0)
        self.assertEqual(len(mat["bodies"]["position"]), 3)

    @unittest.skipUnless(shutil.which("octave-cli"), "octave-cli is not installed")
    def test_octave_reads_the_mat_file(self):
        path = self.export("a.mat")
        script = f"""load('{path}');
            printf('%.17g\\n', cycles.mu);
            printf('%s\\n', cycles.contact{{2}}, units.cycles.mu, provenance.job);
            printf('%d %d\\n', size(series.time));
            printf('%.17g\\n', series.B3_velocity(end));"""
        said = subprocess.run(["octave-cli", "--quiet", "--norc", "--eval", script], check=True,
                              capture_output=True, text=True, timeout=PATIENCE_S).stdout.splitlines()
        self.assertEqual([float(line) for line in said[:2]], [c.mu for c in self.job.cycles])
        self.assertEqual(said[2:5], ["B2-B3", "N·s/m^(n+1)", self.name])
        self.assertEqual(said[5], "1001 1")
        self.assertEqual(float(said[6]), float(self.columns()["B3.velocity"][-1]))

    def test_protobuf_is_the_job_and_then_its_events(self):
        first, *rest = delimited(self.export("a.pb").read_bytes())
        self.assertEqual(job_pb2.Job.FromString(first), self.job)
        written = [event_pb2.Event.FromString(data) for data in rest]
        heard = [event for event in self.server.events(self.name)
                 if event.WhichOneof("payload") != "bookmark"]
        self.assertEqual(written, heard)
        kinds = {event.WhichOneof("payload") for event in written}
        self.assertLessEqual({"frame_chunk", "iteration", "cycle", "state_changed"}, kinds)

    def test_fewer_digits_are_the_rounded_numbers(self):
        exact, rounded = self.columns("--table", "cycles"), self.columns("--table", "cycles",
                                                                         "--precision", 4)
        for name, texts in exact.items():
            for text, short in zip(texts, rounded[name]):
                try:
                    np.testing.assert_equal(float(short), float(f"{float(text):.4g}"), name)
                except ValueError:
                    self.assertEqual(short, text)
        line = self.run_it("export", self.name, "-o", "jsonl", "--table", "cycles", "--precision",
                           3)[0].splitlines()[0]
        self.assertEqual(json.loads(line)["peak_force [N]"],
                         float(f"{self.job.cycles[0].peak_force_n:.3g}"))

    def test_all_digits_give_the_same_number_back(self):
        for flags in ((), ("--precision", 17)):
            values = [float(text) for text in self.columns("--table", "cycles", *flags)["mu"]]
            self.assertEqual(values, [c.mu for c in self.job.cycles])

    def test_t0_and_t1_are_from_and_to(self):
        part = self.rows("--t0", "1e-3", "--t1", "2e-3")
        self.assertEqual(part, self.rows("--from", "1e-3", "--to", "2e-3"))
        self.assertEqual((part[1][0], part[-1][0]), ("0.001", "0.002"))

    def test_wrong_uses_are_told(self):
        for form in ("mat", "protobuf"):
            said = self.run_it("export", self.name, "-o", form, code=2)[1]
            self.assertIn(f"{form} is no text; give a file with -f", said)
            _, said = self.run_it("export", self.name, "-o", form, "-f", "/nowhere/a", code=11)
            self.assertIn("/nowhere/a: No such file or directory", said)
        self.run_it("export", self.name, "-f", self.folder / "a.pb", "--every", 2, code=2)
        self.run_it("export", self.name, "-f", self.folder / "a.mat", "--precision", 4, code=2)
        self.run_it("export", self.name, "-o", "csv", "--precision", 18, code=2)


if __name__ == "__main__":
    unittest.main()
