"""contactd with the arguments of the pods of deploy/kubernetes: it starts, finds its database by
the file of a secret, asks who calls, and answers the probes."""

import http.client
import os
import pathlib
import re
import signal
import subprocess
import time
import unittest

import grpc
import yaml
from authority import Authority
from contact.v1 import job_service_pb2, job_service_pb2_grpc
from contactd import (BINARY, PATIENCE_S, Job, Server, ServerTest, cluster,
                      three_ball_chain)
from kustomize import containers, objects

# Where pods find what secrets have, and what a test has in its folder.
PLACES = {"/etc/contactd/tls/tls.crt": "server.pem", "/etc/contactd/tls/tls.key": "server.key",
          "/etc/contactd/tokens/tokens": "tokens", "/var/lib/contactd": "state"}
DATABASE = "pods"
COMPOSE = pathlib.Path(__file__).resolve().parents[2] / "deploy/compose.yml"


def container(name, overlay="base"):
    return next(found for _, found in containers(overlay) if found["name"] == name)


def here(words, folder):
    """Arguments with the places of this test, and on loopback only."""
    words = [re.sub(r"=0\.0\.0\.0:\d+", "=127.0.0.1:0", word) for word in words]
    for place, file in PLACES.items():
        words = [word.replace(place, str(folder / file)) for word in words]
    return words


def arguments(name, folder, overlay="base"):
    return here(container(name, overlay)["args"], folder)


def environment(name, folder):
    """Of a container: the secret says where the database is."""
    service = folder / "pg_service.conf"
    service.write_text(f"[contactd]\nhost={cluster().folder}\nuser=contactd\ndbname={DATABASE}\n")
    told = {variable["name"]: variable["value"] for variable in container(name)["env"]}
    return {**os.environ, **told, "PGSERVICEFILE": str(service)}


def status(name, probe, port):
    """What a kubelet gets, which says the address of the pod as the host unless told otherwise."""
    wanted = container(name)[probe]["httpGet"]
    told = {header["name"]: header["value"] for header in wanted.get("httpHeaders", [])}
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE_S)
    try:
        connection.request("GET", wanted["path"], headers={"Host": "10.0.0.7:8080"} | told)
        return connection.getresponse().status
    finally:
        connection.close()


class PodTest(ServerTest):
    """`self.server` is a front, after the job that makes its tables."""

    def make_server(self):
        cluster().run(f"DROP DATABASE IF EXISTS {DATABASE} WITH (FORCE)")
        cluster().create(DATABASE)
        for role in ("contactd_front", "contactd_worker", "contactd_launcher"):
            cluster().run(f"DROP ROLE IF EXISTS {role}")
            cluster().run(f"CREATE ROLE {role}")
        environ = environment("front", self.folder)
        self.migrate("base")
        (self.folder / "state").mkdir()
        (self.folder / "state").chmod(0o2777)  # An emptyDir.
        Authority(self.folder).issue("server", "DNS:localhost")
        (self.folder / "tokens").touch(mode=0o440)
        return Server(self.folder / "data", *arguments("front", self.folder),
                      f"--http-port-file={self.folder / 'http'}", environment=environ, store="")

    def migrate(self, overlay):
        subprocess.run([BINARY, *arguments("migrate", self.folder, overlay)], check=True,
                       env=environment("migrate", self.folder), timeout=PATIENCE_S)

    def test_probes_of_a_front_are_answered(self):
        port = int((self.folder / "http").read_text())
        for probe in ("startupProbe", "livenessProbe", "readinessProbe"):
            self.assertEqual(status("front", probe, port), 200, probe)

    def test_caller_without_a_token_is_refused(self):
        authority = grpc.ssl_channel_credentials((self.folder / "ca.pem").read_bytes())
        with grpc.secure_channel(f"localhost:{self.server.port}", authority) as channel:
            stub = job_service_pb2_grpc.JobServiceStub(channel)
            self.assertFails(grpc.StatusCode.UNAUTHENTICATED, "UNAUTHENTICATED", stub.GetServerInfo,
                             job_service_pb2.GetServerInfoRequest(), timeout=PATIENCE_S)

    def test_query_of_keda_counts_jobs(self):
        [scaler] = objects("overlays/keda", "ScaledObject")
        [trigger] = scaler["spec"]["triggers"]
        self.migrate("overlays/keda")
        query = "SET ROLE contactd_launcher; " + trigger["metadata"]["query"]
        self.assertEqual(cluster().run(query, DATABASE), "0")

    def test_front_of_compose_runs_jobs_of_whoever_reaches_it(self):
        words = yaml.safe_load(COMPOSE.read_text())["services"]["front"]["command"]
        front = Server(self.folder / "compose", *here(words, self.folder),
                       environment=environment("front", self.folder), store="")
        self.addCleanup(front.kill)
        front.start()
        self.assertEqual(front.create(three_ball_chain()).state, Job.QUEUED)

    def metrics_port(self, log):
        """The port that the worker's log tells, once it does."""
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            if found := re.search(r"metrics on port (\d+)", log.read_text()):
                return int(found[1])
            time.sleep(0.05)
        self.fail(log.read_text())

    def test_worker_answers_its_probes_and_ends_in_time(self):
        log = self.folder / "worker.log"
        with log.open("w") as out:
            worker = subprocess.Popen([BINARY, *arguments("worker", self.folder)], stderr=out,
                                      stdout=out, env=environment("worker", self.folder))
        self.addCleanup(worker.wait)
        self.addCleanup(worker.kill)
        port = self.metrics_port(log)
        for probe in ("startupProbe", "livenessProbe"):
            self.assertEqual(status("worker", probe, port), 200, probe)
        worker.send_signal(signal.SIGTERM)
        self.assertEqual(worker.wait(PATIENCE_S), 0)


if __name__ == "__main__":
    unittest.main()
