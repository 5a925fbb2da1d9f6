"""Whoever watches a run sees it move, on a real server, and changes nothing by that."""

import time
import unittest

import grpc
from contact.v1 import job_service_pb2, scenario_pb2
from contactd import (ENDED, PATIENCE_S, Job, ServerTest, seconds, slowly_sampled, stored, to_bytes,
                      wait_for)

SHOW_S = 0.2    #: Rows are at most so old when they are sent.
SLACK_S = 0.4   #: Threads that wait for a core, a commit, the link: more than any seen beside a build.
FIRST_S = 1.0   #: The first row comes within.


def row_on_a_spring():
    """Six balls between two walls, the first on a spring: each episode is searched for a while
    before its motion is known."""
    body, contact = scenario_pb2.Body, scenario_pb2.Contact
    wall, pitch, count = scenario_pb2.Wall, 0.12, 6
    bodies = [body(name=f"B{i}", mass_kg=0.5 + 0.01 * (i * 7 % 11), radius_m=0.05,
                   position_m=i * pitch, velocity_m_per_s=(-1) ** i)
              for i in range(count)]
    contacts = [contact(name=f"C{i}", between=[f"B{i}", f"B{i + 1}"], stiffness=1e7,
                        restitution=1) for i in range(count - 1)]
    for ball, side, at in ((0, wall.LEFT, -0.07), (count - 1, wall.RIGHT, count * pitch - 0.05)):
        contacts.append(contact(name=f"wall-B{ball}", between=[f"B{ball}"], stiffness=1e7,
                                restitution=1, wall=wall(position_m=at, side=side)))
    spring = scenario_pb2.Support(body="B0", stiffness_n_per_m=100.0)
    return scenario_pb2.Scenario(
        bodies=bodies, contacts=contacts, supports=[spring], end_time_s=1000,
        solver=scenario_pb2.Solver(method=scenario_pb2.Solver.RK4, step_s=2e-6, max_steps=10**12),
        output=scenario_pb2.Output(sample_interval_s=0.05))


class LiveTest(ServerTest):
    flags = ("--workers=1",)

    def frames(self, scenario, duration_s):
        """When each frame has come [s], since the job was submitted, and the frames."""
        start = time.monotonic()
        name = self.server.create(scenario).name
        call = self.server.watch(name, kinds=["frame_chunk"], bookmark_interval=seconds(1))
        times, chunks = [], []
        try:
            for message in call:
                now = time.monotonic() - start
                for event in message.events:
                    if event.HasField("frame_chunk"):
                        times.append(now)
                        chunks.append(event.frame_chunk)
                if now > duration_s:
                    call.cancel()
        except grpc.RpcError as error:
            self.assertEqual(error.code(), grpc.StatusCode.CANCELLED)
        self.server.cancel(name)
        return times, chunks

    def assertMoves(self, times, chunks):
        self.assertGreater(len(chunks), 3)
        gaps = [later - earlier for earlier, later in zip(times, times[1:])]
        print(f"first after {times[0]:.3f} s, {len(chunks)} frames of "
              f"{sum(c.samples for c in chunks) / len(chunks):.1f} rows, longest gap {max(gaps):.3f} s")
        self.assertLess(times[0], FIRST_S)
        self.assertLess(max(gaps), SHOW_S + SLACK_S)
        following = 0
        for chunk in chunks:
            self.assertEqual(chunk.first_sample, following)
            following += chunk.samples

    def test_samples_that_come_slowly_are_shown_five_times_a_second(self):
        self.assertMoves(*self.frames(slowly_sampled(), 4))

    def test_a_row_of_balls_is_shown_five_times_a_second(self):
        self.assertMoves(*self.frames(row_on_a_spring(), 4))

    def test_a_run_that_is_watched_has_the_same_ledger_series_and_files(self):
        scenario = slowly_sampled()
        scenario.end_time_s = 1
        scenario.output.sample_interval_s = 1e-3
        watched = self.server.create(scenario).name
        chunks = [e for e in self.server.events(watched) if e.HasField("frame_chunk")]
        alone = self.server.create(scenario).name
        wait_for(lambda: self.server.get(alone).state in ENDED)
        self.assertGreater(len(chunks), 4)
        rows = [event.frame_chunk.first_sample
                for event in self.server.events(alone, kinds=["frame_chunk"])
                if event.HasField("frame_chunk")]
        self.assertEqual(rows, [0, 256, 512, 768], "nobody has watched")
        seen = []
        for name in watched, alone:
            job = self.server.get(name)
            self.assertEqual(job.state, Job.SUCCEEDED)
            series = self.server.stub.GetSeries(job_service_pb2.GetSeriesRequest(name=name),
                                                timeout=PATIENCE_S)
            artifact = self.server.stub.ReadArtifact(
                job_service_pb2.ReadArtifactRequest(name=name, artifact="trajectory.csv"),
                timeout=PATIENCE_S)
            seen.append(([to_bytes(c) for c in job.cycles], [to_bytes(c) for c in series.columns],
                         b"".join(part.data for part in artifact)))
        self.assertEqual(*seen)

    def test_a_stream_that_is_resumed_has_what_the_first_one_had(self):
        name = self.server.create(slowly_sampled()).name
        first = self.server.wait_until(name, lambda event: event.HasField("frame_chunk")
                                       and event.frame_chunk.first_sample > 0)
        first = [to_bytes(event) for event in first if stored(event)]
        self.server.cancel(name)
        again = [to_bytes(event) for event in self.server.events(name) if stored(event)]
        self.assertEqual(again[:len(first)], first)


if __name__ == "__main__":
    unittest.main()
