"""contactctl run --like: an earlier job again, bit for bit."""

import unittest

from cli_case import CHAIN, SCENARIOS, SPRING, CliTest


class LikeTest(CliTest):

    def repeat(self, name, *flags, code=0):
        return self.run_it("run", "--like", name, *flags, "-o", "name", code=code)

    def trajectory(self, name):
        """Every byte of every column."""
        columns = {}
        for event in self.server.events(name, kinds=["frame_chunk"]):
            for column in event.frame_chunk.columns:
                columns[column.name] = columns.get(column.name, b"") + column.values
        return columns

    def test_same_cycles_and_frames_to_the_last_bit(self):
        for scenario in (CHAIN, SPRING):
            with self.subTest(scenario.stem):
                first = self.run_it("run", scenario, "-o", "name")[0].strip()
                second = self.repeat(first)[0].strip()
                self.assertNotEqual(first, second)
                a, b = self.server.get(first), self.server.get(second)
                self.assertEqual(a.spec_sha256, b.spec_sha256)
                self.assertEqual([c.SerializeToString() for c in a.cycles],
                                 [c.SerializeToString() for c in b.cycles])
                self.assertEqual([f.SerializeToString() for f in a.final_bodies],
                                 [f.SerializeToString() for f in b.final_bodies])
                frames = self.trajectory(first)
                self.assertGreater(len(frames["time"]), 1000)
                self.assertEqual(frames, self.trajectory(second))

    def test_overrides_change_the_repetition(self):
        first = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        other = self.server.get(self.repeat(
            first, "--set", "contacts[0].restitution=0.6")[0].strip())
        self.assertEqual(other.scenario.contacts[0].restitution, 0.6)
        self.assertNotEqual(other.spec_sha256, self.server.get(first).spec_sha256)
        _, said = self.repeat(first, "--set", "contacts[0].restitution=7", code=3)
        self.assertIn("contacts[0].restitution: is 7; must be in", said)

    def test_submit_repeats_too(self):
        first = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        second = self.run_it("submit", "--like", first, "-o", "name")[0].strip()
        self.assertEqual(self.server.get(second).scenario, self.server.get(first).scenario)

    def test_wrong_uses_are_told(self):
        self.assertIn("a FILE, --template NAME or --like JOB", self.run_it("run", code=2)[1])
        self.run_it("run", CHAIN, "--like", "x", code=2)
        self.repeat("nix", code=6)
        _, said = self.run_it("sweep", "run", SCENARIOS / "table-3-sweep.yaml")
        self.assertIn("is a sweep", self.repeat(said.split()[0], code=2)[1])


if __name__ == "__main__":
    unittest.main()
