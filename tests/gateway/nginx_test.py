"""The gateway behind nginx with the configuration of deploy/nginx: TLS, tokens, streams as they
come."""

import datetime
import http.client
import json
import pathlib
import socket
import ssl
import subprocess
import sys
import time
import unittest

from contactd import PATIENCE_S, Server, ServerTest
from gateway import SERVICE, Answer, frame

sys.path.append(str(pathlib.Path(__file__).parents[1] / "system"))
from authority import Authority  # noqa: E402
from identity_test import token_line  # noqa: E402
from tools import tool  # noqa: E402

SHIPPED = pathlib.Path(__file__).resolve().parents[2] / "deploy/nginx/contactd-web.conf"


class NginxTest(ServerTest):

    def make_server(self):
        expires = datetime.datetime.now(datetime.timezone.utc) + datetime.timedelta(days=1)
        self.token = f"ctk_{'a' * 8}_{'a' * 43}"
        tokens = self.folder / "tokens"
        tokens.touch(mode=0o600)
        tokens.write_text(token_line(self.token, "user:ada tenant:acme roles:read", expires))
        return Server(self.folder / "data", f"--listen=unix:{self.folder}/grpc.sock",
                      f"--http-listen=unix:{self.folder}/http.sock", "--http-host=localhost",
                      f"--tokens={tokens}")

    def setUp(self):
        nginx = tool("nginx")
        super().setUp()
        self.ca = Authority(self.folder)
        self.ca.issue("server", "DNS:localhost")
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        text = SHIPPED.read_text()
        for place, here in (("unix:/run/contactd", f"unix:{self.folder}"),
                            ("listen 8443 ", f"listen 127.0.0.1:{self.port} "),
                            ("server_name contactd.example.org", "server_name localhost"),
                            ("/etc/nginx/contactd", str(self.folder))):
            self.assertIn(place, text)
            text = text.replace(place, here)
        (self.folder / "web.conf").write_text(text)
        (self.folder / "nginx.conf").write_text(
            f"daemon off; master_process off; pid {self.folder}/pid; error_log stderr;\n"
            "events { worker_connections 256; }\nhttp { access_log off;\n" + "".join(
                f"{kind}_temp_path {self.folder}/{kind};\n"
                for kind in ("client_body", "proxy", "fastcgi", "uwsgi", "scgi"))
            + "include web.conf;\n}\n")
        self.nginx = subprocess.Popen([nginx, "-p", self.folder, "-c", self.folder / "nginx.conf",
                                       "-e", "stderr"], stderr=subprocess.DEVNULL)
        self.addCleanup(self.nginx.wait)
        self.addCleanup(self.nginx.kill)
        end = time.monotonic() + PATIENCE_S
        while True:
            try:
                socket.create_connection(("127.0.0.1", self.port)).close()
                break
            except ConnectionRefusedError:
                self.assertLess(time.monotonic(), end)

    def ask(self, method, body, token=None, **headers):
        trust = ssl.create_default_context(cafile=self.ca.pem)
        connection = http.client.HTTPSConnection("localhost", self.port, context=trust,
                                                 timeout=PATIENCE_S)
        self.addCleanup(connection.close)
        names = {"content-type": "application/json"}
        names |= {name.replace("_", "-"): value for name, value in headers.items()}
        if token:
            names["authorization"] = f"Bearer {token}"
        connection.request("POST", SERVICE + method, body, names)
        return connection.getresponse()

    def test_a_caller_needs_a_token_and_a_page_of_its_own_origin(self):
        self.assertEqual(Answer(self.ask("GetServerInfo", "{}")).status, 401)
        origin = f"https://localhost:{self.port}"
        answer = Answer(self.ask("GetServerInfo", "{}", self.token, origin=origin))
        self.assertEqual(answer.json()["principal"]["name"], "ada")
        answer = Answer(self.ask("GetServerInfo", "{}", self.token, origin="https://evil.example"))
        self.assertEqual(answer.status, 403)

    def test_a_stream_comes_while_it_goes_on(self):
        response = self.ask("WatchJobs", frame(b"{}"), self.token,
                            content_type="application/connect+json")
        head = response.read(5)
        self.assertEqual(head[0], 0)
        message = json.loads(response.read(int.from_bytes(head[1:], "big")))
        self.assertTrue(message["snapshotComplete"])


if __name__ == "__main__":
    unittest.main()
