"""The plots show the data of the run, with a mark where each cycle starts and ends."""

import pathlib
import unittest

import matplotlib.pyplot as plt
import numpy as np
from contactd import ServerTest, two_balls_and_a_wall
from contactsim import Client
from contactsim.figures import PRESETS, FigureError

SCENARIOS = pathlib.Path(__file__).parents[2] / "client" / "scenarios"
UNDAMPED = "glass-balls", "iterations"  # Its μ is 0 without a search.


class PlotsTest(ServerTest):

    def setUp(self):
        super().setUp()
        self.addCleanup(plt.close, "all")
        self.client = Client(f"127.0.0.1:{self.server.port}")
        self.addCleanup(self.client.close)
        self.chain = self.client.run(SCENARIOS / "three-ball-chain.yaml")

    def test_every_preset_draws_every_shipped_scenario(self):
        for path in sorted(set(SCENARIOS.glob("*.yaml")) - set(SCENARIOS.glob("*-sweep.yaml"))):
            result = self.client.run(path)
            for preset in PRESETS:
                with self.subTest(f"{path.stem} {preset}"):
                    held = bool(result.scenario.supports)
                    if (path.stem, preset) == UNDAMPED or (preset == "supports" and not held):
                        self.assertRaises(FigureError, result.plot, preset)
                        continue
                    axes = np.ravel(result.plot(preset))
                    axes[0].figure.savefig(self.folder / "plot.svg")
                    for ax in axes:
                        self.assertTrue(ax.get_ylabel())
                        self.assertTrue(ax.has_data())
                    plt.close("all")

    def test_loop_of_the_hysteresis_has_the_area_of_the_energy_lost(self):
        ax = self.chain.plot.hysteresis()
        loops = [line.get_xydata() for line in ax.lines if len(line.get_xydata()) > 10]
        for cycle, loop in zip(self.chain.job.cycles, loops):
            area = np.trapz(loop[:, 1], loop[:, 0])
            lost = cycle.work_compression_j + cycle.work_restitution_j
            self.assertAlmostEqual(area, lost, delta=1e-3 * lost)

    def test_what_is_dissipated_is_what_the_cycles_tell(self):
        dissipated = self.chain["system.dissipated_energy"]
        told = sum(cycle.dissipated_compression_j + cycle.dissipated_restitution_j
                   for cycle in self.chain.job.cycles)
        self.assertAlmostEqual(dissipated[-1], told, delta=1e-12)
        self.assertTrue((np.diff(dissipated) > -1e-15).all())

    def test_energy_is_balanced_at_every_sample_of_every_shipped_scenario(self):
        for path in sorted(set(SCENARIOS.glob("*.yaml")) - set(SCENARIOS.glob("*-sweep.yaml"))):
            with self.subTest(path.stem):
                result = self.client.run(path)
                scale = max(np.abs(result[f"system.{name}"]).max() for name in (
                    "kinetic_energy", "dissipated_energy", "load_work", "contact_energy"))
                total = result.plot.energy().lines[-1].get_ydata()
                plt.close("all")
                np.testing.assert_allclose(total, total[0], rtol=0, atol=1e-9 * scale)

    def test_energy_of_a_spring_is_that_of_its_law(self):
        for spring, falls in (({"higher_stiffness": [-40, 900]}, False),
                              ({"slip_force_n": 20}, True)):
            swing = self.client.run({
                "bodies": [{"name": "mass", "mass_kg": 1, "velocity_m_per_s": 3}],
                "supports": [{"body": "mass", "stiffness_n_per_m": 500, **spring}],
                "end_time_s": 1})
            total = swing.plot.energy().lines[-1].get_ydata()
            np.testing.assert_allclose(total, total[0], rtol=1e-9)
            left = 20**2 / 500 / 2  # Of a swing up to the force with which it slips.
            self.assertAlmostEqual(swing["system.dissipated_energy"][-1],
                                   4.5 - left if falls else 0, delta=1e-9)

    def test_band_of_a_group_spans_its_cycles(self):
        result = self.client.run(two_balls_and_a_wall())
        group = next(g for g in result.job.groups if g.cycles == 2)
        cycles = [c for c in result.job.cycles
                  if (c.contact, c.group) == (group.contact, group.number)]
        self.assertEqual((group.start_time_s, group.end_time_s),
                         (cycles[0].start_time_s, cycles[1].end_time_s))
        bands = result.plot.force().collections[0].get_paths()
        spans = [path.get_extents().intervalx for path in bands]
        self.assertTrue(any(start <= group.start_time_s and group.end_time_s <= end
                            for start, end in spans), spans)

    def test_marks_stand_where_cycles_start_and_end(self):
        ax = self.chain.plot.deformation_velocity()
        marks = {line.get_marker(): line.get_xydata()[0] for line in ax.lines[:3]}
        cycle = self.chain.job.cycles[0]
        self.assertAlmostEqual(marks["o"][1], cycle.approach_velocity_m_per_s, delta=1e-9)
        self.assertEqual(marks["x"][0], cycle.end_time_s)
        self.assertAlmostEqual(marks["x"][1], cycle.separation_velocity_m_per_s, delta=1e-5)

    def test_presets_share_axes_and_unknown_ones_are_refused(self):
        ax = plt.subplots()[1]
        self.assertIs(self.chain.plot("deformation-velocity", ax), ax)
        with self.assertRaisesRegex(ValueError, "hysteresis"):
            self.chain.plot("histeresis")


if __name__ == "__main__":
    unittest.main()
