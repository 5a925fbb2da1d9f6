"""The calls of the contract on a real server."""

import math
import struct
import unittest

import grpc
from contact.v1 import job_pb2, job_service_pb2, scenario_pb2
from contactd import (PATIENCE_S, Job, ServerTest, endless, is_cycle, seconds, spring_wall,
                      stored, three_ball_chain, to_bytes, two_balls_and_a_wall)

Cycle = job_pb2.Cycle


class RunTest(ServerTest):

    def test_chain_is_solved_to_the_reference(self):
        job = self.server.run(three_ball_chain())
        self.assertEqual(job.state, Job.SUCCEEDED)
        self.assertEqual(job.convergence, Job.FULL)
        self.assertEqual(job.attempt, 1)
        first, second = sorted(job.cycles, key=lambda cycle: cycle.contact)
        for cycle, restitution, mu in (first, 0.8, 2.259378079e8), (second, 0.7, 4.563828953e8):
            self.assertEqual(cycle.status, Cycle.CONVERGED)
            self.assertAlmostEqual(cycle.restitution_out, restitution, delta=1e-8 * restitution)
            self.assertAlmostEqual(cycle.mu / mu, 1, delta=1e-7)
        velocities = [body.velocity_m_per_s for body in job.final_bodies]
        for velocity, expected in zip(velocities, (-0.003731206344, 0.048726255138,
                                                   0.155004951207)):
            self.assertAlmostEqual(velocity, expected, delta=1e-9)

    def test_groups_are_told_after_their_cycles_and_kept_with_the_result(self):
        job = self.server.run(two_balls_and_a_wall())
        self.assertEqual(job.convergence, Job.FULL)
        wall = [g for g in job.groups if g.contact == "wall" and g.cycles == 2]
        self.assertEqual(len(wall), 1)
        self.assertAlmostEqual(wall[0].mu / 2.76e8, 1, delta=0.01)
        self.assertAlmostEqual(wall[0].restitution_out / 0.678, 1, delta=2e-8)
        self.assertNotEqual(wall[0].growth, job_pb2.Group.NOT_GROWN)
        events = self.server.events(job.name)
        told = [e.group for e in events if e.WhichOneof("payload") == "group"]
        self.assertEqual([to_bytes(g) for g in told], [to_bytes(g) for g in job.groups])
        growths = [e for e in events if e.WhichOneof("payload") == "group_growth"]
        self.assertEqual(len(growths), job.summary.growths)
        self.assertGreater(len(growths), 0)
        seen = set()
        for event in events:
            if is_cycle(event):
                seen.add((event.cycle.contact, event.cycle.number))
            for g in [event.group] if event.WhichOneof("payload") == "group" else []:
                self.assertIn((g.contact, g.first_cycle + g.cycles - 1), seen)

    def test_cycles_on_their_own_say_what_no_factor_reaches(self):
        job = self.server.run(two_balls_and_a_wall(restitution_scope="CYCLE"))
        self.assertEqual(job.convergence, Job.PARTIAL)
        lost = [g for g in job.groups if g.status == Cycle.INFEASIBLE]
        self.assertTrue(lost)
        for g in lost:
            self.assertTrue(g.HasField("too_much_mu") or g.HasField("too_little_mu"))

    def test_watch_shows_the_run_in_order_and_ends_after_the_final_state(self):
        name = self.server.create(three_ball_chain()).name
        messages = list(self.server.watch(name))
        self.assertEqual(messages[0].snapshot.name, name)
        self.assertFalse(any(message.HasField("snapshot") for message in messages[1:]))
        events = [event for message in messages for event in message.events]
        self.assertWholeLog(events)
        kinds = [event.WhichOneof("payload") for event in events]
        self.assertLess(kinds.index("attempt_started"), kinds.index("iteration"))
        self.assertLess(kinds.index("iteration"), kinds.index("cycle"))
        self.assertIn("frame_chunk", kinds)
        job = self.server.get(name)
        self.assertEqual([to_bytes(e.cycle) for e in events if is_cycle(e)],
                         [to_bytes(cycle) for cycle in job.cycles])
        self.assertEqual(events[-1].sequence, job.last_sequence)

    def test_frames_are_whole_columns_of_the_accepted_trajectory(self):
        job = self.server.run(three_ball_chain(output=dict(sample_interval_s=1e-5)))
        chunks = [e.frame_chunk for e in self.server.events(job.name, kinds=["frame_chunk"])
                  if e.HasField("frame_chunk")]
        first_sample = 0
        times = []
        for chunk in chunks:
            self.assertEqual(chunk.first_sample, first_sample)
            self.assertEqual(chunk.columns[0].name, "time")
            for column in chunk.columns:
                self.assertEqual(len(column.values), 8 * chunk.samples, column.name)
                self.assertTrue(column.unit)
            times += struct.unpack(f"<{chunk.samples}d", chunk.columns[0].values)
            first_sample += chunk.samples
        self.assertEqual(times, sorted(times))
        self.assertAlmostEqual(times[0], 0)
        self.assertAlmostEqual(times[-1], 4e-3, delta=1e-5)
        names = [column.name for column in chunks[0].columns]
        self.assertIn("B3.velocity", names)
        self.assertIn("B1-B2.contact_force", names)

    def test_watch_filters_kinds_but_always_tells_the_state(self):
        name = self.server.run(three_ball_chain()).name
        events = self.server.events(name, kinds=["cycle"])
        kinds = {event.WhichOneof("payload") for event in events if stored(event)}
        self.assertEqual(kinds, {"cycle", "state_changed"})

    def test_watch_goes_on_from_any_sequence(self):
        name = self.server.run(three_ball_chain()).name
        everything = self.server.events(name)
        for after in (1, len(everything) // 2, len(everything) - 1):
            rest = self.server.events(name, after_sequence=after)
            self.assertEqual(rest, everything[after:])


class LifeTest(ServerTest):

    flags = ("--workers=1",)

    def test_cancel_keeps_what_was_recorded(self):
        name = self.server.create(endless()).name
        self.server.wait_until(name, is_cycle)
        self.server.cancel(name)
        events = self.server.events(name)
        self.assertWholeLog(events)
        self.assertEqual(events[-1].state_changed.state, Job.CANCELLED)
        job = self.server.get(name)
        self.assertEqual(job.state, Job.CANCELLED)
        self.assertEqual(job.state_reason, "USER_REQUEST")
        self.assertEqual(len(job.cycles), sum(map(is_cycle, events)))
        self.assertGreater(len(job.cycles), 0)
        self.assertEqual(self.server.cancel(name).state, Job.CANCELLED)

    def test_queued_job_is_cancelled_at_once_and_never_runs(self):
        blocker = self.server.create(endless()).name
        self.server.wait_until(blocker, is_cycle)
        queued = self.server.create(three_ball_chain())
        self.assertEqual(queued.state, Job.QUEUED)
        self.assertEqual(queued.state_reason, "WAITING_FOR_WORKER")
        self.assertEqual(self.server.cancel(queued.name).state, Job.CANCELLED)
        self.assertEqual(self.server.get(queued.name).attempt, 0)

    def test_idle_watch_gets_bookmarks(self):
        blocker = self.server.create(endless()).name
        self.server.wait_until(blocker, is_cycle)
        queued = self.server.create(three_ball_chain())
        call = self.server.watch(queued.name, bookmark_interval=seconds(1))
        bookmarks = (event for message in call for event in message.events
                     if event.HasField("bookmark"))
        self.assertEqual(next(bookmarks).sequence, queued.last_sequence)
        call.cancel()

    def test_delete_needs_an_ended_job_and_leaves_nothing(self):
        name = self.server.create(endless()).name
        self.assertFails(grpc.StatusCode.FAILED_PRECONDITION, "INVALID_STATE",
                         self.server.delete, name)
        self.server.cancel(name)
        self.server.events(name, kinds=["state_changed"])
        self.server.delete(name)
        for call in self.server.get, self.server.cancel, self.server.delete, self.server.watch:
            details = self.assertFails(grpc.StatusCode.NOT_FOUND, "JOB_NOT_FOUND", call, name)
            self.assertEqual(details["ResourceInfo"].resource_name, name)
        self.assertEqual(len(self.server.list().jobs), 0)

    def test_list_pages_newest_first_and_filters(self):
        names = [self.server.run(three_ball_chain(), labels={"parity": str(i % 2)}).name
                 for i in range(5)]
        seen, token = [], ""
        while True:
            page = self.server.list(page_size=2, page_token=token)
            self.assertLessEqual(len(page.jobs), 2)
            seen += [job.name for job in page.jobs]
            token = page.next_page_token
            if not token:
                break
            self.assertRegex(token, "^[0-9a-f]{32}$")
            self.server.terminate()
            self.server.start()  # A token outlives it.
        self.assertEqual(seen, names[::-1])
        odd = self.server.list(labels={"parity": "1"}).jobs
        self.assertEqual([job.name for job in odd], [names[3], names[1]])
        self.assertEqual(len(self.server.list(states=[Job.FAILED]).jobs), 0)
        self.assertFalse(any(job.cycles or job.HasField("scenario") for job in odd))
        self.assertFails(grpc.StatusCode.INVALID_ARGUMENT, "FIELD_INVALID",
                         self.server.stub.ListJobs,
                         job_service_pb2.ListJobsRequest(page_size=-1))

    def test_server_info_tells_limits(self):
        info = self.server.stub.GetServerInfo(job_service_pb2.GetServerInfoRequest())
        self.assertEqual(info.workers, 1)
        self.assertEqual(info.limits.max_message_bytes, 2 << 20)
        self.assertGreater(info.limits.max_bodies, 0)
        self.assertIn(info.version, self.server.greeting)
        self.assertTrue(info.instance_id)


class RefusalTest(ServerTest):

    def test_every_violation_is_named(self):
        scenario = three_ball_chain()
        scenario.bodies[0].mass_kg = -1
        scenario.contacts[1].restitution = 1.2
        scenario.end_time_s = float("nan")
        details = self.assertFails(grpc.StatusCode.INVALID_ARGUMENT, "SCENARIO_INVALID",
                                   self.server.create, scenario)
        fields = [v.field for v in details["BadRequest"].field_violations]
        for field in "bodies[0].mass_kg", "contacts[1].restitution", "end_time_s":
            self.assertTrue(any(f.endswith(field) for f in fields), f"{field} not in {fields}")
        self.assertEqual(len(self.server.list().jobs), 0)

    def test_hundreds_of_violations_fit_the_trailer(self):
        scenario = three_ball_chain()
        for i in range(500):
            scenario.bodies.add(name=f"body {i}", mass_kg=-1)
        details = self.assertFails(grpc.StatusCode.INVALID_ARGUMENT, "SCENARIO_INVALID",
                                   self.server.create, scenario)
        self.assertGreater(len(details["BadRequest"].field_violations), 10)

    def test_validate_only_stores_nothing(self):
        job = self.server.create(three_ball_chain(), validate_only=True)
        self.assertEqual((job.name, job.state), ("", Job.STATE_UNSPECIFIED))
        self.assertEqual(len(self.server.list().jobs), 0)

    def test_request_id_makes_create_repeatable(self):
        first = self.server.create(three_ball_chain(), request_id="a")
        again = self.server.create(three_ball_chain(), request_id="a")
        self.assertEqual(first.name, again.name)
        self.assertFails(grpc.StatusCode.ALREADY_EXISTS, "REQUEST_ID_REUSED",
                         self.server.create, spring_wall(0.01), request_id="a")
        self.assertEqual(len(self.server.list().jobs), 1)

    def test_sweep_streams_its_cells_and_refuses_what_breaks_its_rules(self):
        axis = scenario_pb2.Sweep.Axis
        sweep = scenario_pb2.Sweep(
            base=three_ball_chain(),
            axes=[axis(field="contacts[*].restitution", values=[0.9, 0.7, 0.5]),
                  axis(field="bodies[0].velocity_m_per_s",
                       linear=scenario_pb2.Sweep.Range(low=0.1, high=0.5, count=5))],
            metrics=["iterations", "final_bodies[B3].velocity_m_per_s"])
        name = self.server.stub.CreateJob(
            job_service_pb2.CreateJobRequest(job=Job(sweep=sweep)), timeout=PATIENCE_S).name
        events = self.server.events(name)
        self.assertWholeLog(events)
        cells = {e.sweep_cell.index: e.sweep_cell for e in events
                 if e.WhichOneof("payload") == "sweep_cell"}
        self.assertEqual(sorted(cells), list(range(15)))
        for cell in cells.values():  # The chain has one solution for all velocities.
            expected = {0.9: 0.9025012796940577, 0.7: 0.7340472754915564, 0.5: 0.5918216365543338}
            self.assertAlmostEqual(cell.metrics[1] / cell.values[1], expected[cell.values[0]],
                                   delta=1e-7)
        job = self.server.get(name)
        self.assertEqual((job.state, job.convergence), (Job.SUCCEEDED, Job.FULL))

        sweep.axes[0].field = "contacts[*].restituton"
        details = self.assertFails(
            grpc.StatusCode.INVALID_ARGUMENT, "SCENARIO_INVALID", self.server.stub.CreateJob,
            job_service_pb2.CreateJobRequest(job=Job(sweep=sweep)))
        violation = details["BadRequest"].field_violations[0]
        self.assertEqual(violation.field, "sweep.axes[0].field")
        self.assertIn("did you mean 'restitution'?", violation.description)

    def test_oversized_request_is_refused_and_the_server_lives(self):
        scenario = three_ball_chain(title="x" * (9 << 20))
        with self.assertRaises(grpc.RpcError) as caught:
            self.server.create(scenario)
        self.assertEqual(caught.exception.code(), grpc.StatusCode.RESOURCE_EXHAUSTED)
        self.assertEqual(self.server.run(three_ball_chain()).state, Job.SUCCEEDED)

    def test_compressed_request_is_refused(self):
        with self.assertRaises(grpc.RpcError) as caught:
            self.server.stub.CreateJob(
                job_service_pb2.CreateJobRequest(job=Job(scenario=three_ball_chain())),
                compression=grpc.Compression.Gzip)
        self.assertEqual(caught.exception.code(), grpc.StatusCode.UNIMPLEMENTED)


class DeterminismTest(ServerTest):

    def test_two_runs_give_the_same_bytes(self):
        scenario = spring_wall(end_time_s=0.05)
        logs = []
        for _ in range(2):
            job = self.server.run(scenario)
            self.assertEqual(job.state, Job.SUCCEEDED)
            events = self.server.events(job.name, kinds=["cycle", "frame_chunk", "iteration"])
            payloads = ((e.WhichOneof("payload"), e) for e in events
                        if stored(e) and not e.HasField("state_changed"))
            logs.append([(kind, to_bytes(getattr(e, kind))) for kind, e in payloads])
        self.assertGreater(sum(kind == "cycle" for kind, _ in logs[0]), 5)
        self.assertGreater(sum(kind == "frame_chunk" for kind, _ in logs[0]), 0)
        self.assertEqual(logs[0], logs[1])


if __name__ == "__main__":
    unittest.main()
