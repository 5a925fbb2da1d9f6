"""contactsim against a real contactd."""

import asyncio
import hashlib
import pathlib
import threading
import unittest

import numpy as np
import pandas
from contactd import (Job, ServerTest, endless, is_cycle, three_ball_chain,
                      two_balls_and_a_wall)
from contactsim import (AmbiguousJob, AsyncClient, CallError, Client, DownloadFailed,
                        InvalidScenario, JobNotFound, RunFailed, Timeout, Unreachable)

SCENARIOS = pathlib.Path(__file__).parents[2] / "client" / "scenarios"
PATIENCE_S = 60


class ClientTest(ServerTest):

    def setUp(self):
        super().setUp()
        self.address = f"127.0.0.1:{self.server.port}"
        self.client = Client(self.address)
        self.addCleanup(self.client.close)

    def test_run_of_a_file_gives_the_known_result_in_tables(self):
        result = self.client.run(SCENARIOS / "three-ball-chain.yaml", timeout_s=PATIENCE_S)
        self.assertTrue(result.converged)
        self.assertEqual(list(result.cycles.contact), ["B1-B2", "B2-B3"])
        self.assertEqual(list(result.cycles.status), ["CONVERGED"] * 2)
        np.testing.assert_allclose(result.cycles.mu, [2.259378079e8, 4.563828953e8], rtol=1e-6)
        np.testing.assert_allclose(
            result.bodies.velocity_m_per_s,
            [-0.003731206344, 0.048726255138, 0.155004951207], atol=1e-8)
        self.assertEqual(list(result.groups.growth), ["NOT_GROWN"] * 2)
        self.assertEqual(list(result.groups.mu), list(result.cycles.mu))
        self.assertEqual(list(result.cycles.group), list(result.groups.number))
        self.assertEqual(result["time"][-1], 4e-3)
        self.assertEqual(result.series.shape, (1001, 22))
        self.assertEqual(result.series.columns[1], "B1.velocity [m/s]")
        self.assertEqual(result.series.index[-1], 4e-3)
        last = result.iterations[result.iterations.accepted]
        self.assertTrue((last.residual.abs() < 2e-8).all())
        spec = result.scenario.SerializeToString(deterministic=True)
        self.assertEqual(result.provenance["scenario_sha256"], hashlib.sha256(spec).hexdigest())

    def test_a_load_takes_of_the_speed_what_newton_predicts(self):
        ball = {"bodies": [{"name": "ball", "mass_kg": 0.5, "radius_m": 0.05, "position_m": -0.06,
                            "velocity_m_per_s": 1}],
                "contacts": [{"between": ["ball"], "wall": {"side": "RIGHT"}, "stiffness": 1e5,
                              "restitution": 0.5}],
                "loads": [{"body": "ball", "constant": {"force_n": 12}}],
                "end_time_s": 0.08}
        told = self.client.run(ball, timeout_s=PATIENCE_S).newton.iloc[0]
        self.assertAlmostEqual(told.external_force_n, 12, delta=1e-6)
        self.assertAlmostEqual(told.newton_restitution, told.predicted, delta=1e-8)
        self.assertLess(told.newton_restitution, told.restitution_out - 0.01)

    def test_groups_of_several_cycles_are_rows_of_a_table(self):
        result = self.client.run(two_balls_and_a_wall(), timeout_s=PATIENCE_S)
        self.assertTrue(result.converged)
        wall = result.groups[(result.groups.contact == "wall") & (result.groups.cycles == 2)]
        self.assertEqual(len(wall), 1)
        np.testing.assert_allclose(wall.mu, 2.76e8, rtol=0.01)
        numbers = result.cycles[result.cycles.contact == "wall"].group
        self.assertEqual(list(numbers).count(wall.number.iloc[0]), 2)

    def test_dict_and_message_make_the_same_run(self):
        source = {"bodies": [{"name": "A", "mass_kg": 1, "velocity_m_per_s": 1},
                             {"name": "B", "mass_kg": 1, "position_m": 0.001}],
                  "contacts": [{"between": ["A", "B"], "stiffness": 1e8, "restitution": 0.5}],
                  "end_time_s": 0.01}
        first = self.client.run(source)
        self.assertAlmostEqual(first.bodies.velocity_m_per_s[0], 0.25, delta=1e-8)
        again = self.client.run(first.scenario)
        self.assertTrue(first.series.equals(again.series))

    def test_template_with_fields_and_variables_set(self):
        result = self.client.run("two-balls", set={"contacts[A-B].restitution": 0.7},
                                 timeout_s=PATIENCE_S)
        self.assertEqual(result.scenario.contacts[0].restitution, 0.7)
        self.assertAlmostEqual(result.cycles.restitution_out[0], 0.7, delta=1e-7)
        ball = self.client.submit("bouncing-ball", variables={"height_m": 0.5},
                                  set={"end_time_s": 0.1})
        self.assertEqual(ball.scenario.bodies[0].position_m, 0.5)
        self.assertEqual(ball.scenario.end_time_s, 0.1)
        with self.assertRaisesRegex(TypeError, r"set=\{'contacts\[\*\].restitution': 0.7\}"):
            self.client.run("two-balls", restitution=0.7)
        with self.assertRaisesRegex(FileNotFoundError, "did you mean 'two-balls'"):
            self.client.run("two-ball")

    def test_sweep_over_words_and_variables_has_units(self):
        sweep = self.client.sweep(
            "bouncing-ball",
            {"var:height_m": [0.5, 1], "contacts[floor].damping": ["exact", "FLORES"]},
            ["cycles.count", "cycles[floor].first.peak_force_n"], set={"end_time_s": 0.6},
            timeout_s=PATIENCE_S)
        self.assertEqual(list(sweep.frame["var:height_m"]), [0.5, 0.5, 1, 1])
        self.assertEqual(list(sweep.frame["contacts[floor].damping"]), ["EXACT", "FLORES"] * 2)
        self.assertEqual(sweep.xr["var:height_m"].attrs["units"], "m")
        self.assertEqual(sweep.xr["cycles[floor].first.peak_force_n"].attrs["units"], "N")
        self.assertEqual(sweep.xr["cycles.count"].sel({"contacts[floor].damping": "EXACT"}).shape,
                         (2,))
        ax = sweep.heatmap()
        self.assertEqual([tick.get_text() for tick in ax.get_xticklabels()], ["EXACT", "FLORES"])
        with self.assertRaisesRegex(ValueError, "unknown variable 'height'"):
            self.client.sweep("bouncing-ball", {"var:height": [1]})
        with self.assertRaisesRegex(ValueError, "'FLORS' is no value"):
            self.client.sweep("two-balls", {"contacts[*].damping": ["FLORS"]})

    def test_runs_are_compared_with_each_other_and_with_measured_data(self):
        first = self.client.run(three_ball_chain())
        other = self.client.run(three_ball_chain(), set={"contacts[0].restitution": 0.5})
        self.assertTrue(first.compare(self.client.run(three_ball_chain()), abs_tol=0, rel_tol=0))
        compared = first.compare(other)
        self.assertFalse(compared)
        self.assertEqual(list(compared.parameters.index), ["contacts[0].restitution"])
        measured = first.series[["B3.velocity [m/s]"]] * 1.01
        self.assertTrue(first.compare_measured(measured))
        self.assertFalse(first.compare_measured(measured, rel_tol=0.001))

    def test_report_and_paper_are_written(self):
        run = self.client.run(three_ball_chain())
        page = self.client.report([run], self.folder / "report.html")
        self.assertIn(run.name, page.read_text("utf-8"))
        self.assertTrue(self.client.paper(self.folder / "paper", ["table2"]))
        self.assertTrue((self.folder / "paper" / "index.html").exists())
        with self.assertRaisesRegex(ValueError, "unknown item 'fig99'"):
            self.client.paper(self.folder / "paper", ["fig99"])

    def test_asynchronous_client_can_all_that_the_other_can(self):

        async def use():
            async with AsyncClient(self.address) as client:
                run = await client.run("two-balls", set={"end_time_s": 1e-3}, progress=False)
                sweep = await client.sweep("two-balls", {"contacts[*].restitution": [0.5, 0.7]})
                listed = [job.name async for job in client.jobs(states=["SUCCEEDED"])]
                checked = await client.validate("two-balls")
                waited = await client.wait(run.job)
                noted = await client.update(run.job, note="good")
                self.assertEqual(noted.note, "good")
                await client.delete(run.job)
                return run, sweep, listed, checked, waited

        run, sweep, listed, checked, waited = asyncio.run(use())
        self.assertEqual(set(listed), {run.name, sweep.name})
        self.assertEqual(len(sweep.frame), 2)
        self.assertGreater(checked.estimate.samples, 0)
        self.assertEqual(waited.name, run.name)

    def test_sweep_gives_a_tidy_frame_and_a_heat_map(self):
        sweep = self.client.sweep(
            SCENARIOS / "three-ball-chain.yaml",
            {"bodies[0].velocity_m_per_s": [0.1, 0.5], "contacts[*].restitution": [0.9, 0.7, 0.5]},
            ["iterations", "cycles[B1-B2].alpha"], timeout_s=PATIENCE_S)
        self.assertEqual(sweep.frame.shape, (6, 7))
        self.assertEqual(set(sweep.frame.convergence), {"FULL"})
        half = sweep.frame[sweep.frame["contacts[*].restitution"] == 0.5]
        np.testing.assert_allclose(half["cycles[B1-B2].alpha"], 2.206095738306658, rtol=1e-6)
        self.assertEqual(sweep.xr["iterations"].sel({"contacts[*].restitution": 0.5}).shape, (2,))
        ax = sweep.heatmap("cycles[B1-B2].alpha")
        self.assertEqual(ax.get_xlabel(), "restitution of all contacts [1]")
        self.assertEqual(len(ax.collections), 1)
        self.assertEqual(len(ax.lines) + len(ax.patches), 0)  # Nothing failed.
        self.assertIn("6 of 6 cells", sweep._repr_html_())
        again = self.client.sweep_result(sweep.name, timeout_s=PATIENCE_S)
        self.assertTrue(again.frame.equals(sweep.frame))
        self.assertRaises(ValueError, sweep.heatmap, "steps")

    def test_cells_of_a_sweep_that_fail_are_marked(self):
        sweep = self.client.sweep(
            SCENARIOS / "three-ball-chain.yaml",
            {"contacts[0].restitution": [0.5, 1.5], "solver.max_iterations": [1, 50]},
            timeout_s=PATIENCE_S)
        self.assertEqual(list(sweep.frame.state), ["SUCCEEDED", "SUCCEEDED", "FAILED", "FAILED"])
        self.assertEqual(list(sweep.frame.convergence), ["PARTIAL", "FULL", "", ""])
        self.assertTrue(sweep.frame.iterations[2:].isna().all())
        ax = sweep.heatmap()
        self.assertEqual((len(ax.lines), len(ax.patches)), (4, 1))  # Two crosses, one hatched.
        with self.assertRaises(InvalidScenario):
            self.client.sweep(SCENARIOS / "three-ball-chain.yaml", {"nothing": [1]})

    def test_result_can_be_fetched_later_and_shown_in_a_notebook(self):
        name = self.client.submit(three_ball_chain(title="<b>&")).name
        result = self.client.result(name.removeprefix("jobs/"), timeout_s=PATIENCE_S)
        self.assertEqual(len(result.series), 1001)
        shown = result._repr_html_()
        self.assertIn("&lt;b&gt;&amp;", shown)
        self.assertIn("COLLISION", shown)
        self.assertIn("SUCCEEDED", repr(result))

    def test_events_are_heard_while_the_job_runs_and_once(self):
        events = []
        self.client.run(three_ball_chain(), on_event=events.append)
        self.assertWholeLog(events)

    def test_watch_survives_a_server_that_restarts(self):
        name = self.client.submit(endless()).name
        seen = []
        for event in self.client.watch(name, timeout_s=PATIENCE_S):
            seen.append(event)
            if sum(map(is_cycle, seen)) == 3:
                break
        port = self.server.port
        flags = self.server.flags
        self.server.kill()
        after = max(event.sequence for event in seen)
        self.addCleanup(self.server.kill)
        heard = []
        connected = threading.Event()

        def listen():
            for event in self.client.watch(name, after_sequence=after, timeout_s=PATIENCE_S):
                heard.append(event)
                connected.set()

        # A listener that is connected when the link breaks again.
        self.server.flags = (*flags, f"--listen=127.0.0.1:{port}")
        self.server.start()
        listener = threading.Thread(target=listen)
        listener.start()
        self.server.wait_until(name, lambda e: e.sequence > after and is_cycle(e))
        self.assertTrue(connected.wait(PATIENCE_S))
        self.server.kill()
        self.server.start()
        self.server.wait_until(name, lambda e: e.HasField("attempt_started")
                               and e.attempt_started.attempt == 3)
        self.server.cancel(name)
        listener.join(PATIENCE_S)
        self.assertFalse(listener.is_alive())
        self.assertWholeLog(heard, after)

    def test_asynchronous_client_runs_jobs_side_by_side(self):

        async def run():
            async with AsyncClient(self.address) as client:
                return await asyncio.gather(*(
                    client.run(three_ball_chain(), timeout_s=PATIENCE_S) for _ in range(3)))

        results = asyncio.run(run())
        self.assertEqual(len({result.name for result in results}), 3)
        for result in results:
            np.testing.assert_array_equal(result["B3.velocity"], results[0]["B3.velocity"])

    def test_changes_of_jobs_are_heard_once_across_a_restart(self):
        first = self.client.run(three_ball_chain(), labels={"law": "a"}).name
        changes = self.client.watch_jobs(labels={"law": "a"}, timeout_s=PATIENCE_S)
        heard = next(changes)
        self.assertEqual((heard.name, heard.job.state), (first, Job.SUCCEEDED))
        self.client.run(three_ball_chain(), labels={"law": "b"})
        second = self.client.submit(three_ball_chain(), labels={"law": "a"}).name
        states = []
        while Job.SUCCEEDED not in states:
            change = next(changes)
            self.assertEqual(change.name, second)
            states.append(change.job.state)
        self.assertEqual(len(states), len(set(states)))
        self.server.flags = (*self.server.flags, f"--listen={self.address}")
        self.addCleanup(self.server.kill)
        self.server.kill()
        self.server.start()
        self.client.delete(first)
        gone = next(changes)  # Neither job is told again.
        self.assertEqual((gone.name, gone.job), (first, None))
        with self.assertRaises(Timeout):
            list(self.client.watch_jobs(timeout_s=0.5))

    def test_changes_of_jobs_can_be_awaited(self):

        async def run():
            async with AsyncClient(self.address) as client:
                job = await client.submit(three_ball_chain())
                async for change in client.watch_jobs(states=["SUCCEEDED"], timeout_s=PATIENCE_S):
                    return job.name, change.name

        self.assertEqual(*asyncio.run(run()))

    def test_artifact_is_fetched_and_a_part_of_it_gone_on_with(self):
        job = self.client.run(three_ball_chain()).job
        self.assertEqual([a.name for a in job.artifacts],
                         ["cycles.csv", "groups.csv", "trajectory.csv"])
        whole = self.client.download(job, "trajectory.csv", self.folder / "whole.csv")
        content = whole.read_bytes()
        frame = pandas.read_csv(whole)
        self.assertEqual(len(frame), 1001)
        part = self.folder / "rest.csv.part"
        part.write_bytes(content[:1000])
        rest = asyncio.run(self.download_awaited(job, "trajectory.csv", self.folder / "rest.csv"))
        self.assertEqual(rest.read_bytes(), content)
        for damaged in (b"x" + content[1:1000], content + b"x"):
            part.write_bytes(damaged)
            with self.assertRaises(DownloadFailed):
                self.client.download(job, "trajectory.csv", self.folder / "rest.csv")
            self.assertFalse(part.exists())
        with self.assertRaises(JobNotFound) as caught:
            self.client.download(job, "none.csv", self.folder / "none.csv")
        self.assertEqual(caught.exception.reason, "ARTIFACT_NOT_FOUND")
        self.assertEqual(sorted(path.name for path in self.folder.glob("*.csv*")),
                         ["rest.csv", "whole.csv"])

    async def download_awaited(self, *arguments):
        async with AsyncClient(self.address) as client:
            return await client.download(*arguments)

    def test_jobs_are_a_table_whose_rows_name_them(self):
        first = self.client.run(three_ball_chain(title="one"), labels={"law": "a"})
        second = self.client.run(three_ball_chain(title="two"), labels={"law": "b"})
        sweep = self.client.sweep("two-balls", {"contacts[*].restitution": [0.5, 0.7]})
        jobs = self.client.list()
        self.assertEqual(list(jobs.index), [sweep.name, second.name, first.name])
        self.assertEqual(list(jobs.kind), ["sweep", "scenario", "scenario"])
        self.assertEqual(list(jobs.title[1:]), ["two", "one"])
        self.assertEqual(set(jobs.state), {"SUCCEEDED"})
        self.assertEqual(set(jobs.convergence), {"FULL"})
        self.assertEqual(set(jobs.owner), {"local"})
        self.assertEqual(jobs["labels"][first.name], {"law": "a"})
        self.assertTrue((jobs.ended >= jobs.created).all())
        self.assertEqual(str(jobs.created.dtype), "datetime64[ns, UTC]")
        self.assertEqual(self.client.result(jobs.iloc[1]).name, second.name)
        self.assertEqual(list(self.client.list(limit=2).index), list(jobs.index[:2]))
        self.assertEqual(len(self.client.list(name_prefix=first.name.removeprefix("jobs/"))), 1)
        self.assertEqual(len(self.client.list(states=["failed"])), 0)
        with self.assertRaisesRegex(ValueError, "'SUCEEDED' is no state.*'SUCCEEDED'"):
            self.client.list(states=["SUCEEDED"])

    def test_job_is_named_as_in_contactctl(self):
        with self.assertRaisesRegex(JobNotFound, "the server has no jobs"):
            self.client.last()
        first = self.client.run(three_ball_chain())
        second = self.client.run(three_ball_chain())
        self.assertEqual(self.client.last().name, second.name)
        self.assertEqual(self.client.last(1).name, first.name)
        self.assertEqual(self.client.get("last~1").name, first.name)
        begin = first.name[:next(i for i in range(6, 15) if first.name[:i] != second.name[:i])]
        self.assertEqual(self.client.result(begin).name, first.name)
        heard = list(self.client.watch(begin.removeprefix("jobs/"), kinds=["state_changed"]))
        self.assertEqual(heard[-1].state_changed.state, Job.SUCCEEDED)
        for wrong, error, words in (("last~2", JobNotFound, "the server has 2 jobs"),
                                    ("last~x", ValueError, "whole number from 0 to 999"),
                                    ("!!", JobNotFound, "!!"), (1, TypeError, "not by int 1"),
                                    ("jobs/", CallError, "")):
            with self.assertRaisesRegex(error, words):
                self.client.get(wrong)

    def test_beginning_of_several_names_is_told_with_them(self):
        names = []
        while len({name[5] for name in names}) == len(names):
            names.append(self.client.run("two-balls", set={"end_time_s": 1e-4}).name)
        begin = next(name[5] for name in names[::-1] if [n[5] for n in names].count(name[5]) > 1)
        with self.assertRaisesRegex(AmbiguousJob, f"several jobs begin with '{begin}':") as caught:
            self.client.get(begin)
        same = [name for name in names[::-1] if name[5] == begin]
        self.assertEqual([job.name for job in caught.exception.jobs], same)
        self.assertIn(same[0].removeprefix("jobs/"), str(caught.exception))

    def test_series_is_thinned_and_loses_no_peak(self):
        run = self.client.run(three_ball_chain())
        thin = self.client.series(run, ["B1-B2.contact_force"], max_points=20, end_time_s=2e-3)
        self.assertEqual(list(thin.columns), ["B1-B2.contact_force [N]"])
        self.assertLessEqual(len(thin), 20)
        self.assertLessEqual(thin.index[-1], 2e-3)
        self.assertEqual(thin.iloc[:, 0].max(), run["B1-B2.contact_force"].max())
        self.assertEqual(list(self.client.series("last").columns), list(run.series.columns))
        with self.assertRaisesRegex(CallError, "did you mean 'B1.velocity'"):
            self.client.series(run, ["B1.velocty"])

    def test_list_finds_jobs_by_state_and_label(self):
        self.client.run(three_ball_chain(), labels={"law": "a"})
        second = self.client.run(three_ball_chain(), labels={"law": "b"})
        self.assertEqual([job.name for job in self.client.jobs(labels={"law": "b"})],
                         [second.name])
        self.assertEqual(len(list(self.client.jobs(states=["SUCCEEDED"]))), 2)
        self.client.delete(second)
        with self.assertRaises(JobNotFound) as caught:
            self.client.get(second)
        self.assertEqual(caught.exception.reason, "JOB_NOT_FOUND")

    def test_labels_and_note_change_one_without_the_other(self):
        run = self.client.run(three_ball_chain(), labels={"law": "a"})
        self.assertEqual(self.client.update(run, note="good").labels, {"law": "a"})
        self.assertEqual(self.client.update("last", labels={"n": "1"}).note, "good")
        jobs = self.client.list(labels={"n": "1"})
        self.assertEqual(list(jobs.note), ["good"])
        self.assertEqual(self.client.update(jobs.iloc[0], labels={}, note="").labels, {})
        with self.assertRaisesRegex(ValueError, "labels, note or both"):
            self.client.update(run)
        with self.assertRaisesRegex(TypeError, "labels are texts"):
            self.client.update(run, labels={"n": 1})
        with self.assertRaisesRegex(CallError, "note: has 1001 characters"):
            self.client.update(run, note="ε" * 1001)

    def test_cancelled_job_is_no_result_but_keeps_what_it_recorded(self):
        job = self.client.submit(endless())
        next(filter(is_cycle, self.client.watch(job, timeout_s=PATIENCE_S)))
        with self.assertRaises(Timeout):
            self.client.wait(job, timeout_s=0.05)
        self.client.cancel(job)
        self.assertEqual(self.client.wait(job, timeout_s=PATIENCE_S).state, Job.CANCELLED)
        with self.assertRaisesRegex(RunFailed, "CANCELLED") as caught:
            self.client.result(job)
        self.assertGreater(len(caught.exception.job.cycles), 0)

    def test_rules_of_the_server_are_told_with_field_path(self):
        scenario = three_ball_chain()
        scenario.bodies[0].mass_kg = -1
        scenario.contacts[1].between[1] = "B4"
        for check in (self.client.submit, self.client.validate):
            with self.assertRaises(InvalidScenario) as caught:
                check(scenario)
            fields = [v.field for v in caught.exception.violations]
            self.assertEqual(fields, ["bodies[0].mass_kg", "contacts[1].between[1]"])
        self.assertIn("bodies[0].mass_kg: is -1; must be in (0, 1e12]", str(caught.exception))

    def test_missing_server_is_told_with_what_to_do(self):
        with Client("127.0.0.1:1") as client, self.assertRaises(Unreachable) as caught:
            client.run(three_ball_chain())
        self.assertIn("contactd --listen 127.0.0.1:1", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
