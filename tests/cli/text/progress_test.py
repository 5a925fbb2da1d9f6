"""Progress for programs."""

import json
import unittest

from cli_case import CHAIN, CliTest


class ProgressTest(CliTest):

    def told(self, *arguments, output="name", code=0):
        said = self.run_it(*arguments, "--progress", "json", "-o", output, code=code)[1]
        return [json.loads(line) for line in said.splitlines()]

    def test_run_is_told_in_lines_of_json_up_to_its_end(self):
        lines = self.told("run", CHAIN)
        self.assertEqual(list(lines[-1]), ["kind", "job", "done", "time_s", "end_time_s", "steps",
                                           "cycles", "iterations", "busy_with", "eta_s"])
        self.assertEqual((lines[-1]["kind"], lines[-1]["done"]), ("run", 1))
        self.assertEqual((lines[-1]["time_s"], lines[-1]["cycles"]), (4e-3, 2))
        parts = [line["done"] for line in lines]
        self.assertEqual(parts, sorted(parts))

    def test_sweep_tells_its_cells(self):
        lines = self.told("sweep", "run", CHAIN, "--grid", "contacts[*].restitution=0.5:0.9:100",
                          output="json")
        self.assertEqual({line["kind"] for line in lines}, {"sweep"})
        self.assertEqual((lines[-1]["cells"], lines[-1]["cells_done"]), (100, 100))
        self.assertEqual((lines[-1]["cells_failed"], lines[-1]["eta_s"]), (0, 0))

    def test_watch_tells_it_beside_the_events(self):
        name = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        printed, said = self.run_it("watch", name, "--progress", "json")
        self.assertIn("SUCCEEDED", printed)
        self.assertEqual(json.loads(said.splitlines()[-1])["done"], 1)


if __name__ == "__main__":
    unittest.main()
