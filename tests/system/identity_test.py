"""Who may call what: every RPC with every kind of token and of certificate, as one table; rotation;
sockets with an identity; what the audit log and the log say of it."""

import contextlib
import datetime
import hashlib
import json
import pathlib
import shutil
import socket
import ssl
import subprocess
import tempfile
import time
import unittest
import urllib.request

import grpc
from authority import Authority
from contact.v1 import admin_service_pb2, job_service_pb2, job_service_pb2_grpc
from contactd import BINARY, PATIENCE_S, Server, three_ball_chain
from google.protobuf import message_factory
from provider import Provider

Code = grpc.StatusCode
METHODS = [method
           for service in (*job_service_pb2.DESCRIPTOR.services_by_name.values(),
                           *admin_service_pb2.DESCRIPTOR.services_by_name.values())
           for method in service.methods]


def token_line(token, principal, expires):
    """The line of a token in the file, and the token."""
    digest = hashlib.sha256(token.encode()).hexdigest()
    return f"{token[4:12]} {digest} {expires:%Y-%m-%dT%H:%M:%SZ} valid {principal}\n"


def call(channel, method, job, token=None):
    """Makes the call about the job, reads one message of a stream, and returns the code."""
    request_type = message_factory.MessageFactory().GetPrototype(method.input_type)
    answer_type = message_factory.MessageFactory().GetPrototype(method.output_type)
    request = request_type()
    fields = request_type.DESCRIPTOR.fields_by_name
    if "name" in fields:
        request.name = job
    if "artifact" in fields:
        request.artifact = "cycles.csv"
    if method.name == "CreateJob":
        request.job.scenario.CopyFrom(three_ball_chain())
    if method.name == "UpdateJob":
        request.job.name = job
        request.job.note = "good"
    streams = method.name in ("WatchJob", "WatchJobs", "ReadArtifact", "Backup")
    kind = channel.unary_stream if streams else channel.unary_unary
    make = kind(f"/{method.containing_service.full_name}/{method.name}",
                request_serializer=request_type.SerializeToString,
                response_deserializer=answer_type.FromString)
    metadata = [("authorization", f"Bearer {token}")] if token else []
    try:
        answer = make(request, timeout=PATIENCE_S, metadata=metadata)
        if streams:
            next(answer, None)
            answer.cancel()
        return Code.OK
    except grpc.RpcError as error:
        return error.code()


