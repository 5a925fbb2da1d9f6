"""contactctl login: a token from an identity provider, for a server that takes its tokens."""

import http.server
import json
import ssl
import stat
import threading
import unittest
import urllib.parse

from authority import Authority
from cli_case import CliTest
from contactd import Server
from provider import Provider


class LoginPage(http.server.BaseHTTPRequestHandler):
    """The web pages of an identity provider whose user confirms at the second question."""

    def do_GET(self):
        base = self.server.issuer
        self.answer(200, {"issuer": base, "device_authorization_endpoint": f"{base}/device",
                          "token_endpoint": f"{base}/token"})

    def do_POST(self):
        length = int(self.headers["Content-Length"])
        form = urllib.parse.parse_qs(self.rfile.read(length).decode())
        self.server.forms.append({name: values[0] for name, values in form.items()})
        if self.path == "/device":
            self.answer(200, {"device_code": "secret device", "user_code": "WDJB-MJHT",
                              "verification_uri": f"{self.server.issuer}/go", "expires_in": 60,
                              "interval": 1})
        elif len(self.server.forms) < 3:
            self.answer(400, {"error": "authorization_pending"})
        else:
            self.answer(200, {"access_token": self.server.token(), "expires_in": 60})

    def answer(self, status, body):
        self.send_response(status)
        self.end_headers()
        self.wfile.write(json.dumps({**body, "rest": self.server.rest}).encode())

    def log_message(self, *_):
        pass


class LoginTest(CliTest):

    def make_server(self):
        self.provider = Provider(self.folder, "first")
        (self.folder / "keys").write_text(json.dumps({"keys": [self.provider.jwk()]}))
        self.serve_pages()
        return Server(self.folder / "data", f"--listen=unix:{self.folder}/socket",
                      f"--jwt-keys={self.folder}/keys", f"--jwt-issuer={self.web.issuer}",
                      "--jwt-audience=contactd")

    def serve_pages(self):
        self.ca = Authority(self.folder)
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        context.load_cert_chain(*self.ca.issue("id", "DNS:localhost,IP:127.0.0.1"))
        self.web = http.server.ThreadingHTTPServer(("127.0.0.1", 0), LoginPage)
        self.web.socket = context.wrap_socket(self.web.socket, server_side=True)
        self.web.issuer = f"https://localhost:{self.web.server_address[1]}"
        self.web.token = lambda: self.provider.token(iss=self.web.issuer)
        self.web.forms = []
        self.web.rest = ""
        thread = threading.Thread(target=self.web.serve_forever)
        thread.start()
        self.addCleanup(thread.join)
        self.addCleanup(self.web.server_close)
        self.addCleanup(self.web.shutdown)

    def ask(self, *arguments, code=0):
        return self.run_it(*arguments, "--token-file", self.folder / "made" / "token", code=code,
                           server=f"unix:{self.folder}/socket")

    def log_in(self, authority, code=0):
        return self.ask("login", "--issuer", self.web.issuer, "--client-id", "contactctl",
                        "--audience", "contactd", "--issuer-ca", authority.pem, code=code)

    def test_token_of_a_login_opens_the_server(self):
        _, said = self.log_in(self.ca)
        self.assertIn(f"Open {self.web.issuer}/go\nand confirm the code WDJB-MJHT within 60 s", said)
        self.assertNotIn("secret device", said)
        token = self.folder / "made" / "token"
        self.assertEqual(stat.S_IMODE(token.stat().st_mode), 0o600)
        self.assertNotIn(token.read_text().strip(), said)
        self.assertIn("ada", self.ask("server", "status")[0])
        self.assertEqual(self.web.forms[0], {"client_id": "contactctl", "scope": "openid",
                                             "audience": "contactd"})

    def test_provider_with_a_wrong_certificate_is_not_asked(self):
        _, said = self.log_in(Authority(self.folder, "other"), code=4)
        self.assertIn(self.web.issuer, said)
        self.assertEqual(self.web.forms, [])

    def test_answer_without_end_is_given_up(self):
        self.web.rest = "x" * (8 << 20)
        _, said = self.log_in(self.ca, code=4)
        self.assertIn("answers with more than 1 MiB", said)

    def test_place_for_the_token_is_asked_for_first(self):
        said = self.run_it("login", "--issuer", self.web.issuer, "--client-id", "c", code=2)[1]
        self.assertIn("--token-file", said)
        self.assertEqual(self.web.forms, [])


if __name__ == "__main__":
    unittest.main()
