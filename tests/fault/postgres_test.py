"""The database of --store dies, loses its connections, and comes back: nobody notices but by waiting."""

import os
import threading
import time
import unittest

os.environ["CONTACT_STORE"] = "postgres"
from contactd import cluster, database_of, endless_and_slow, spring_wall, three_ball_chain
from fault import *
from shared import Shared

ROUNDS = 6


class OutageTest(FaultTest):
    """F17, with one contactd."""

    flags = ("--workers=5", f"--max-attempts={10 * ROUNDS}")

    def test_what_was_acknowledged_outlives_the_database_and_the_server(self):
        end_time = self.end_time(0.6)
        chain, long = three_ball_chain(), [spring_wall(end_time + 0.1 * i) for i in range(4)]
        golden = self.golden(chain, *long)
        running = [submit(self.server, self.history, scenario, f"long-{i}").name
                   for i, scenario in enumerate(long)]
        done = threading.Event()

        def keep_submitting(client):
            for i in range(1000):
                if done.is_set():
                    return
                patient(lambda i=i: submit(self.server, self.history, chain, f"{client}-{i}"))
                time.sleep(0.1)

        faults = [self.kill_database, self.cut_connections, self.kill_server] * (ROUNDS // 3)
        self.random.shuffle(faults)
        answered = {}
        with clients() as start:
            for client in range(6):
                start(keep_submitting, client)
            for name in running:
                start(follow, self.server, self.history.watch(name))
            for fault in faults:
                time.sleep(self.random.uniform(0.1, 0.5))
                fault()
                began = time.monotonic()
                patient(lambda: get(self.server, self.history, running[0]))
                answered.setdefault(fault.__name__, []).append(time.monotonic() - began)
            done.set()
        final = self.assertPromises(self.server, golden=golden, max_attempts=ROUNDS + 1)
        self.figures |= dict(jobs=len(final), attempts=[final[name].attempt for name in running])
        for what, times in answered.items():
            self.assertKept(what + "_answers_again", max(times), 2)

    def kill_database(self):
        """As kill -9 does, and half a second without it."""
        cluster().kill()
        time.sleep(0.5)
        cluster().start()

    def cut_connections(self):
        cluster().run("SELECT pg_terminate_backend(pid) FROM pg_stat_activity"
                      " WHERE application_name = 'contactd'")

    def kill_server(self):
        self.server.kill()
        self.server.start()


class AwayTest(FaultTest):
    """A database that does not come back soon."""

    def test_calls_are_refused_soon_and_runs_wait(self):
        name = self.server.create(spring_wall(self.end_time(1.5))).name
        wait_for(lambda: self.server.get(name).state == Job.RUNNING)
        cluster().kill()
        began = time.monotonic()
        with self.assertRaises(grpc.RpcError) as caught:
            self.server.get(name)
        self.assertKept("refused_after", time.monotonic() - began, 3)
        self.assertEqual(caught.exception.code(), grpc.StatusCode.UNAVAILABLE)
        self.assertEqual(details_of(caught.exception)["ErrorInfo"].reason, "STORE_FAILED")
        self.assertNotIn("/tmp", caught.exception.details(), "clients learn no paths")
        time.sleep(2)
        cluster().start()
        patient(lambda: self.server.get(name))
        follow(self.server, self.history.watch(name))
        job = self.server.get(name)
        self.assertEqual((job.state, job.attempt), (Job.SUCCEEDED, 1), "the run went on")

    def behind_a_proxy(self):
        """Moves the server there; returns the proxy."""
        way, address = Shared(self).way()
        self.server.kill()
        self.server = Server(self.folder / "behind", f"--store={address}", store="")
        self.addCleanup(self.server.kill)
        self.server.start()
        return way

    def test_idle_server_outlives_a_network_that_says_nothing(self):
        way = self.behind_a_proxy()
        way.pause()
        time.sleep(17)  # It asks after 5 s of silence, and waits for the answer.
        way.resume()
        name = patient(lambda: submit(self.server, self.history, three_ball_chain(), "after")).name
        follow(self.server, self.history.watch(name))
        self.assertIsNone(self.server.process.poll(), "it is the same process")

    def test_what_a_network_held_back_comes_too_late(self):
        way = self.behind_a_proxy()
        name = submit(self.server, self.history, endless_and_slow(), "stalled").name
        for _ in range(3):
            before = self.server.get(name).last_sequence
            wait_for(lambda: self.server.get(name).last_sequence > before)
            time.sleep(self.random.uniform(0.1, 0.2))  # Nobody asks but the run.
            way.stall()
            time.sleep(5.5)
            before = patient(lambda: self.server.get(name)).last_sequence
            wait_for(lambda: self.server.get(name).last_sequence > before)
            way.resume()
        self.server.cancel(name)
        follow(self.server, self.history.watch(name))
        self.assertPromises(self.server)

    def test_secrets_of_the_address_are_not_told(self):
        server = Server(self.folder / "secret", store="")
        server.flags = ("--store=" + database_of(self.server.data_dir).replace(
            "contactd@/", "contactd:hunter2@/no_such_"),)
        with self.assertRaises(RuntimeError) as caught:
            server.start()
        self.assertIn("does not exist", server.log())
        self.assertNotIn("hunter2", str(caught.exception) + server.log())


class FullTest(FaultTest):
    """F4, with a disk of the database that is full: nothing can be stored, all can be read."""

    flags = ("--workers=2",)
    FILE = "base/16384/16400"

    def test_full_database_refuses_and_recovers_without_a_restart(self):
        golden = self.golden(three_ball_chain())
        ended = submit(self.server, self.history, three_ball_chain(), "before").name
        follow(self.server, self.history.watch(ended))
        long = submit(self.server, self.history, endless_and_slow(), "long").name
        wait_for(lambda: self.server.get(long).last_sequence > 20)
        self.fill()
        began = time.monotonic()
        told = self.assertFails(grpc.StatusCode.RESOURCE_EXHAUSTED, "STORE_FULL", submit,
                                self.server, self.history, three_ball_chain(), "full")
        self.assertNotIn(self.FILE, told["message"])
        self.assertIn(self.FILE, self.server.log())
        self.assertKept("refused_after", time.monotonic() - began, 1)
        wait_for(lambda: f"job={long} cannot store events" in self.server.log())
        follow(self.server, self.history.watch(ended))
        self.assertEqual(get(self.server, self.history, long).state, Job.RUNNING)
        stored = self.server.get(long).last_sequence
        self.empty()
        submit(self.server, self.history, three_ball_chain(), "after")
        recovered = wait_for(lambda: self.server.get(long).last_sequence > stored)
        self.assertKept("recovered_after", recovered, 2)
        self.server.cancel(long)
        final = self.assertPromises(self.server, golden=golden, max_attempts=1)
        starts = sum(entry.kind == "attempt_started" for entry in final[long].log)
        self.assertEqual(starts, 1, "it did not wait but began again")

    def fill(self):
        """What PostgreSQL says when a table can have no new page, with an SQLSTATE of its own."""
        self.ask("CREATE FUNCTION full_disk() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN"
                 f" RAISE EXCEPTION 'could not extend file \"{self.FILE}\"'"
                 " USING ERRCODE = 'disk_full'; END $$")
        for table in "jobs", "events":
            self.ask(f"CREATE TRIGGER full_disk BEFORE INSERT OR UPDATE ON contactd.{table}"
                     " EXECUTE FUNCTION full_disk()")

    def empty(self):
        self.ask("DROP FUNCTION full_disk CASCADE")

    def ask(self, sql):
        cluster().run(sql, database_of(self.server.data_dir).split("@/")[1].split("?")[0])


if __name__ == "__main__":
    unittest.main()
