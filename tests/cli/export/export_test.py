"""contactctl export: what is written is what the job recorded, with units."""

import csv
import hashlib
import io
import json
import re
import shutil
import subprocess
import unittest

import h5py
import netCDF4
import numpy as np
import pandas
import xarray
from cli_case import CHAIN, REFERENCE, CliTest
from contactd import PATIENCE_S


class ExportTest(CliTest):

    def setUp(self):
        super().setUp()
        self.name = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        self.job = self.server.get(self.name)

    def recorded(self):
        """The trajectory as the server sends it, by name of column."""
        columns = {}
        for event in self.server.events(self.name, kinds=["frame_chunk"]):
            for column in event.frame_chunk.columns:
                columns.setdefault(column.name, []).append(np.frombuffer(column.values, "<f8"))
        return {name: np.concatenate(parts) for name, parts in columns.items()}

    def rows(self, *flags):
        return list(csv.reader(io.StringIO(
            self.run_it("export", self.name, "-o", "csv", *flags)[0])))

    def test_csv_gives_every_double_back(self):
        header, *rows = self.rows()
        values = np.array(rows, dtype=float).T
        recorded = self.recorded()
        self.assertEqual([name.split(" [")[0] for name in header], list(recorded))
        for column, expected in zip(values, recorded.values()):
            np.testing.assert_array_equal(column, expected)

    def test_every_column_of_numbers_names_its_unit(self):
        for table in ("series", "cycles", "groups", "iterations", "bodies"):
            header, first, *_ = self.rows("--table", table)
            for name, value in zip(header, first):
                if re.fullmatch(r"-?[0-9.e+-]+|nan", value):
                    self.assertRegex(name, r" \[[^]]+\]$")
                else:
                    self.assertIn(name, ("contact", "kind", "end", "status", "growth", "update",
                                         "name", "other_roots [N·s/m^(n+1)]"))

    def test_every_number_of_the_ledger_is_exported(self):
        for table in ("cycles", "groups"):
            header, *rows = self.rows("--table", table)
            entries = getattr(self.job, table)
            fields = entries[0].DESCRIPTOR.fields
            self.assertEqual((len(header), len(rows)), (len(fields), len(entries)))
            for row, entry in zip(rows, entries):
                for text, field in zip(row, fields):
                    value = getattr(entry, field.name)
                    if field.has_presence and not entry.HasField(field.name):
                        value = float("nan")
                    if field.enum_type:
                        value = field.enum_type.values_by_number[value].name
                    given = text
                    if field.label == field.LABEL_REPEATED:
                        given, value = [float(number) for number in text.split()], list(value)
                    elif not isinstance(value, str):
                        given = float(text)
                    np.testing.assert_equal(given, value)  # NaN equals NaN.

    def test_larger_roots_of_a_group_are_in_every_form(self):
        case = REFERENCE.parent / "cases/f4-two-answers-press40024-a.json"
        name = self.run_it("run", case, "-o", "name")[0].strip()
        root, = self.server.get(name).groups[0].other_roots
        self.assertIn(f"so has {root:.6g}", self.run_it("describe", name)[0])
        header = "other_roots [N·s/m^(n+1)]"
        text = self.run_it("export", name, "-o", "csv", "--table", "groups")[0]
        self.assertEqual(pandas.read_csv(io.StringIO(text))[header][0], root)
        row = json.loads(self.run_it("export", name, "-o", "jsonl", "--table", "groups")[0].split("\n")[0])
        self.assertEqual(float(row[header]), root)
        self.run_it("artifact", "get", name, "groups.csv", "-f", self.folder / "groups.csv")
        self.assertEqual(pandas.read_csv(self.folder / "groups.csv")[header][0], root)
        self.run_it("export", name, "-f", self.folder / "roots.nc")
        with netCDF4.Dataset(self.folder / "roots.nc") as file:
            self.assertEqual(float(file["groups/other_roots"][0]), root)
        self.run_it("report", name, "-f", self.folder / "r.html")
        self.assertIn(f"{root:.6e}", (self.folder / "r.html").read_text("utf-8"))
        self.run_it("compare", name, name)

    def test_every_csv_of_a_job_names_a_column_alike(self):
        def read(file):
            return pandas.read_csv(file, float_precision="round_trip")

        path, artifact = self.folder / "cycles.csv", self.folder / "artifact.csv"
        self.run_it("export", self.name, "-f", path, "--table", "cycles")
        self.assertEqual(list(read(path)["contact"]), ["B1-B2", "B2-B3"])
        self.run_it("artifact", "get", self.name, "cycles.csv", "-f", artifact)
        pandas.testing.assert_frame_equal(read(path), read(artifact), check_exact=True)
        self.run_it("export", self.name, "-f", path, "--table", "groups")
        self.run_it("artifact", "get", self.name, "groups.csv", "-f", artifact)
        pandas.testing.assert_frame_equal(read(path), read(artifact), check_exact=True)
        printed = self.run_it("series", self.name, "--raw", "-o", "csv")[0]
        self.assertEqual(printed, self.run_it("export", self.name, "-o", "csv")[0])
        self.run_it("artifact", "get", self.name, "trajectory.csv", "-f", artifact)
        pandas.testing.assert_frame_equal(read(io.StringIO(printed)), read(artifact),
                                          check_exact=True)

    def test_comments_are_skipped_by_readers_of_csv(self):
        plain, _ = self.run_it("export", self.name, "-o", "csv")
        printed, _ = self.run_it("export", self.name, "-o", "csv", "--comments")
        comments = printed.removesuffix(plain).splitlines()
        self.assertEqual(comments[0], "# title: Triple-ball chain")
        self.assertIn(f"# scenario_sha256: {self.job.spec_sha256}", comments)
        self.assertTrue(pandas.read_csv(io.StringIO(printed), comment="#").equals(
            pandas.read_csv(io.StringIO(plain))))
        series, _ = self.run_it("series", self.name, "--raw", "-o", "csv", "--comments")
        self.assertEqual(series.splitlines()[:len(comments)], comments)
        self.run_it("export", self.name, "-o", "jsonl", "--comments", code=2)

    def test_json_lines_hold_a_row_each(self):
        printed, _ = self.run_it("export", self.name, "-o", "jsonl", "--table", "iterations")
        rows = [json.loads(line) for line in printed.splitlines()]
        events = self.server.events(self.name, kinds=["iteration"])
        unknowns = [u for e in events for u in e.iteration.unknowns]
        self.assertEqual([row["mu [N·s/m^(n+1)]"] for row in rows], [u.mu for u in unknowns])
        self.assertEqual([row["accepted [1]"] for row in rows][-1], 1)

    def test_netcdf_holds_all_tables_with_units_and_provenance(self):
        path = self.folder / "chain.nc"
        _, said = self.run_it("export", self.name, "-f", path)
        self.assertIn("1001 samples, 2 cycles", said)
        with netCDF4.Dataset(path) as data:
            self.assertEqual(data.data_model, "NETCDF4")
            for group in data.groups.values():
                self.assertTrue(group.variables)
                for variable in group.variables.values():
                    self.assertTrue(variable.units)
                    self.assertTrue(variable.long_name)
            for name, expected in self.recorded().items():
                np.testing.assert_array_equal(data["series"][name][:], expected)
            self.assertEqual(data["series"]["B1-B2.contact_force"].units, "N")
            self.assertEqual(list(data["cycles"]["contact"][:]), ["B1-B2", "B2-B3"])
            self.assertEqual(list(data["cycles"]["mu"][:]), [c.mu for c in self.job.cycles])
            self.assertEqual(list(data["groups"]["mu"][:]), [g.mu for g in self.job.groups])
            scenario = self.job.scenario.SerializeToString(deterministic=True)
            self.assertEqual(data.scenario_sha256, hashlib.sha256(scenario).hexdigest())
            self.assertEqual(json.loads(data.scenario)["title"], "Triple-ball chain")
            self.assertEqual(data.version, self.job.server_version)
            self.assertEqual(data.job, self.name)
            self.assertEqual(data.scenario_sha256, self.job.spec_sha256)
            self.assertEqual(data.revision, self.job.server_revision)
            solver = json.loads(data.solver)
            self.assertEqual((solver["method"], solver["update"]), ("ADAPTIVE", "NEWTON_COUPLED"))

    def test_xarray_and_h5py_read_the_same_doubles(self):
        path = self.folder / "chain.nc"
        self.run_it("export", self.name, "-f", path)
        recorded = self.recorded()
        with xarray.open_dataset(path, group="series") as series:
            velocity = series["B3.velocity"]
            self.assertEqual((velocity.dims, velocity.attrs["units"]), (("time",), "m/s"))
            np.testing.assert_array_equal(velocity, recorded["B3.velocity"])
            np.testing.assert_array_equal(velocity.time, recorded["time"])
        with h5py.File(path) as file:
            np.testing.assert_array_equal(file["series/B3.velocity"], recorded["B3.velocity"])
            self.assertEqual(file["cycles/mu"].attrs["units"], "N·s/m^(n+1)".encode())
            self.assertEqual(file.attrs["job"], self.name.encode())

    def test_octave_reads_the_same_doubles(self):
        if not shutil.which("octave-cli"):
            self.skipTest("octave-netcdf is not installed")
        path = self.folder / "chain.nc"
        self.run_it("export", self.name, "-f", path)
        script = """pkg load netcdf
            printf("%.17g\\n", ncread(FILE, "/cycles/mu"));
            printf("%.17g\\n", ncread(FILE, "/series/B1-B2.contact_force"));
            printf("%s\\n", ncreadatt(FILE, "/series/B1-B2.contact_force", "units"));
            printf("%s\\n", ncreadatt(FILE, "/", "scenario_sha256"));"""
        run = subprocess.run(["octave-cli", "--quiet", "--norc", "--eval",
                              f"FILE = '{path}'; {script}"],
                             capture_output=True, text=True, timeout=PATIENCE_S)
        if "package is not installed" in run.stderr or "not found" in run.stderr:
            self.skipTest("octave-netcdf is not installed")
        *numbers, unit, digest = run.stdout.splitlines()
        self.assertEqual((unit, digest), ("N", self.job.spec_sha256), run.stderr)
        self.assertEqual(list(map(float, numbers[:2])), [c.mu for c in self.job.cycles])
        np.testing.assert_array_equal(list(map(float, numbers[2:])),
                                      self.recorded()["B1-B2.contact_force"])

    def test_part_of_the_series_is_exact(self):
        recorded = self.recorded()
        inside = (recorded["time"] >= 1e-3) & (recorded["time"] <= 2e-3)
        header, *rows = self.rows("--channels", "B2.velocity,B1-B2.contact_force", "--from", "1e-3",
                                  "--to", "2e-3", "--every", 3)
        self.assertEqual(header, ["time [s]", "B2.velocity [m/s]", "B1-B2.contact_force [N]"])
        for values, name in zip(np.array(rows, dtype=float).T,
                                ("time", "B2.velocity", "B1-B2.contact_force")):
            np.testing.assert_array_equal(values, recorded[name][inside][::3])

    def test_thinned_series_keeps_the_peak(self):
        _, *rows = self.rows("--channels", "B1-B2.contact_force", "--max-points", 20)
        self.assertLessEqual(len(rows), 20)
        self.assertEqual(max(float(row[1]) for row in rows),
                         self.recorded()["B1-B2.contact_force"].max())

    def test_part_reaches_netcdf_and_ncdump_reads_it(self):
        path = self.folder / "part.nc"
        self.run_it("export", self.name, "-f", path, "--channels", "B1.velocity", "--every", 100)
        with netCDF4.Dataset(path) as data:
            self.assertEqual(list(data["series"].variables), ["time", "B1.velocity"])
            np.testing.assert_array_equal(data["series"]["B1.velocity"][:],
                                          self.recorded()["B1.velocity"][::100])
        if shutil.which("ncdump"):
            dump = subprocess.run(["ncdump", "-p", "9,17", path], check=True, capture_output=True,
                                  text=True, timeout=PATIENCE_S).stdout
            self.assertIn('B1.velocity:units = "m/s"', dump)
            self.assertIn("scenario_sha256", dump)

    @unittest.skipUnless(shutil.which("octave-cli"), "octave-cli is not installed")
    def test_octave_reads_the_csv(self):
        path = self.folder / "chain.csv"
        self.run_it("export", self.name, "-f", path)
        said = subprocess.run(["octave-cli", "--eval",
                               f"a=csvread('{path}',1,0); printf('%.17g', a(end,3))"], check=True,
                              capture_output=True, text=True, timeout=PATIENCE_S).stdout
        self.assertEqual(float(said), self.recorded()["B1.velocity"][-1])

    def test_run_without_contact_has_empty_tables(self):
        name = self.run_it("run", CHAIN, "--set", "bodies[0].velocity_m_per_s=0",
                           "--set", "output.ledger_only=true", "-o", "name")[0].strip()
        path = self.folder / "still.nc"
        self.run_it("export", name, "-f", path)
        with netCDF4.Dataset(path) as data:
            self.assertEqual(len(data["cycles"].dimensions["cycle"]), 0)
            self.assertEqual(len(data["bodies"]["position"]), 3)

    def test_wrong_uses_are_told(self):
        self.assertIn("-f", self.run_it("export", self.name, "-o", "netcdf", code=2)[1])
        self.run_it("export", self.name, "-o", "json", code=2)
        self.run_it("export", self.name, "--table", "x", code=2)
        self.run_it("export", self.name, "--table", "cycles", "--every", "2", code=2)
        self.run_it("export", self.name, "--every", "2", "--max-points", "20", code=2)
        for flag in ((), ("--max-points", "20")):
            _, said = self.run_it("export", self.name, "--channels", "B1.velocty", *flag, code=2)
            self.assertIn("did you mean 'B1.velocity'?", said)
        self.run_it("export", "nix", code=6)
        for name in ("x.csv", "x.nc"):
            _, said = self.run_it("export", self.name, "-f", f"/nowhere/{name}", code=11)
            self.assertIn(f"/nowhere/{name}: No such file or directory", said)


if __name__ == "__main__":
    unittest.main()
