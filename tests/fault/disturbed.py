"""Clients that want something of several contactd to which something happens; then the books."""

import itertools
import threading
import time

from contact.v1 import scenario_pb2
from contactd import spring_wall, three_ball_chain
from fault import *

CLIENTS = 6


class AnyFront:
    """Each call goes to one of the fronts, of which some may be away."""

    def __init__(self, fronts, random):
        self.fronts, self.random = fronts, random

    @property
    def stub(self):
        while True:
            front = self.random.choice(self.fronts)
            if front.channel is not None:
                return front.stub
            time.sleep(0.01)


class DisturbedTest(FaultTest):
    """Nothing lost, nothing doubled, no result changed.

    Derived classes have `fronts` and `disturb()`."""

    attempts = 1000  # More than faults: what is lost here is lost to them, never to a bad job.

    def make_server(self):
        return Server(self.folder / "data", store="")

    def check(self):
        """Runs the clients beside `disturb`; returns all jobs, which have ended."""
        self.any = AnyFront(self.fronts, self.random)
        end_time = self.end_time(0.5)
        self.specs = [three_ball_chain(), spring_wall(0.1), spring_wall(end_time),
                      self.sweep(end_time)]
        golden = self.golden(*self.specs)
        self.done = threading.Event()
        with clients() as start:
            for number in range(CLIENTS):
                start(self.use, number)
            try:
                self.disturb()
            finally:
                self.done.set()
        final = self.assertPromises(self.fronts[0], golden=golden, max_attempts=self.attempts)
        self.figures |= dict(jobs=len(final), watches=len(self.history.watches),
                             cells=sum(entry.kind == "sweep_cell" for job in final.values()
                                       for entry in job.log),
                             most_attempts=max(job.attempt for job in final.values()))
        return final

    def sweep(self, end_time):
        """Of two seconds' work."""
        axis = scenario_pb2.Sweep.Axis(field="contacts[0].stiffness",
                                       values=[1.8e7 * (1 + i / 1000) for i in range(40)])
        return scenario_pb2.Sweep(base=spring_wall(end_time / 10), axes=[axis],
                                  metrics=["iterations"])

    def use(self, number):
        """Submits, follows some jobs to their ends, cancels few."""
        random = self.random.__class__(f"{self.seed} {number}")
        for i in itertools.count():
            if self.done.is_set():
                return
            spec = random.choices(self.specs, weights=[24, 12, 4, 2])[0]
            name = patient(lambda: submit(self.any, self.history, spec, f"{number}-{i}")).name
            what = random.random()
            if what < 0.1:
                self.cancel(name)
            if what < 0.5:
                follow(self.any, self.history.watch(name))
            else:
                time.sleep(random.uniform(0, 0.2))

    def cancel(self, name):
        request = job_service_pb2.CancelJobRequest(name=name)
        patient(lambda: self.any.stub.CancelJob(request, timeout=PATIENCE_S))
