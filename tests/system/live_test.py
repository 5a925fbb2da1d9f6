"""Whoever watches a run sees it move, on a real server."""

import time
import unittest

import grpc
from contact.v1 import scenario_pb2
from contactd import ServerTest, endless, seconds, stored, to_bytes

FIRST_S = 1.0   #: The first motion comes within.
SHOW_S = 0.2    #: Rows that are there are at most so old when they are sent.
SLACK_S = 0.8   #: A slower core, threads that wait for it, a commit, the link.


def slow_ball(step_s=4e-7):
    """Some twenty samples a second: a chunk of 128 rows takes seconds to fill."""
    scenario = endless()
    scenario.end_time_s = 1e4
    scenario.output.sample_interval_s = 0.01
    scenario.solver.method = scenario_pb2.Solver.RK4
    scenario.solver.step_s = step_s
    return scenario


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

    def assert_moves(self, scenario):
        times, chunks = self.frames(scenario, 4)
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

    def test_samples_that_come_slowly_are_shown_as_they_come(self):
        self.assert_moves(slow_ball())

    def test_a_row_of_balls_is_shown_as_it_moves(self):
        self.assert_moves(row_on_a_spring())

    def test_a_run_of_quick_steps_is_shown_as_it_moves(self):
        self.assert_moves(endless())

    def test_watchers_change_nothing(self):
        scenario = slow_ball(1e-6)
        scenario.end_time_s = 1
        scenario.output.sample_interval_s = 1e-3
        watched, alone = self.server.create(scenario).name, self.server.create(scenario).name
        seen = [e.frame_chunk for e in self.server.events(watched) if e.HasField("frame_chunk")]
        self.server.events(alone, kinds=["state_changed"])
        kept = [e.frame_chunk for e in self.server.events(alone) if e.HasField("frame_chunk")]
        self.assertGreater(len(seen), 9, "more than chunks of 128 rows would be")
        self.assertEqual([to_bytes(c) for c in seen], [to_bytes(c) for c in kept])

    def test_a_stream_that_is_resumed_has_what_the_first_one_had(self):
        name = self.server.create(slow_ball()).name
        first = self.server.wait_until(name, lambda event: event.HasField("frame_chunk")
                                       and event.frame_chunk.first_sample > 0)
        first = [to_bytes(event) for event in first if stored(event)]
        self.server.cancel(name)
        again = [to_bytes(event) for event in self.server.events(name) if stored(event)]
        self.assertEqual(again[:len(first)], first)


if __name__ == "__main__":
    unittest.main()
