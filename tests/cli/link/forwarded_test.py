"""A server on socket files, reached as by `ssh -L`, and the advice where one cannot be reached."""

import os
import pathlib
import re
import socket
import subprocess
import threading
import unittest
import urllib.request

from cli_case import CHAIN, CONTACTCTL, CliTest
from contactd import PATIENCE_S, Server

ROOT = pathlib.Path(__file__).parents[3]


def pump(source, target):
    try:
        while data := source.recv(16384):
            target.sendall(data)
        target.shutdown(socket.SHUT_WR)
    except OSError:
        pass


def forward(listener, path):
    """What `ssh -L` does: passes each connection on to the socket file."""
    while True:
        try:
            client, _ = listener.accept()
        except OSError:
            return
        server = socket.socket(socket.AF_UNIX)
        server.connect(str(path))
        for ends in (client, server), (server, client):
            threading.Thread(target=pump, args=ends, daemon=True).start()


class ForwardedTest(CliTest):

    def make_server(self):
        return Server(self.folder / "data", f"--listen=unix:{self.folder / 'contactd.sock'}",
                      f"--http-listen=unix:{self.folder / 'http.sock'}")

    def forward(self, listener, name):
        listener.listen()
        self.addCleanup(listener.close)
        threading.Thread(target=forward, args=(listener, self.folder / name), daemon=True).start()

    def test_socket_file_serves_contactctl(self):
        here = socket.socket(socket.AF_UNIX)
        here.bind(str(self.folder / "here.sock"))
        self.forward(here, "contactd.sock")
        self.run_it("run", CHAIN, server=f"unix:{self.folder / 'here.sock'}")

    def test_socket_file_serves_a_browser(self):
        here = socket.socket()
        here.bind(("127.0.0.1", 0))
        self.forward(here, "http.sock")
        port = here.getsockname()[1]
        request = urllib.request.Request(
            f"http://localhost:{port}/contact.v1.JobService/ListJobs", b"{}",
            {"Content-Type": "application/json", "Origin": f"http://localhost:{port}"})
        with urllib.request.urlopen(request, timeout=PATIENCE_S) as answer:
            self.assertEqual(answer.status, 200)

    def test_documents_name_the_socket_files_of_the_packages(self):
        settings = (ROOT / "deploy/debian/contactd.conf").read_text()
        for page in "deploy/README.md", "client/docs/guide/settings.md":
            paths = re.findall(r"ssh -N.*?-L \S+?:(/\S+)", (ROOT / page).read_text())
            self.assertEqual(len(paths), 2, page)
            for path in paths:
                self.assertIn(f'listen = "unix:{path}"', settings)


class AdviceTest(CliTest):

    def ask(self, path, *verb, user=None):
        run = subprocess.run([*(user or []), CONTACTCTL, "--server", f"unix:{path}", *verb],
                             capture_output=True, text=True, timeout=PATIENCE_S, check=False,
                             env={**os.environ, "HOME": str(self.folder)})
        self.assertEqual(run.returncode, 4, run.stderr)
        return run.stdout + run.stderr

    def test_socket_file_that_is_not_there_needs_a_server(self):
        self.assertIn("start one here:  contactd --listen unix:", self.ask(self.folder / "no", "list"))
        packaged = "/run/contactd/none.sock"
        self.assertIn("what helps:      sudo systemctl start contactd", self.ask(packaged, "list"))
        self.assertIn("fix: sudo systemctl start contactd", self.ask(packaged, "doctor"))

    def test_right_that_is_missing_is_not_a_server_that_is(self):
        path = self.folder / "closed.sock"
        with socket.socket(socket.AF_UNIX) as closed:
            closed.bind(str(path))
            closed.listen()
            path.chmod(0)
            self.folder.chmod(0o755)
            other = ["setpriv", "--reuid=nobody", "--regid=nogroup", "--clear-groups"]
            user = other if os.geteuid() == 0 else []
            self.assertIn("log in again", self.ask(path, "list", user=user))
            self.assertIn("fix: log in again", self.ask(path, "doctor", user=user))


if __name__ == "__main__":
    unittest.main()
