"""kill -9 of the server: nothing acknowledged is lost, nothing is computed differently."""

import hashlib
import threading
import time
import unittest

from contact.v1 import scenario_pb2
from contactd import spring_wall, three_ball_chain, to_bytes
from fault import *

KILLS = 10


class KillTest(FaultTest):
    """F1."""

    flags = ("--workers=5", f"--max-attempts={10 * KILLS}")

    def test_ten_kills_lose_nothing(self):
        end_time = self.end_time(1)
        chain, long = three_ball_chain(), [spring_wall(end_time + 0.1 * i) for i in range(4)]
        golden = self.golden(chain, *long)
        running = [submit(self.server, self.history, scenario, f"long-{i}").name
                   for i, scenario in enumerate(long)]
        done = threading.Event()
        back = {name: 0.0 for name in running}  # When its watcher last heard of it.

        def keep_submitting(client):
            for i in range(1000):
                if done.is_set():
                    return
                patient(lambda i=i: submit(self.server, self.history, chain, f"{client}-{i}"))
                time.sleep(0.2)

        def hear(name):
            def on_event(_):
                back[name] = time.monotonic()
            return on_event

        requeued, caught_up = [], []
        with clients() as start:
            for client in range(8):
                start(keep_submitting, client)
            for name in running:
                start(follow, self.server, self.history.watch(name), hear(name))
            for _ in range(KILLS):
                time.sleep(self.random.uniform(0.1, 0.6))
                self.server.kill()
                self.server.start()
                restart = time.monotonic()
                requeued.append(wait_for(lambda: all(
                    get(self.server, self.history, name).state != Job.QUEUED
                    for name in running)))
                wait_for(lambda: all(watch.ended or back[watch.job] > restart
                                     for watch in self.history.watches))
                caught_up.append(max(back.values()) - restart)
            done.set()
        final = self.assertPromises(self.server, golden=golden, max_attempts=KILLS + 1)
        attempts = [final[name].attempt for name in running]
        self.assertGreater(max(attempts), 1, "no kill met a running job")
        self.figures |= dict(kills=KILLS, jobs=len(final), attempts=attempts)
        self.assertKept("running_again", max(requeued), 2)
        self.assertKept("watchers_back", max(caught_up), 3)


class ResumeTest(FaultTest):
    """F2."""

    flags = ("--workers=5", f"--max-attempts={10 * KILLS}")

    def test_a_killed_run_gives_the_same_bytes(self):
        end_time = self.end_time(1)
        specs = {
            "driven wall": Job(scenario=spring_wall(end_time)),
            "without a trajectory": Job(scenario=spring_wall(1.5 * end_time)),
            "finely sampled": Job(scenario=spring_wall(0.3)),
            "chain": Job(scenario=three_ball_chain(output=dict(sample_interval_s=1e-7))),
            "sweep": Job(sweep=chain_sweep()),
        }
        specs["without a trajectory"].scenario.output.ledger_only = True
        specs["finely sampled"].scenario.output.sample_interval_s = 2e-5
        undisturbed = {spec: self.outcome(self.create(job)) for spec, job in specs.items()}
        names = {spec: self.create(job) for spec, job in specs.items()}
        for _ in range(3):
            time.sleep(self.random.uniform(0.1, 0.5))
            self.server.kill()
            self.server.start()
        disturbed = {spec: self.outcome(name) for spec, name in names.items()}
        self.assertEqual(disturbed, undisturbed, f"seed {self.seed}")
        attempts = {spec: self.server.get(name).attempt for spec, name in names.items()}
        self.assertGreater(sum(attempts.values()), len(specs), "no kill met a running job")
        self.figures |= dict(attempts=list(attempts.values()))

    def create(self, job):
        request = job_service_pb2.CreateJobRequest(job=job)
        return self.server.stub.CreateJob(request, timeout=PATIENCE_S).name

    def outcome(self, name):
        """Digests of the result, and of the durable events of the last attempt without their
        times and places; of a sweep, whose cells stay, of all cells by number."""
        # The end is awaited first: who reads slowly beside a run is left out of frame chunks.
        self.server.events(name, kinds=["state_changed"])
        events = [event for event in self.server.events(name)
                  if event.WhichOneof("payload") not in ("progress", "bookmark")]
        starts = [i for i, event in enumerate(events) if event.HasField("attempt_started")]
        last = events[starts[-1] + 1:]
        cells = [event for event in events if event.HasField("sweep_cell")]
        if cells:
            last = sorted(cells, key=lambda event: event.sweep_cell.index)
        sha = hashlib.sha256()
        for event in last:
            event.ClearField("sequence")
            event.ClearField("event_time")
            sha.update(to_bytes(event))
        job = self.server.get(name)
        self.assertEqual(job.state, Job.SUCCEEDED)
        return len(last), sha.hexdigest(), result_digest(job)


def chain_sweep():
    """Cells that take about a second together."""
    axis = scenario_pb2.Sweep.Axis(
        field="contacts[0].restitution",
        linear=scenario_pb2.Sweep.Range(low=0.7, high=0.9, count=300))
    return scenario_pb2.Sweep(base=three_ball_chain(), axes=[axis],
                              metrics=["iterations", "cycles[0].mu"])


if __name__ == "__main__":
    unittest.main()
