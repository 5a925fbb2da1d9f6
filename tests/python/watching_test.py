"""A watch hears each event once, across connections, from a server that breaks them."""

import asyncio
import concurrent.futures
import unittest
from unittest import mock

import grpc
from contact.v1 import event_pb2, job_pb2, job_service_pb2, job_service_pb2_grpc
from contactsim import AsyncClient, CallError, Client, JobNotFound, Timeout, watching

LOG = [event_pb2.Event(sequence=i, log_entry=event_pb2.LogEntry(message=str(i)))
       for i in range(1, 41)]
LOG.append(event_pb2.Event(
    sequence=41, state_changed=event_pb2.StateChanged(state=job_pb2.Job.SUCCEEDED)))
JOB = "abcdefghij"  # A whole ID, for which nobody is asked.


class BreakingServer(job_service_pb2_grpc.JobServiceServicer):
    """Repeats the last event that it sent, sends two new ones, and breaks the stream."""

    def __init__(self, code=grpc.StatusCode.UNAVAILABLE):
        self.code = code
        self.asked = []
        self._server = grpc.server(concurrent.futures.ThreadPoolExecutor(2))
        job_service_pb2_grpc.add_JobServiceServicer_to_server(self, self._server)
        self.address = f"127.0.0.1:{self._server.add_insecure_port('127.0.0.1:0')}"
        self._server.start()

    def WatchJob(self, request, context):
        self.asked.append(request.after_sequence)
        yield job_service_pb2.WatchJobResponse(
            snapshot=job_pb2.Job(state=job_pb2.Job.SUCCEEDED, last_sequence=41))
        first = max(0, request.after_sequence - 1)
        yield job_service_pb2.WatchJobResponse(events=LOG[first:request.after_sequence + 2])
        if request.after_sequence + 2 < len(LOG) and self.code:
            context.abort(self.code, "broken on purpose")

    def stop(self):
        self._server.stop(None).wait()


class WatchTest(unittest.TestCase):

    def setUp(self):
        patch = mock.patch.object(watching, "_FIRST_PAUSE_S", 0.001)
        patch.start()
        self.addCleanup(patch.stop)

    def serve(self, code):
        server = BreakingServer(code)
        self.addCleanup(server.stop)
        return server

    def test_no_event_is_missed_or_repeated_over_20_broken_links(self):
        for code in (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.INTERNAL, None):
            with self.subTest(code), Client(self.serve(code).address) as client:
                heard = [event.sequence for event in client.watch(JOB)]
                self.assertEqual(heard, list(range(1, 42)))

    def test_change_of_a_job_is_heard_once_over_broken_links(self):
        roster = watching.Roster("", ["RUNNING"], {"law": "a"}, None)
        def job(name, state=job_pb2.Job.RUNNING):
            return job_pb2.Job(name=name, state=state, attempt=1)
        def take(*jobs, gone=(), complete=True):
            message = job_service_pb2.WatchJobsResponse(jobs=jobs, gone=gone,
                                                        snapshot_complete=complete)
            return [(change.name, change.job is not None) for change in roster.take(message)]
        self.assertEqual(dict(roster.request().labels), {"law": "a"})
        self.assertEqual(take(job("jobs/1"), job("jobs/2")), [("jobs/1", True), ("jobs/2", True)])
        self.assertEqual(take(gone=["jobs/2", "jobs/9"]), [("jobs/2", False)])
        roster.request()
        self.assertEqual(take(job("jobs/3"), complete=False), [("jobs/3", True)])
        self.assertEqual(take(), [("jobs/1", False)])  # It is not in the new snapshot.
        roster.request()
        self.assertEqual(take(job("jobs/3")), [])
        self.assertEqual(take(job("jobs/3", job_pb2.Job.FAILED)), [("jobs/3", True)])

    def test_live_only_is_asked_for_once_and_then_resumed(self):
        position = watching.Position("jobs/x", "", live_only=True)
        self.assertTrue(position.request().live_only)
        position.take(job_service_pb2.WatchJobResponse(
            snapshot=job_pb2.Job(state=job_pb2.Job.RUNNING, last_sequence=7)))
        self.assertFalse(position.request().live_only)
        self.assertEqual(position.request().after_sequence, 7)

    def test_asynchronous_watch_does_the_same(self):
        server = self.serve(grpc.StatusCode.UNAVAILABLE)

        async def listen():
            async with AsyncClient(server.address) as client:
                return [event.sequence async for event in client.watch(JOB)]

        self.assertEqual(asyncio.run(listen()), list(range(1, 42)))
        self.assertEqual(server.asked, list(range(0, 41, 2)))

    def test_watch_after_the_last_event_ends(self):
        with Client(self.serve(None).address) as client:
            self.assertEqual(list(client.watch(JOB, after_sequence=41)), [])

    def test_refusal_is_final(self):
        server = self.serve(grpc.StatusCode.NOT_FOUND)
        with Client(server.address) as client, self.assertRaises(JobNotFound):
            list(client.watch(JOB))
        self.assertEqual(len(server.asked), 1)

    def test_pauses_grow_to_a_limit_and_start_anew_after_a_message(self):
        position = watching.Position("jobs/x", "nowhere")
        with mock.patch.object(watching.random, "uniform", return_value=1.0):
            pauses = [position.lost(None) for _ in range(20)]
            position.take(job_service_pb2.WatchJobResponse())
            self.assertLess(position.lost(None), pauses[1])
        self.assertEqual(pauses[1], 2 * pauses[0])
        self.assertEqual(pauses[-1], 10)

    def test_watch_gives_up_when_its_time_is_over(self):
        server = self.serve(None)
        with Client(server.address) as client, self.assertRaises(CallError) as caught:
            for event in client.watch(JOB, timeout_s=0):
                self.fail(f"{event} came after the end")
        self.assertIsInstance(caught.exception, (Timeout, TimeoutError))


if __name__ == "__main__":
    unittest.main()
