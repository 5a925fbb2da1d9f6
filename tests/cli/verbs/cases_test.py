"""Scenarios that an earlier engine got wrong: verdict, steps and figures of each, by name."""

import json
import math
import pathlib
import unittest

from cli_case import CliTest

CASES = pathlib.Path(__file__).parents[2] / "reference" / "cases"

# The steps that each may take: about twice what it takes.
STEPS = {
    "f1-two-dropped-on-one-floor.json": 200,
    "f1-tie-exact-law.json": 200,
    "f2-glued-textbook.json": 400,
    "f3-late-pulse-budget.json": 50_000,
    "f3-small-release-ledger-full.json": 50_000,
    "f4-two-answers-press40024-a.json": 70_000,
    "f4-two-answers-press40024-b.json": 140_000,
    "f4-two-roots-shaker-long.json": 22_000,
    "f4-two-roots-shaker-short.json": 16_000,
    "f5-wake-expo-529.json": 12_000,
    "f5-wake-zeno-704.json": 12_000,
    "f6-row-exponent-4.json": 5_000,
    "f7-imprecise-pull-603.json": 12_000,
    "f7-jump-neither-side-hold-167.json": 50_000,
    "momentum-residual.yaml": 4_000,
    "numeric-backlash.yaml": 3_700_000,
    "numeric-stiff-support.yaml": 120_000,
    "overshoot.yaml": 50_000,
    "plastic-column-1.yaml": 1_300_000,
    "rest-lift-off.yaml": 4_000,
    "rest-more-weight.yaml": 6_000,
    "rest-part-lift.yaml": 6_000,
    "rest-press-release.yaml": 120_000,
    "rest-struck.yaml": 12_000,
    "rest-valve.yaml": 6_000,
    "steps-at-rest.yaml": 30_000,
    "steps-stiff-drop.yaml": 350_000,
    "end-time-decides.yaml": 20_000,
    "start-pressed.yaml": 400,
    "damper-coefficient.yaml": 2_000,
}


