"""What survives the end of a server, of a watcher and of patience."""

import pathlib
import signal
import subprocess
import sys
import threading
import time
import unittest

import grpc
from contact.v1 import job_service_pb2
from contactd import (BINARY, PATIENCE_S, Job, Server, ServerTest, endless, is_cycle,
                      spring_wall, stored, three_ball_chain, to_bytes)

WATCHER = """
import sys
from contactd import *
channel = grpc.insecure_channel(sys.argv[1])
stub = job_service_pb2_grpc.JobServiceStub(channel)
for message in stub.WatchJob(job_service_pb2.WatchJobRequest(name=sys.argv[2])):
    print(len(message.events), flush=True)
"""


class KillTest(ServerTest):

    flags = ("--workers=1",)

    def test_acknowledged_jobs_survive_kill_9(self):
        running = self.server.create(endless()).name
        before = self.server.wait_until(running, is_cycle)
        queued = [self.server.create(three_ball_chain(), request_id=str(i)).name
                  for i in range(5)]
        self.server.kill()
        self.server.start()

        self.assertEqual({job.name for job in self.server.list().jobs}, {running, *queued})
        again = self.server.wait_until(
            running, lambda e: e.HasField("attempt_started") and e.attempt_started.attempt == 2)
        kept = [event for event in before if stored(event)]
        self.assertEqual(again[:len(kept)], kept)
        reasons = [e.state_changed.state_reason for e in again if e.HasField("state_changed")]
        self.assertIn("SERVER_RESTARTED", reasons)

        self.assertEqual(self.server.create(three_ball_chain(), request_id="3").name, queued[3])
        self.server.cancel(running)
        self.assertWholeLog(self.server.events(running))
        for name in queued:
            self.assertWholeLog(self.server.events(name))
            self.assertEqual(self.server.get(name).state, Job.SUCCEEDED)

    def test_acknowledged_labels_and_notes_survive_kill_9_and_the_run_that_goes_on(self):
        name = self.server.create(endless()).name
        self.server.wait_until(name, is_cycle)
        self.server.stub.UpdateJob(job_service_pb2.UpdateJobRequest(
            job=Job(name=name, labels={"law": "x"}, note="good")), timeout=PATIENCE_S)
        self.server.kill()
        self.server.start()
        self.server.wait_until(
            name, lambda e: e.HasField("attempt_started") and e.attempt_started.attempt == 2)
        self.server.cancel(name)
        self.assertWholeLog(self.server.events(name))
        job = self.server.get(name)
        self.assertEqual((job.state, job.labels, job.note), (Job.CANCELLED, {"law": "x"}, "good"))

    def test_result_after_a_kill_is_that_of_an_undisturbed_run(self):
        scenario = spring_wall(end_time_s=0.5)
        undisturbed = self.server.run(scenario)
        name = self.server.create(scenario).name
        self.server.wait_until(name, is_cycle)
        self.server.kill()
        self.server.start()
        self.assertWholeLog(self.server.events(name))
        job = self.server.get(name)
        self.assertEqual(job.state, Job.SUCCEEDED)
        self.assertGreater(len(job.cycles), 100)
        for result in "cycles", "groups", "final_bodies":
            self.assertEqual([to_bytes(part) for part in getattr(job, result)],
                             [to_bytes(part) for part in getattr(undisturbed, result)])

    def test_watch_goes_on_where_the_kill_cut_it(self):
        name = self.server.create(endless()).name
        seen = self.server.wait_until(name, is_cycle)
        self.server.kill()
        self.server.start()
        self.server.cancel(name)
        last = max(event.sequence for event in seen if stored(event))
        self.assertWholeLog(self.server.events(name, after_sequence=last), after=last)


