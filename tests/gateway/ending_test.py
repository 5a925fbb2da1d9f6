"""SIGTERM while clients call by every door at once: the server ends as it should, each time."""

import http.client
import itertools
import json
import os
import socket
import threading
import time
import unittest

import grpc
from contact.v1 import job_service_pb2, job_service_pb2_grpc
from contactd import PATIENCE_S, Job, endless_and_slow, wait_for
from gateway import SERVICE, GatewayTest, frame, frames

ROUNDS = 5 if os.environ.get("CONTACT_SANITIZE") else 20
LOAD_S = 0.2
INFO = job_service_pb2.GetServerInfoRequest()


class EndingTest(GatewayTest):
    http_flags = ("--workers=1",)

    @property
    def flags(self):
        self.socket = self.folder / "socket"
        return (*super().flags, f"--listen-admin=unix:{self.socket}")

    def setUp(self):
        super().setUp()
        self.job = self.server.create(endless_and_slow()).name
        self.over = threading.Event()
        self.lock = threading.Lock()
        self.answered, self.ends = 0, set()

    def count(self, end=None):
        """An answer came; of a stream by HTTP, `end` is the code with which it ended."""
        with self.lock:
            self.answered += 1
            if end:
                self.ends.add(end)

    def native(self, address, call):
        """Calls the server again and again until it has gone; a new connection for each stream."""
        while not self.over.is_set():
            with grpc.insecure_channel(address) as channel:
                stub = job_service_pb2_grpc.JobServiceStub(channel)
                try:
                    while not self.over.is_set():
                        call(stub)
                        self.count()
                except grpc.RpcError:
                    pass

    def info(self, stub):
        stub.GetServerInfo(INFO, timeout=PATIENCE_S)

    def watch(self, stub):
        request = job_service_pb2.WatchJobRequest(name=self.job)
        for _ in stub.WatchJob(request, timeout=PATIENCE_S):
            self.count()

    def web(self, method, target, body, kind, end_of=lambda body: None):
        """The same by HTTP, on one connection until that has gone."""
        while not self.over.is_set():
            connection = http.client.HTTPConnection("127.0.0.1", self.http, timeout=PATIENCE_S)
            try:
                while not self.over.is_set():
                    connection.request(method, target, body, {"content-type": kind})
                    self.count(end_of(connection.getresponse().read()))
            except (OSError, http.client.HTTPException):
                pass
            finally:
                connection.close()

    def leave(self, body):
        """Opens a stream and leaves, again and again: the server cancels it."""
        head = self.request("POST", body, target=SERVICE + "WatchJob").replace(
            b"application/json", b"application/connect+json")
        while not self.over.is_set():
            try:
                with socket.create_connection(("127.0.0.1", self.http), PATIENCE_S) as raw:
                    raw.sendall(head)
                    raw.recv(1)
            except OSError:
                pass
            self.count()

    def loads(self):
        watch = frame(json.dumps({"name": self.job}).encode())
        follow = frame(b"{}")
        connect_end = lambda body: json.loads(frames(body)[-1][1])["error"]["code"]
        web_end = lambda body: f"grpc-status {frames(body)[-1][1].split()[1].decode()}"
        tcp, file = self.server.address, f"unix:{self.socket}"
        yield from itertools.product([self.native], [tcp, file], [self.info, self.watch])
        post = (self.web, "POST")
        yield *post, SERVICE + "GetServerInfo", b"{}", "application/json"
        yield *post, SERVICE + "GetServerInfo", frame(b""), "application/grpc-web"
        yield *post, SERVICE + "WatchJob", watch, "application/connect+json", connect_end
        yield *post, SERVICE + "WatchJobs", follow, "application/connect+json", connect_end
        yield *post, SERVICE + "WatchJob", frame(job_service_pb2.WatchJobRequest(
            name=self.job).SerializeToString()), "application/grpc-web", web_end
        yield self.web, "GET", "/readyz", None, "text/plain"
        yield self.web, "GET", "/", None, "text/plain"
        yield self.leave, watch

    def one_round(self):
        """Ends the server under load; returns how long that took."""
        self.over.clear()
        threads = [threading.Thread(target=load[0], args=load[1:]) for load in self.loads()]
        for thread in threads:
            thread.start()
        try:
            wait_for(lambda: self.server.get(self.job).state == Job.RUNNING)
            self.assertEqual(self.server.get(self.job).attempt, 1)
            time.sleep(LOAD_S)
            code, elapsed = self.server.terminate()
        finally:
            self.over.set()
            for thread in threads:
                thread.join()
        self.assertEqual(code, 0, self.server.log())
        return elapsed

    def test_a_server_that_is_called_by_every_door_ends_as_it_should(self):
        longest = 0.0
        for _ in range(ROUNDS):
            longest = max(longest, self.one_round())
            self.server.start()
            self.http = int((self.folder / "http").read_text())
        print(f"{ROUNDS} ends, the longest took {longest:.2f} s; {self.answered} answers")
        self.assertLess(longest, 5)
        wait_for(lambda: self.server.get(self.job).state == Job.RUNNING)
        self.assertEqual(self.server.get(self.job).attempt, 1)
        self.assertEqual(self.ends, {"unavailable", "grpc-status 14"})


if __name__ == "__main__":
    unittest.main()
