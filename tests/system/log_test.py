"""What contactd says of its jobs and itself: in its log, on its output, and to systemd."""

import json
import os
import pathlib
import re
import socket
import subprocess
import tempfile
import unittest

from authority import Authority
from contactd import (BINARY, PATIENCE_S, Job, Server, ServerTest, endless, is_cycle,
                      three_ball_chain)


class TextLogTest(ServerTest):

    def moves(self, name):
        """(state, reason) of each line about a job."""
        found = re.findall(r"info job=(\S+) state=(\w+) attempt=\d+(?: reason=(\w+))?$",
                           self.server.log(), re.MULTILINE)
        return [(state, reason) for job, state, reason in found if job == name]

    def test_every_move_of_a_job_is_a_line(self):
        done = self.server.run(three_ball_chain()).name
        running = self.server.create(endless()).name
        self.server.wait_until(running, is_cycle)
        self.server.cancel(running)
        self.server.events(running)
        start = [("QUEUED", "WAITING_FOR_WORKER"), ("RUNNING", "")]
        self.assertEqual(self.moves(done), [*start, ("SUCCEEDED", "")])
        self.assertEqual(self.moves(running), [*start, ("CANCELLED", "USER_REQUEST")])


class JsonLogTest(ServerTest):

    flags = ("--log-format=json",)

    def test_every_line_is_an_object(self):
        name = self.server.run(three_ball_chain(title='"}{"level":"error')).name
        self.assertEqual(self.server.get(name).state, Job.SUCCEEDED)
        self.server.terminate()
        lines = [json.loads(line) for line in self.server.log().splitlines()]
        self.assertEqual(sum(line["message"].startswith(f"job={name} ") for line in lines), 3)
        for line in lines:
            self.assertEqual(set(line), {"time", "level", "message"})
            self.assertNotEqual(line["level"], "error")

    def test_the_line_that_tells_the_address_is_an_object_too(self):
        greeting = json.loads(self.server.greeting)
        self.assertEqual((set(greeting), greeting["level"]), ({"time", "level", "message"}, "info"))
        self.assertIn(f"listening on 127.0.0.1:{self.server.port}, data in", greeting["message"])


class NotifyTest(unittest.TestCase):
    """What systemd is told by a service of Type=notify."""

    def test_readiness_and_end_are_told(self):
        with tempfile.TemporaryDirectory(prefix="contactd-test-") as folder, \
                socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as manager:
            manager.bind(f"{folder}/notify")
            manager.settimeout(PATIENCE_S)
            server = Server(f"{folder}/data",
                            environment={**os.environ, "NOTIFY_SOCKET": f"{folder}/notify"})
            server.start()
            self.addCleanup(server.kill)
            self.assertEqual(manager.recv(4096), b"READY=1")
            server.run(three_ball_chain())  # It is: calls are answered.
            self.assertEqual(server.terminate()[0], 0)
            self.assertEqual(manager.recv(4096), b"STOPPING=1")

    def test_watchdog_is_fed_by_every_kind_of_listener(self):
        with tempfile.TemporaryDirectory(prefix="contactd-test-") as folder:
            ca = Authority(folder)
            certificate, key = ca.issue("server", "DNS:localhost")
            tls = (f"--tls-cert={certificate}", f"--tls-key={key}")
            rules = pathlib.Path(folder, "rules")
            rules.write_text("cert cn:ops user:ops tenant:acme roles:admin\n")
            for kind in ((), (f"--listen=unix:{folder}/socket",), tls,
                         (*tls, f"--tls-client-ca={ca.pem}", f"--identity-rules={rules}")):
                with self.subTest(kind):
                    self.assertEqual(self.fed(folder, kind), 2)

    @staticmethod
    def fed(folder, flags):
        """How often a server feeds a watchdog of .6 s, until it has done so twice."""
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as manager, \
                tempfile.TemporaryDirectory(dir=folder) as place:
            manager.bind(f"{place}/notify")
            manager.settimeout(PATIENCE_S)
            server = Server(f"{place}/data", *flags, environment={
                **os.environ, "NOTIFY_SOCKET": f"{place}/notify", "WATCHDOG_USEC": "600000"})
            server.start()
            try:
                told = [manager.recv(4096) for _ in range(3)]
            finally:
                server.kill()
            return told.count(b"WATCHDOG=1")

    def test_a_server_that_cannot_listen_is_never_ready(self):
        with tempfile.TemporaryDirectory(prefix="contactd-test-") as folder, \
                socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as manager, \
                socket.create_server(("127.0.0.1", 0)) as taken:
            manager.bind(f"{folder}/notify")
            manager.setblocking(False)
            run = subprocess.run(
                [BINARY, f"--listen=127.0.0.1:{taken.getsockname()[1]}", f"--data-dir={folder}/data"],
                env={**os.environ, "NOTIFY_SOCKET": f"{folder}/notify"}, capture_output=True,
                timeout=PATIENCE_S)
            self.assertNotEqual(run.returncode, 0)
            with self.assertRaises(BlockingIOError):
                manager.recv(4096)


if __name__ == "__main__":
    unittest.main()
