"""A full disk refuses, at once and in words, and loses nothing; with space again all goes on."""

import time
import unittest

import power_cut
from contactd import endless, spring_wall, three_ball_chain
from fault import *


class DiskFullTest(FaultTest):
    """F4."""

    def make_server(self):
        self.full = self.folder / "full"
        environment = power_cut.environment(self.folder / "data", self.folder / "notes",
                                            full=self.full)
        return Server(self.folder / "data", "--workers=2", environment=environment)

    def test_full_disk_refuses_and_recovers_without_a_restart(self):
        golden = self.golden(three_ball_chain(), spring_wall(1.0))
        ended = submit(self.server, self.history, three_ball_chain(), "before").name
        follow(self.server, self.history.watch(ended))
        long = submit(self.server, self.history, endless(), "long").name
        wait_for(lambda: self.server.get(long).last_sequence > 20)
        running = submit(self.server, self.history, spring_wall(1.0), "running").name

        self.full.touch()
        self.assertKept("refused_after", self.refusal(), 1)
        wait_for(lambda: f"job={long} cannot store events" in self.server.log())
        self.assertEqual(get(self.server, self.history, ended).state, Job.SUCCEEDED)
        self.assertTrue(self.server.list().jobs)
        follow(self.server, self.history.watch(ended))
        self.assertEqual(get(self.server, self.history, long).state, Job.RUNNING)

        self.full.unlink()
        recovered = wait_for(lambda: self.accepted("after"))
        stored = self.server.get(long).last_sequence
        recovered += wait_for(lambda: self.server.get(long).last_sequence > stored)
        self.assertKept("recovered_after", recovered, 2)
        follow(self.server, self.history.watch(running))
        self.server.cancel(long)
        self.assertPromises(self.server, golden=golden, max_attempts=1)
        for name in long, running:
            starts = [event for event in self.server.events(name)
                      if event.HasField("attempt_started")]
            self.assertEqual(len(starts), 1, f"{name} did not wait but began again")

    def refusal(self):
        """Seconds that the first refusal took; space inside of the files is used up before."""
        for i in range(1000):
            start = time.monotonic()
            if not self.accepted(f"full-{i}"):
                return time.monotonic() - start
        raise AssertionError("1000 jobs were accepted on a full disk")

    def accepted(self, request):
        try:
            submit(self.server, self.history, three_ball_chain(), request)
            return True
        except grpc.RpcError as error:
            self.assertEqual(error.code(), grpc.StatusCode.RESOURCE_EXHAUSTED, error)
            self.assertEqual(details_of(error)["ErrorInfo"].reason, "STORE_FULL")
            return False


class StoreLimitTest(FaultTest):
    """F4, with a limit of our own."""

    flags = ("--workers=2", "--max-stored-bytes=2000000")

    def test_deleting_makes_space(self):
        scenario = spring_wall(0.05)
        scenario.output.sample_interval_s = 1e-5
        golden = self.golden(scenario)
        names = []
        full = False  # Ends, which are large, find no space before new jobs do.
        with self.assertRaises(grpc.RpcError) as refused:
            for i in range(500):
                names.append(submit(self.server, self.history, scenario, f"{i}").name)
                full = full or not ends(self.server, names[-1])
        self.assertEqual(details_of(refused.exception)["ErrorInfo"].reason, "STORE_FULL")
        self.assertEqual(get(self.server, self.history, names[0]).state, Job.SUCCEEDED)
        self.delete_ended()
        recovered = wait_for(lambda: all_jobs(self.server, states=[Job.SUCCEEDED]))
        # A job that found no space for its end tries again each second.
        wait_for(self.all_have_ended, limit=len(names))
        submit(self.server, self.history, scenario, "after")
        self.figures |= dict(jobs=len(names))
        self.assertKept("recovered_after", recovered, 2)
        self.assertPromises(self.server, golden=golden, max_attempts=1)

    def delete_ended(self):
        for job in all_jobs(self.server, states=[Job.SUCCEEDED]):
            with self.history.call("delete", name=job.name) as call:
                self.server.delete(job.name)
                call.ok()

    def all_have_ended(self):
        """Those who waited for space need it one after the other."""
        self.delete_ended()
        return not all_jobs(self.server, states=[Job.QUEUED, Job.RUNNING])


def ends(server, name):
    """Whether it ends within a second: on a full store it does not."""
    try:
        wait_for(lambda: server.get(name).state == Job.SUCCEEDED, limit=1)
        return True
    except AssertionError:
        return False


if __name__ == "__main__":
    unittest.main()
