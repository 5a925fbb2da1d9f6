"""The checker finds each broken promise, and nothing where none is broken."""

import unittest

import grpc
from history import Call, Entry, Final, History, Job, violations

ONE, TWO = "digest of one spec", "digest of another"


def log(*kinds):
    """QUEUED, then RUNNING with an attempt, what is given, and the end."""
    entries = [Entry(0, "state_changed", "", state=Job.QUEUED),
               Entry(0, "state_changed", "", state=Job.RUNNING),
               Entry(0, "attempt_started", "", attempt=1),
               *kinds, Entry(0, "state_changed", "", state=Job.SUCCEEDED)]
    for i, entry in enumerate(entries):
        entry.sequence, entry.digest = i + 1, f"{entry.kind} {i + 1}"
    return entries


def frames(first, samples):
    return Entry(0, "frame_chunk", "", samples=(first, samples))


def cycle():
    return Entry(0, "cycle", "")


class Refused(grpc.RpcError):

    def __init__(self, code):
        super().__init__(code)
        self.code = lambda: code


class CheckerTest(unittest.TestCase):

    def setUp(self):
        self.history = History()
        self.note("submit", "ok", dict(request="a", spec=ONE), name="jobs/a")
        self.note("get", "ok", dict(name="jobs/a"), state=Job.SUCCEEDED)
        self.job = Final(Job.SUCCEEDED, 1, ONE, "a", "result",
                         log(cycle(), frames(0, 10), cycle(), frames(10, 5)))
        self.final = {"jobs/a": self.job}
        self.watch = self.history.watch("jobs/a")
        self.watch.entries = list(self.job.log)
        self.watch.position = len(self.job.log)
        self.watch.ended = True

    def note(self, op, outcome, args, **answer):
        now = float(len(self.history.calls))
        self.history.calls.append(Call(op, args, now, now + 0.5, outcome, answer))

    def found(self, **options):
        options = dict(golden={ONE: "result"}, max_attempts=1,
                       resources={"streams": (3, 3)}) | options
        return violations(self.history, self.final, **options)

    def assertBroken(self, promise, **options):
        found = self.found(**options)
        self.assertTrue(found)
        self.assertEqual({words[:2] for words in found}, {promise}, found)

    def test_good_history_passes(self):
        self.assertEqual(self.found(), [])

    def test_unknown_outcome_may_be_either(self):
        self.note("submit", "unknown", dict(request="b", spec=ONE))
        self.note("submit", "unknown", dict(request="c", spec=ONE))
        self.final["jobs/b"] = Final(Job.SUCCEEDED, 1, ONE, "b", "result", log())
        self.note("delete", "unknown", dict(name="jobs/a"))
        self.assertEqual(self.found(), [])
        del self.final["jobs/a"]
        self.assertEqual(self.found(), [])

    def test_refused_call_is_no_acknowledgement(self):
        with self.assertRaises(grpc.RpcError):
            with self.history.call("submit", request="b", spec=ONE):
                raise Refused(grpc.StatusCode.RESOURCE_EXHAUSTED)
        with self.assertRaises(grpc.RpcError):
            with self.history.call("submit", request="c", spec=ONE):
                raise Refused(grpc.StatusCode.UNAVAILABLE)
        self.assertEqual([call.outcome for call in self.history.calls[2:]], ["fail", "unknown"])
        self.assertEqual(self.found(), [])

    def test_lost_job(self):
        del self.final["jobs/a"]
        self.assertBroken("I1")

    def test_job_not_found_after_its_acknowledgement(self):
        self.note("get", "fail", dict(name="jobs/a"), code="NOT_FOUND")
        self.assertBroken("I1")

    def test_deleted_job_that_is_there(self):
        self.note("delete", "ok", dict(name="jobs/a"))
        self.assertBroken("I1")

    def test_two_jobs_of_one_request(self):
        self.final["jobs/b"] = Final(Job.SUCCEEDED, 1, ONE, "a", "result", log())
        self.assertBroken("I2")

    def test_one_request_with_two_specs(self):
        self.note("submit", "ok", dict(request="a", spec=TWO), name="jobs/a")
        self.assertBroken("I2")

    def test_job_that_was_refused_and_made(self):
        self.note("submit", "fail", dict(request="b", spec=ONE), code="RESOURCE_EXHAUSTED")
        self.final["jobs/b"] = Final(Job.SUCCEEDED, 1, ONE, "b", "result", log())
        self.assertBroken("I2")

    def test_missing_event(self):
        del self.watch.entries[4]
        self.assertBroken("I3")

    def test_doubled_event(self):
        self.watch.entries.insert(4, self.watch.entries[4])
        self.assertBroken("I3")

    def test_event_that_changed(self):
        self.watch.entries[3] = Entry(4, "cycle", "other")
        self.assertBroken("I3")

    def test_end_before_the_last_event(self):
        del self.watch.entries[-1]
        self.assertBroken("I3")

    def test_events_before_the_start_of_a_watch_are_not_missed(self):
        self.watch.after = 5
        self.watch.entries = self.job.log[5:]
        self.assertEqual(self.found(), [])

    def test_filter_leaves_out_other_kinds_but_no_state(self):
        self.watch.kinds = frozenset(["cycle"])
        self.watch.entries = [e for e in self.job.log if e.kind in ("cycle", "state_changed")]
        self.assertEqual(self.found(), [])
        del self.watch.entries[-1]
        self.assertBroken("I3")

    def test_gap_spares_frames_only(self):
        self.watch.spared = [(4, 7)]
        self.watch.entries = [e for e in self.job.log if e.kind != "frame_chunk"]
        self.assertEqual(self.found(), [])
        self.watch.entries = [e for e in self.watch.entries if e.kind != "cycle"]
        self.assertBroken("I3")

    def test_hole_in_the_log(self):
        for entry in self.job.log[5:]:
            entry.sequence += 1
        self.history.watches.clear()
        found = self.found()
        self.assertIn("I3", {words[:2] for words in found})

    def test_frames_of_an_earlier_attempt(self):
        self.job.log = log(frames(0, 10), Entry(0, "attempt_started", "", attempt=2),
                           frames(10, 5))
        self.job.attempt = 2
        self.history.watches.clear()
        self.assertBroken("I4", max_attempts=2)

    def test_attempt_that_goes_back(self):
        self.job.log = log(Entry(0, "attempt_started", "", attempt=2),
                           Entry(0, "attempt_started", "", attempt=1))
        self.history.watches.clear()
        self.assertBroken("I4")

    def test_cell_that_is_stored_twice(self):
        self.job.log = log(*(Entry(0, "sweep_cell", "", cell=cell) for cell in (0, 1)))
        self.history.watches.clear()
        self.assertEqual(self.found(), [])
        self.job.log[-2].cell = 0
        self.assertBroken("I4")

    def test_event_that_is_stored_twice(self):
        self.job.log = log(*(Entry(0, "cycle", "", content=f"cycle {i}") for i in (1, 2)))
        self.history.watches.clear()
        self.assertEqual(self.found(), [])
        self.job.log[-2].content = "cycle 1"
        self.assertBroken("I4")

    def test_two_ends(self):
        self.job.log = log(Entry(0, "state_changed", "", state=Job.CANCELLED))
        self.history.watches.clear()
        self.assertBroken("I5")

    def test_final_state_that_changes(self):
        self.note("get", "ok", dict(name="jobs/a"), state=Job.CANCELLED)
        self.assertBroken("I5")

    def test_wrong_result(self):
        self.job.result = "other"
        self.assertBroken("I6")

    def test_too_many_attempts(self):
        self.assertBroken("I7", max_attempts=0)

    def test_leak(self):
        self.assertBroken("I8", resources={"streams": (3, 4)})


if __name__ == "__main__":
    unittest.main()