class CasesTest(CliTest):

    def solved(self, name, *flags):
        job = self.run_it("run", CASES / name, *flags, "-o", "name")[0].strip()
        return json.loads(self.run_it("describe", job, "-o", "json")[0])

    def velocities(self, job):
        return [body["velocity_m_per_s"] for body in job["final_bodies"]]

    def rows(self, job, contact):
        return [cycle for cycle in job["cycles"] if cycle["contact"] == contact]

    def close(self, found, right, delta):
        self.assertEqual(len(found), len(right))
        for one, other in zip(found, right):
            self.assertAlmostEqual(one, other, delta=delta)

    def test_every_one_is_full_within_its_steps_and_proves_itself(self):
        self.assertEqual(set(STEPS), {path.name for path in CASES.iterdir()
                                      if not path.name.startswith("message")})
        for name, steps in STEPS.items():
            with self.subTest(name):
                job = self.solved(name)
                summary = job["summary"]
                self.assertEqual(job["convergence"], "FULL")
                self.assertLessEqual(int(summary["steps"]), steps)
                for residual in ("worst_identity_residual", "momentum_residual", "energy_residual"):
                    self.assertLess(summary.get(residual, 0), 1e-8, residual)

    # Once the tolerance chose between two roots: velocities 24 % apart.
    def test_the_smallest_root_is_the_answer_whatever_the_tolerance(self):
        exact, finer = (self.solved(f"f4-two-answers-press40024-{name}.json") for name in "ab")
        self.close(self.velocities(exact), self.velocities(finer), 1e-9)
        for job in (exact, finer):
            group = next(group for group in job["groups"] if group["contact"] == "B1-B2")
            self.assertAlmostEqual(group["restitution_out"], 0.369, delta=1e-9)

    # The end of the shorter run cuts a cycle that gives back too much whatever its μ. In the longer
    # one that cycle joins the group before, whose μ is ten times as large then.
    def test_a_later_end_changes_no_group_but_the_marked(self):
        short, long = (self.solved(f"f4-two-roots-shaker-{name}.json")["groups"]
                       for name in ("short", "long"))
        kept = [group for group in short if not group.get("beside_cut")]
        self.assertEqual(len(kept), 9)
        for group, later in zip(kept, long):
            self.assertAlmostEqual(group["mu"] / later["mu"], 1, delta=1e-6)
        self.assertAlmostEqual(short[10]["mu"] / 4.3251e7, 1, delta=1e-4)
        self.assertAlmostEqual(long[10]["mu"] / 4.4372e8, 1, delta=1e-4)
        self.assertEqual(long[10]["growth"], "TOO_MUCH")

    def test_two_particles_that_begin_pressed_move_as_published(self):
        job = self.solved("start-pressed.yaml")
        self.close([body["position_m"] for body in job["final_bodies"]],
                   [0.42713e-3, 1.38355e-3], 5e-9)
        self.close(self.velocities(job), [-0.02595, 0.39185], 5e-6)

    # δ = v e^{−ξωt} sinh(√(ξ² − 1) ωt)/(√(ξ² − 1) ω), from the touch with 1 m/s at 1 s on.
    def test_a_stop_has_the_damper_of_its_maker(self):
        job = self.solved("damper-coefficient.yaml")
        decay, fast = 1e5 / 20, math.sqrt((1e5 / 20) ** 2 - 1e6 / 10)
        deformation = (math.exp(fast - decay) - math.exp(-fast - decay)) / (2 * fast)
        self.assertAlmostEqual(-job["final_bodies"][0]["position_m"] / deformation, 1, delta=1e-6)

    # Dropped 100 mm: both meet the floor with 1.4 m/s and leave with 0.6 of that by their law, less 1 %
    # that their weight takes in the contact.
    def test_two_dropped_on_one_floor_leave_alike(self):
        job = self.solved("f1-two-dropped-on-one-floor.json")
        self.assertEqual(len(job["cycles"]), 2)
        for row in job["cycles"]:
            self.assertAlmostEqual(row["approach_velocity_m_per_s"], (2 * 9.80665 * 0.1) ** 0.5,
                                   delta=1e-9)
            self.assertAlmostEqual(abs(row["separation_velocity_m_per_s"])
                                   / row["approach_velocity_m_per_s"], 0.594, delta=6e-3)
        one, other = self.velocities(job)
        self.assertEqual(one, other)

    def test_two_blows_at_one_instant_are_two_collisions(self):
        self.close(self.velocities(self.solved("f1-tie-exact-law.json")), [-0.6, 0, 0.6], 1e-9)

    def test_a_touch_of_next_to_no_speed_glues_nothing(self):
        found = self.velocities(self.solved("f2-glued-textbook.json"))
        self.close(found, [0.408178, 0.668715, 0.923107], 1e-5)

    def test_a_struck_ball_at_rest_gives_back_what_is_asked_from_its_whole_compression(self):
        blow = next(row for row in self.rows(self.solved("rest-struck.yaml"), "floor")
                    if row["start_time_s"] > 0.19)
        self.assertAlmostEqual(blow["start_time_s"], 0.193574, delta=1e-6)
        self.assertAlmostEqual(blow["restitution_out"], 0.2, delta=1e-8)

    def test_added_weight_begins_a_cycle_at_its_instant(self):
        row = next(row for row in self.rows(self.solved("rest-more-weight.yaml"), "floor")
                   if row["start_time_s"] >= 0.5)
        self.assertEqual(row["start_time_s"], 0.5)
        self.assertAlmostEqual(row["restitution_out"], 0.5, delta=1e-8)
        self.assertLess(row["identity_residual"], 1e-8)

    def test_what_is_lifted_is_released_at_that_instant_and_leaves_once(self):
        rows = self.rows(self.solved("rest-lift-off.yaml"), "floor")
        self.assertEqual((rows[-1]["status"], rows[-1]["start_time_s"]), ("RELEASED", 0.5))
        self.assertEqual(rows[-1]["end"], "SEPARATION")
        self.assertEqual(rows[-2]["end_time_s"], 0.5)

    def test_a_valve_opens_and_shuts_with_its_restitution(self):
        rows = self.rows(self.solved("rest-valve.yaml"), "seat")
        opens = next(row for row in rows if row["status"] == "RELEASED")
        shuts = next(row for row in rows if row["kind"] == "COLLISION")
        self.assertAlmostEqual(opens["start_time_s"], 0.02, delta=1e-9)
        self.assertAlmostEqual(shuts["start_time_s"], 0.0415, delta=1e-4)
        self.assertAlmostEqual(shuts["restitution_out"], 0.4, delta=1e-8)

    def test_the_run_stops_at_its_end(self):
        job = self.solved("overshoot.yaml")
        self.assertEqual(job["summary"]["time_reached_s"], 10)

    def test_the_end_of_the_run_decides_no_force_before_it(self):
        peaks = [self.solved("end-time-decides.yaml", "--set", f"end_time_s={end}")
                 ["cycles"][0]["peak_force_n"] for end in (2, 3, 5)]
        self.close(peaks, [31750] * 3, 10)
        self.close(peaks, [peaks[0]] * 3, 1e-6 * peaks[0])

    def test_stiff_parts_end_where_an_independent_integration_does(self):
        job = self.solved("numeric-stiff-support.yaml")
        where = {body["name"]: 1e3 * body["position_m"] for body in job["final_bodies"]}
        self.assertAlmostEqual(where["left"], -9.088, delta=1e-3)
        self.assertAlmostEqual(where["right"], 50.912, delta=1e-3)
        self.assertAlmostEqual(where["loose"], 0.88, delta=1e-3)

    def test_a_decimal_comma_and_a_wall_among_bodies_are_named(self):
        comma = self.run_it("validate", CASES / "message-decimal-comma.yaml", code=3)
        self.assertIn("decimal", "".join(comma))
        wall = self.run_it("validate", CASES / "message-wall-in-between.yaml", code=3)
        self.assertIn("the wall is only in wall", "".join(wall))


if __name__ == "__main__":
    unittest.main()
