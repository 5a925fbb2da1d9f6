"""Two fronts behind nginx with the configuration of deploy/nginx, and one worker, over one
database: a client notices neither which front answers nor that one is gone."""

import os
import pathlib
import socket
import subprocess
import unittest

import grpc
from authority import Authority
from contact.v1 import job_service_pb2, job_service_pb2_grpc
from contactd import BINARY, PATIENCE_S, Job, Server, ServerTest, cluster, three_ball_chain
from tools import tool

SHIPPED = pathlib.Path(__file__).resolve().parents[2] / "deploy/nginx/contactd-fronts.conf"
DATABASE = "fronts"


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


def kill(process):
    process.kill()
    process.wait()


class FrontsTest(ServerTest):
    """`self.server` is the first front, `self.second` the other one; calls go by nginx."""

    def make_front(self, name):
        return Server(self.folder / name, f"--store={cluster().address(DATABASE)}", "--role=front",
                      f"--tls-cert={self.folder}/server.pem", f"--tls-key={self.folder}/server.key",
                      f"--tokens={self.folder}/tokens", store="")

    def make_server(self):
        self.nginx = tool("nginx")
        self.ca = Authority(self.folder)
        self.ca.issue("server", "DNS:localhost")
        self.token = subprocess.run(
            [os.environ["CONTACTCTL"], "server", "token", "create", "--tokens",
             self.folder / "tokens", "--name", "ada", "--tenant", "lab", "--role", "submit"],
            check=True, capture_output=True, text=True).stdout.strip()
        cluster().run(f"DROP DATABASE IF EXISTS {DATABASE} WITH (FORCE)")
        subprocess.run([BINARY, "migrate", f"--store={cluster().create(DATABASE)}"], check=True,
                       timeout=PATIENCE_S)
        return self.make_front("first")

    def setUp(self):
        super().setUp()
        self.second = self.make_front("second").start()
        self.addCleanup(self.second.kill)
        self.start("worker", BINARY, "--role=worker", f"--store={cluster().address(DATABASE)}",
                   f"--data-dir={self.folder}/worker", "--workers=1")
        self.port = free_port()
        self.configure()
        self.start("nginx", self.nginx, "-p", self.folder, "-c", self.folder / "nginx.conf", "-e",
                   "stderr")
        self.server.stub = self.connect()
        self.info(wait_for_ready=True)

    def start(self, name, *command):
        with (self.folder / f"{name}.log").open("w") as log:
            self.addCleanup(kill, subprocess.Popen(list(map(str, command)), stdout=log, stderr=log))

    def configure(self):
        """The shipped configuration; only places differ."""
        text = SHIPPED.read_text()
        for place, here in (("front-1.example.org:7070", f"127.0.0.1:{self.server.port}"),
                            ("front-2.example.org:7070", f"127.0.0.1:{self.second.port}"),
                            ("listen 443 ", f"listen 127.0.0.1:{self.port} "),
                            ("contactd.example.org", "localhost"),
                            ("/etc/nginx/contactd/fronts.pem", self.ca.pem),
                            ("/etc/nginx/contactd", self.folder)):
            self.assertIn(place, text)
            text = text.replace(place, str(here))
        (self.folder / "contactd.conf").write_text(text)
        (self.folder / "nginx.conf").write_text(
            f"daemon off; master_process off; pid {self.folder}/pid; error_log stderr;\n"
            "events { worker_connections 1024; }\nhttp { access_log off;\n" + "".join(
                f"{kind}_temp_path {self.folder}/{kind};\n"
                for kind in ("client_body", "proxy", "fastcgi", "uwsgi", "scgi"))
            + "include contactd.conf;\n}\n")

    def connect(self):
        credentials = grpc.composite_channel_credentials(
            grpc.ssl_channel_credentials(self.ca.pem.read_bytes()),
            grpc.access_token_call_credentials(self.token))
        channel = grpc.secure_channel(f"localhost:{self.port}", credentials)
        self.addCleanup(channel.close)
        return job_service_pb2_grpc.JobServiceStub(channel)

    def info(self, **options):
        return self.server.stub.GetServerInfo(job_service_pb2.GetServerInfoRequest(),
                                              timeout=PATIENCE_S, **options)

    def test_each_front_answers_for_every_job(self):
        job = self.server.run(three_ball_chain())
        self.assertEqual(job.state, Job.SUCCEEDED)
        answers = [self.server.get(job.name) for _ in range(4)]
        self.assertEqual(answers, 4 * [job])
        self.assertEqual(len({self.info().instance_id for _ in range(4)}), 2)

    def test_front_that_dies_costs_no_call(self):
        self.second.kill()
        for _ in range(20):
            self.assertEqual(self.info().principal.name, "ada")
        job = self.server.run(three_ball_chain())
        self.assertEqual(job.state, Job.SUCCEEDED)
        self.assertWholeLog(self.server.events(job.name))

    def test_no_front_at_all_is_unavailable(self):
        for front in (self.server, self.second):
            front.kill()
        with self.assertRaises(grpc.RpcError) as refused:
            self.info()
        self.assertEqual(refused.exception.code(), grpc.StatusCode.UNAVAILABLE)


if __name__ == "__main__":
    unittest.main()