class IdentityTest(unittest.TestCase):
    """A server that asks who calls, with an authority and tokens of its own."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="contactd-test-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.ca = Authority(self.folder)
        self.server_files = self.ca.issue("server", "DNS:localhost,IP:127.0.0.1")
        self.ada = self.ca.issue("ada", "URI:spiffe://acme/user/ada")
        (self.folder / "rules").write_text(
            "cert spiffe://acme/user/*  user:$1 tenant:acme roles:submit\n")
        self.tokens = {}
        self.write_tokens()

    def write_tokens(self):
        now = datetime.datetime.now(datetime.timezone.utc)
        day = datetime.timedelta(days=1)
        text = ""
        for kind, principal, expires in (
                ("right", "user:boss tenant:acme roles:admin", now + day),
                ("read-only", "user:eye tenant:acme roles:read", now + day),
                ("other tenant", "user:eve tenant:umbra roles:operator", now + day),
                ("server", "user:backup roles:server", now + day),
                ("expired", "user:boss tenant:acme roles:admin", now - day)):
            secret = hashlib.sha256(f"{kind}{time.time_ns()}".encode()).hexdigest()[:43]
            self.tokens[kind] = f"ctk_{secret[:8]}_{secret}"
            text += token_line(self.tokens[kind], principal, expires)
        self.tokens["bad"] = "ctk_00000000_" + "x" * 43
        self.tokens["none"] = None
        tokens = self.folder / "tokens"
        tokens.touch(mode=0o600)
        tokens.write_text(text)

    def tls(self):
        return (f"--tls-cert={self.server_files[0]}", f"--tls-key={self.server_files[1]}")

    def start(self, *flags, **popen):
        server = Server(self.folder / "data", "--log-level=debug",
                        f"--audit-log={self.folder / 'audit.log'}", *flags)
        self.addCleanup(server.kill)
        return server.start(**popen)

    @contextlib.contextmanager
    def channel(self, server, pair=None, ca=None):
        read = pathlib.Path.read_bytes
        credentials = grpc.ssl_channel_credentials(
            read(ca or self.ca.pem), *((read(pair[1]), read(pair[0])) if pair else ()))
        # A channel of its own: others must not lend their connection.
        with grpc.secure_channel(f"localhost:{server.port}", credentials,
                                 options=[("grpc.use_local_subchannel_pool", 1)]) as channel:
            yield channel

    def ended_job(self, server):
        """A job of ada that has ended."""
        with self.channel(server, self.ada) as channel:
            stub = job_service_pb2_grpc.JobServiceStub(channel)
            request = job_service_pb2.CreateJobRequest()
            request.job.scenario.CopyFrom(three_ball_chain())
            name = stub.CreateJob(request, timeout=PATIENCE_S).name
            list(stub.WatchJob(job_service_pb2.WatchJobRequest(name=name), timeout=PATIENCE_S))
        return name

    def wait_for(self, condition):
        end = time.monotonic() + PATIENCE_S
        while not condition():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.05)

    def audit(self):
        return [json.loads(line) for line in (self.folder / "audit.log").read_text().splitlines()]


# What the table says for each method: the code for each kind of token, with a good certificate.
OK, NO, HIDDEN = Code.OK, Code.PERMISSION_DENIED, Code.NOT_FOUND
#                  own certificate, read-only token, token of another tenant, right token, server's
EXPECTED = {
    "CreateJob":     (OK, NO, OK, OK, NO),
    "GetJob":        (OK, OK, HIDDEN, OK, NO),
    "ListJobs":      (OK, OK, OK, OK, NO),
    "CancelJob":     (OK, NO, HIDDEN, OK, NO),
    "UpdateJob":     (OK, NO, HIDDEN, OK, NO),
    "DeleteJob":     (OK, NO, HIDDEN, OK, NO),
    "WatchJob":      (OK, OK, HIDDEN, OK, NO),
    "WatchJobs":     (OK, OK, OK, OK, NO),
    "ReadArtifact":  (OK, OK, HIDDEN, OK, NO),
    "GetSeries":     (OK, OK, HIDDEN, OK, NO),
    "GetServerInfo": (OK, OK, OK, OK, NO),
    "Backup":        (NO, NO, NO, NO, OK),
}
COLUMNS = {"none": 0, "read-only": 1, "other tenant": 2, "right": 3, "server": 4}


class TableTest(IdentityTest):

    def test_every_method_with_every_token_and_every_certificate(self):
        server = self.start(*self.tls(), f"--tls-client-ca={self.ca.pem}",
                            f"--identity-rules={self.folder / 'rules'}",
                            f"--tokens={self.folder / 'tokens'}")
        rogue = Authority(self.folder, "rogue").issue("mallory", "URI:spiffe://acme/user/ada")
        expired = self.ca.issue("old", "URI:spiffe://acme/user/ada", days=-1)
        certificates = {"none": None, "rogue": rogue, "expired": expired, "good": self.ada}
        self.assertEqual(set(EXPECTED), {method.name for method in METHODS})
        wrong = {}
        for certificate, pair in certificates.items():
            for kind, token in self.tokens.items():
                job = self.ended_job(server)
                with self.channel(server, pair) as channel:
                    for method in sorted(METHODS, key=lambda m: m.name == "DeleteJob"):
                        if certificate != "good":
                            expected = Code.UNAVAILABLE  # There is no connection.
                        elif kind in COLUMNS:
                            expected = EXPECTED[method.name][COLUMNS[kind]]
                        else:
                            expected = Code.UNAUTHENTICATED
                        got = call(channel, method, job, token)
                        if got != expected:
                            wrong[method.name, kind, certificate] = (got, expected)
        self.assertEqual(wrong, {})
        self.assert_no_secrets(server)
        self.assert_audited()

    def test_every_method_with_every_token_and_no_certificates_asked(self):
        server = self.start(*self.tls(), f"--tokens={self.folder / 'tokens'}")
        wrong = {}
        for kind, token in self.tokens.items():
            with self.channel(server) as channel:
                name = None
                with grpc.secure_channel(
                        f"localhost:{server.port}", grpc.composite_channel_credentials(
                            grpc.ssl_channel_credentials(self.ca.pem.read_bytes()),
                            grpc.access_token_call_credentials(self.tokens["right"]))) as right:
                    stub = job_service_pb2_grpc.JobServiceStub(right)
                    request = job_service_pb2.CreateJobRequest()
                    request.job.scenario.CopyFrom(three_ball_chain())
                    name = stub.CreateJob(request, timeout=PATIENCE_S).name
                    list(stub.WatchJob(job_service_pb2.WatchJobRequest(name=name),
                                       timeout=PATIENCE_S))
                for method in sorted(METHODS, key=lambda m: m.name == "DeleteJob"):
                    known = kind in COLUMNS and token
                    expected = (EXPECTED[method.name][COLUMNS[kind]] if known
                                else Code.UNAUTHENTICATED)
                    got = call(channel, method, name, token)
                    if got != expected:
                        wrong[method.name, kind] = (got, expected)
        self.assertEqual(wrong, {})

    def assert_no_secrets(self, server):
        said = server.log() + (self.folder / "audit.log").read_text()
        for token in filter(None, self.tokens.values()):
            self.assertNotIn(token[13:], said)
        self.assertNotIn("PRIVATE", said)

    def assert_audited(self):
        lines = self.audit()
        last = "0" * 64
        for line in (self.folder / "audit.log").read_text().splitlines():
            self.assertEqual(json.loads(line)["prev"], last)
            last = hashlib.sha256(line.encode()).hexdigest()
        refused = {line["method"] for line in lines if line["code"] == "UNAUTHENTICATED"}
        self.assertEqual(len(refused), len(METHODS), "each refusal has its line")
        changes = {line["method"].rsplit("/")[-1] for line in lines if line["code"] == "OK"}
        self.assertEqual(changes, {"CreateJob", "UpdateJob", "CancelJob", "DeleteJob"})
        self.assertIn("STARTED", {line["code"] for line in lines})
        right = [line for line in lines if line.get("principal") == "boss"]
        self.assertEqual({line["token"] for line in right}, {self.tokens["right"][4:12]})


class RotationTest(IdentityTest):

    def served(self):
        """The certificate that the server shows."""
        context = ssl.create_default_context(cafile=self.ca.pem)
        context.check_hostname = False
        context.verify_mode = ssl.CERT_NONE
        context.set_alpn_protocols(["h2"])
        with socket.create_connection(("127.0.0.1", self.server.port), PATIENCE_S) as raw:
            with context.wrap_socket(raw) as tls:
                return ssl.DER_cert_to_PEM_cert(tls.getpeercert(binary_form=True))

    def put(self, certificate, key, mode=0o600):
        """Replaces the files of the server."""
        for source, name in ((key, "live.key"), (certificate, "live.pem")):
            draft = self.folder / "draft"
            draft.write_bytes(source)
            draft.chmod(mode if name == "live.key" else 0o644)
            draft.rename(self.folder / name)

    def failures(self):
        with urllib.request.urlopen(f"http://127.0.0.1:{self.metrics}/metrics") as page:
            for line in page.read().decode().splitlines():
                if line.startswith("contactd_tls_reload_failed_total"):
                    return int(float(line.split()[-1]))
        return None

    def test_only_a_pair_that_can_be_used_replaces_the_old_one(self):
        read = pathlib.Path.read_bytes
        first = [read(path) for path in self.server_files]
        second = [read(path) for path in self.ca.issue("second", "DNS:localhost")]
        expired = [read(path) for path in self.ca.issue("past", "DNS:localhost", days=-1)]
        self.put(*first)
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            self.metrics = probe.getsockname()[1]
        self.server = self.start(f"--tls-cert={self.folder / 'live.pem'}",
                                 f"--tls-key={self.folder / 'live.key'}",
                                 f"--tokens={self.folder / 'tokens'}",
                                 f"--metrics-listen=127.0.0.1:{self.metrics}")
        self.assertEqual(self.served().split(), first[0].decode().split())
        # Each word is that of its mistake in the log.
        for case, pair, mode, words in (("mismatch", (first[0], second[1]), 0o600, "is not the key"),
                                        ("empty", (first[0], b""), 0o600, "holds no private key"),
                                        ("expired", expired, 0o600, "is valid from"),
                                        ("readable", second, 0o644, "chmod 600")):
            with self.subTest(case):
                before = self.failures()
                self.put(*pair, mode)
                self.wait_for(lambda: self.failures() > before)
                time.sleep(1.2)  # gRPC looks each second.
                self.assertEqual(self.served().split(), first[0].decode().split())
                self.assertIsNone(self.server.process.poll())
                told = [line for line in self.server.log().splitlines() if words in line]
                self.assertGreaterEqual(len(told), 1)
                self.assertLessEqual(len(told), 2, "a change of two files is two looks at most")
        self.put(*second)
        self.wait_for(lambda: self.served().split() == second[0].decode().split())
        token = self.tokens["right"]
        with self.channel(self.server) as channel:
            info = next(method for method in METHODS if method.name == "GetServerInfo")
            self.assertEqual(call(channel, info, "", token), OK)

    def test_tokens_are_read_again(self):
        self.server = self.start(*self.tls(), f"--tokens={self.folder / 'tokens'}")
        info = next(method for method in METHODS if method.name == "GetServerInfo")
        old = self.tokens["right"]
        with self.channel(self.server) as channel:
            self.assertEqual(call(channel, info, "", old), OK)
            (self.folder / "tokens").write_text("nonsense\n")
            self.wait_for(lambda: "what was read before stays in use" in self.server.log())
            self.assertEqual(call(channel, info, "", old), OK)
            self.write_tokens()
            self.wait_for(lambda: call(channel, info, "", self.tokens["right"]) == OK)
            self.assertEqual(call(channel, info, "", old), Code.UNAUTHENTICATED)


class RevokedTest(IdentityTest):

    def test_a_revoked_certificate_does_not_come_in_once_the_list_says_so(self):
        bob = self.ca.issue("bob", "URI:spiffe://acme/user/bob")
        crl = self.ca.revoke()
        server = self.start(*self.tls(), f"--tls-client-ca={self.ca.pem}", f"--tls-crl={crl}",
                            f"--identity-rules={self.folder / 'rules'}")
        info = next(method for method in METHODS if method.name == "GetServerInfo")

        def code(pair):
            with self.channel(server, pair) as channel:
                return call(channel, info, "", None)

        self.assertEqual([code(self.ada), code(bob)], [OK, OK])
        self.ca.revoke("bob")
        self.wait_for(lambda: code(bob) == Code.UNAVAILABLE)
        self.assertEqual(code(self.ada), OK)
        crl.write_text("nonsense\n")
        self.wait_for(lambda: "what was read before stays in use" in server.log())
        self.assertEqual([code(self.ada), code(bob)], [OK, Code.UNAVAILABLE])


class StreamTest(IdentityTest):

    def test_a_stream_ends_soon_after_its_right(self):
        rules = self.folder / "rules"
        server = self.start(*self.tls(), f"--tls-client-ca={self.ca.pem}",
                            f"--identity-rules={rules}", f"--tokens={self.folder / 'tokens'}")
        metadata = [("authorization", f"Bearer {self.tokens['right']}")]
        with self.channel(server, self.ada) as channel:
            stub = job_service_pb2_grpc.JobServiceStub(channel)
            request = job_service_pb2.WatchJobsRequest()
            by_token = stub.WatchJobs(request, timeout=PATIENCE_S, metadata=metadata)
            by_certificate = stub.WatchJobs(request, timeout=PATIENCE_S)
            for stream in (by_token, by_certificate):
                next(iter(stream))
            rules.write_text("cert spiffe://acme/user/ada nobody\n" + rules.read_text())
            start = time.monotonic()
            for stream in (by_certificate, by_token):
                if stream is by_token:
                    self.write_tokens()  # All are others now.
                with self.assertRaises(grpc.RpcError) as ended:
                    list(stream)
                self.assertEqual(ended.exception.code(), Code.UNAUTHENTICATED)
            print(f"the streams ended after {time.monotonic() - start:.1f} s")
            self.assertLess(time.monotonic() - start, 30)


class SocketTest(IdentityTest):

    def test_every_socket_has_its_own_principal(self):
        sockets = {name: self.folder / f"{name}.sock" for name in ("ci", "eye", "admin", "main")}
        self.start(
            f"--listen=unix:{sockets['main']}", f"--tokens={self.folder / 'tokens'}",
            f"--listen-as=unix:{sockets['ci']} user:ci tenant:acme roles:submit",
            f"--listen-as=unix:{sockets['eye']} user:eye tenant:umbra roles:read",
            f"--listen-admin=unix:{sockets['admin']}")
        principals, backups = {}, {}
        methods = {method.name: method for method in METHODS}
        for name, path in sockets.items():
            with grpc.insecure_channel(f"unix:{path}") as channel:
                stub = job_service_pb2_grpc.JobServiceStub(channel)
                metadata = [("authorization", f"Bearer {self.tokens['right']}")]
                info = stub.GetServerInfo(job_service_pb2.GetServerInfoRequest(),
                                          timeout=PATIENCE_S, metadata=metadata)
                principals[name] = (info.principal.name, info.principal.tenant, info.principal.how)
                backups[name] = call(channel, methods["Backup"], "", self.tokens["right"])
                if name == "main":
                    self.assertEqual(call(channel, methods["GetJob"], "jobs/x"),
                                     Code.UNAUTHENTICATED)
        self.assertEqual(principals, {"ci": ("ci", "acme", "socket"),
                                      "eye": ("eye", "umbra", "socket"),
                                      "admin": ("admin", "local", "socket"),
                                      "main": ("boss", "acme", "token")})
        self.assertEqual(backups, {"ci": Code.UNIMPLEMENTED, "eye": Code.UNIMPLEMENTED,
                                   "admin": OK, "main": Code.UNIMPLEMENTED})


class SettingsTest(IdentityTest):

    def test_settings_that_would_leave_a_gap_are_refused(self):
        pair = self.tls()
        cases = {
            ("--listen=0.0.0.0:0",): "needs --tls-cert",
            ("--listen=0.0.0.0:0", *pair): "needs --tls-cert, and --tokens",
            (f"--tokens={self.folder / 'tokens'}",): "unencrypted",
            (pair[0],): "--tls-key",
            (f"--tls-client-ca={self.ca.pem}",): "needs --tls-cert",
            (*pair, f"--tls-client-ca={self.ca.pem}"): "needs --identity-rules",
            (*pair, f"--tls-crl={self.ca.pem}"): "needs --tls-client-ca",
            (*pair, f"--tls-client-ca={self.ca.pem}", f"--identity-rules={self.folder / 'rules'}",
             f"--tls-crl={self.ca.revoke(days=-1)}"): "was to be replaced by",
            (*pair, f"--tls-client-ca={self.ca.pem}", f"--identity-rules={self.folder / 'rules'}",
             f"--tls-crl={self.ca.pem}"): "holds no list",
            ("--listen-admin=127.0.0.1:0",): "must be unix:PATH",
            ("--trusted-proxy=127.0.0.1:0",): "must be unix:PATH",
            ("--listen-as=unix:/x user:a",): "tenant",
            (*pair, "--tokens=/dev/null/x"): "cannot read",
            (pair[0], "--tls-key=/dev/null"): "is no file",
        }
        for flags, words in cases.items():
            with self.subTest(flags):
                run = subprocess.run([BINARY, f"--data-dir={self.folder / 'data'}",
                                      "--listen=127.0.0.1:0", *flags], capture_output=True,
                                     text=True, timeout=PATIENCE_S)
                self.assertEqual(run.returncode, 2, run.stderr)
                self.assertIn(words, run.stderr)

    def test_file_of_tokens_that_others_can_read_is_refused(self):
        (self.folder / "tokens").chmod(0o644)
        run = subprocess.run([BINARY, f"--data-dir={self.folder / 'data'}", *self.tls(),
                              "--listen=127.0.0.1:0", f"--tokens={self.folder / 'tokens'}"],
                             capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual(run.returncode, 2)
        self.assertIn("chmod 600", run.stderr)

    def test_files_that_others_can_change_are_refused(self):
        (self.folder / "keys").write_text(json.dumps({"keys": [Provider(self.folder, "a").jwk()]}))
        files = dict(zip(("tls-cert", "tls-key"), self.server_files), **{
            "tls-client-ca": self.ca.pem,
            **{flag: self.folder / file for flag, file in (
                ("identity-rules", "rules"), ("tokens", "tokens"), ("jwt-keys", "keys"))}})
        flags = [f"--{flag}={file}" for flag, file in files.items()]
        flags += ["--jwt-issuer=https://id.acme", "--jwt-audience=contactd"]
        for flag, file in files.items():
            with self.subTest(flag):
                mode = pathlib.Path(file).stat().st_mode
                pathlib.Path(file).chmod(mode | 0o002)
                run = subprocess.run([BINARY, f"--data-dir={self.folder / 'data'}",
                                      "--listen=127.0.0.1:0", *flags], capture_output=True,
                                     text=True, timeout=PATIENCE_S)
                self.assertEqual(run.returncode, 2)
                self.assertRegex(run.stderr, f"{file} can be .*changed by others; chmod")
                pathlib.Path(file).chmod(mode)
        self.start(*flags)


if __name__ == "__main__":
    unittest.main()