class DrainTest(ServerTest):

    flags = ("--workers=1",)

    def test_sigterm_ends_watches_and_puts_jobs_back(self):
        name = self.server.create(endless()).name
        self.server.wait_until(name, is_cycle)
        call = self.server.watch(name)
        next(call)
        self.server.process.send_signal(signal.SIGTERM)
        with self.assertRaises(grpc.RpcError) as caught:
            for _ in call:
                pass
        self.assertEqual(caught.exception.code(), grpc.StatusCode.UNAVAILABLE)
        code, elapsed = self.server.terminate()
        self.assertEqual(code, 0, self.server.log())
        self.assertLess(elapsed, 5)

        self.server.start()
        deadline = time.monotonic() + PATIENCE_S
        while (job := self.server.get(name)).state == Job.QUEUED and time.monotonic() < deadline:
            time.sleep(0.02)
        self.assertEqual(job.state, Job.RUNNING)
        self.assertEqual(job.attempt, 1, "a shutdown burns no attempt")
        self.server.cancel(name)
        self.assertWholeLog(self.server.events(name))

    def test_stalled_watcher_does_not_hold_up_the_end(self):
        name = self.server.create(endless()).name
        call = self.server.watch(name)  # Never read.
        self.server.wait_until(name, is_cycle)
        code, elapsed = self.server.terminate()
        self.assertEqual(code, 0, self.server.log())
        self.assertLess(elapsed, 5)
        call.cancel()


class WatcherTest(ServerTest):

    def test_killed_watcher_leaves_the_job_running(self):
        name = self.server.create(endless()).name
        watcher = subprocess.Popen(
            [sys.executable, "-c", WATCHER, f"127.0.0.1:{self.server.port}", name],
            stdout=subprocess.PIPE, cwd=pathlib.Path(__file__).parent)
        for _ in range(3):
            watcher.stdout.readline()
        watcher.kill()
        watcher.wait(PATIENCE_S)
        watcher.stdout.close()

        self.server.wait_until(name, is_cycle)
        self.assertEqual(self.server.get(name).state, Job.RUNNING)
        self.server.cancel(name)
        self.assertWholeLog(self.server.events(name))

    def test_many_watchers_see_the_same(self):
        name = self.server.create(spring_wall(end_time_s=0.2)).name
        logs = [None] * 8

        def watch(i):
            logs[i] = [e for e in self.server.events(name) if e.sequence > 0]

        threads = [threading.Thread(target=watch, args=(i,)) for i in range(len(logs))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(PATIENCE_S)
        durable = [[e for e in log if not e.HasField("frame_chunk") and not e.HasField("gap")]
                   for log in logs]
        for log in durable[1:]:
            self.assertEqual(list(map(repr, log)), list(map(repr, durable[0])))  # NaN is not NaN.


class StartTest(ServerTest):

    def refused(self, *flags):
        """Exit code and words of a contactd that must not start."""
        run = subprocess.run([BINARY, *flags], capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual(run.stdout, "")
        return run.returncode, run.stderr

    def test_second_server_on_the_data_is_refused(self):
        code, words = self.refused("--listen=127.0.0.1:0", f"--data-dir={self.server.data_dir}")
        self.assertEqual(code, 3, words)
        self.assertIn(str(self.server.data_dir), words)

    def test_second_server_on_the_port_is_refused(self):
        code, words = self.refused(f"--listen=127.0.0.1:{self.server.port}",
                                   f"--data-dir={self.folder / 'other'}")
        self.assertEqual(code, 3, words)
        self.assertIn(str(self.server.port), words)

    def test_bad_flags_and_bad_data_are_usage_errors(self):
        self.assertEqual(self.refused("--workers=0")[0], 2)
        self.assertEqual(self.refused("--no-such-flag")[0], 2)
        data = f"--data-dir={self.folder / 'other'}"
        self.assertEqual(self.refused("--listen=0.0.0.0:0", data)[0], 2)
        (self.folder / "file").write_text("")
        self.assertEqual(self.refused(f"--data-dir={self.folder / 'file'}")[0], 2)

    def test_damaged_data_is_refused_and_left_alone(self):
        self.server.terminate()
        database = self.server.data_dir / "contactd.db"
        whole = database.read_bytes()
        for damaged in b"", b"x" * 100 + whole[100:]:
            database.write_bytes(damaged)
            code, words = self.refused(f"--data-dir={self.server.data_dir}", "--listen=127.0.0.1:0")
            self.assertEqual(code, 2, words)
            self.assertEqual(database.read_bytes(), damaged)
        database.write_bytes(whole)
        self.server.start()

    def test_port_file_holds_the_port(self):
        port_file = self.folder / "port"
        other = Server(self.folder / "other", f"--port-file={port_file}")
        self.addCleanup(other.kill)
        other.start()
        self.assertEqual(int(port_file.read_text()), other.port)


if __name__ == "__main__":
    unittest.main()
