"""The rules of HTTP/1.1, Connect and gRPC-Web, one test each, by curl's and our own bytes."""

import base64
import json
import pathlib
import re
import shutil
import socket
import struct
import subprocess
import tempfile
import time
import unittest

from contact.v1 import job_service_pb2
from contactd import PATIENCE_S, endless
from gateway import SERVICE, GatewayTest, b64, frame, frames, read_all, read_answer

GO_ON = b"HTTP/1.1 100 Continue\r\n\r\n"


class HttpTest(GatewayTest):

    ALLOWED = {"/": "GET, HEAD, OPTIONS", SERVICE + "GetJob": "GET, POST, OPTIONS",
               SERVICE + "CreateJob": "POST, OPTIONS", SERVICE + "WatchJob": "POST, OPTIONS"}

    def test_a_connection_serves_one_request_after_the_other(self):
        raw = self.connect()
        for _ in range(3):
            raw.sendall(self.request("POST"))
            status, body = read_answer(raw)
            self.assertEqual(status, 200)
            self.assertIn("version", json.loads(body))

    def test_requests_sent_at_once_are_answered_in_their_order(self):
        raw = self.connect()
        raw.sendall(self.request("POST") + self.request("GET", b"", target="/healthz") +
                    self.request("POST", b"{", "connection: close"))
        self.assertIn(b"version", read_answer(raw)[1])
        self.assertEqual(read_answer(raw), (200, b"ok\n"))
        self.assertEqual(read_answer(raw)[0], 400)
        self.assertEqual(raw.recv(1), b"")

    def test_a_chunked_body_is_a_body(self):
        raw = self.connect()
        raw.sendall(self.request("POST", b"1\r\n{\r\n1;x=y\r\n}\r\n0\r\n\r\n",
                                 "transfer-encoding: chunked"))
        self.assertEqual(read_answer(raw)[0], 200)

    def test_a_client_that_waits_for_leave_to_send_gets_it(self):
        raw = self.connect()
        whole = self.request("POST", b"{}", "expect: 100-continue")
        raw.sendall(whole[:-2])
        self.assertEqual(raw.recv(len(GO_ON), socket.MSG_WAITALL), GO_ON)
        raw.sendall(b"{}")
        self.assertEqual(read_answer(raw)[0], 200)

    def test_http_1_0_gets_an_answer_that_ends_with_the_connection(self):
        raw = self.connect()
        body = frame(json.dumps({"name": self.one_job()}).encode())
        raw.sendall(f"POST {SERVICE}WatchJob HTTP/1.0\r\nhost: localhost\r\ncontent-type: "
                    f"application/connect+json\r\ncontent-length: {len(body)}\r\n\r\n".encode() +
                    body)
        head, _, rest = read_all(raw).partition(b"\r\n\r\n")
        self.assertNotIn(b"chunked", head)
        self.assertEqual(frames(rest)[-1], (2, b"{}"))

    def test_a_stream_ends_for_a_client_that_closes_its_half(self):
        raw = self.connect()
        body = frame(b"{}")
        raw.sendall(f"POST {SERVICE}WatchJobs HTTP/1.1\r\nhost: localhost\r\ncontent-type: "
                    f"application/connect+json\r\ncontent-length: {len(body)}\r\n\r\n".encode() +
                    body)
        raw.recv(1)
        raw.shutdown(socket.SHUT_WR)
        self.assertIn(b'"canceled"', read_all(raw))

    def test_a_unary_call_is_answered_to_a_client_that_closes_its_half(self):
        raw = self.connect()
        raw.sendall(self.request("POST"))
        raw.shutdown(socket.SHUT_WR)
        self.assertEqual(read_answer(raw)[0], 200)
        self.assertEqual(raw.recv(1), b"")

    def test_the_stream_of_a_client_that_leaves_is_cancelled(self):
        name = self.server.create(endless()).name
        raw = self.connect()
        body = frame(json.dumps({"name": name}).encode())
        raw.sendall(f"POST {SERVICE}WatchJob HTTP/1.1\r\nhost: localhost\r\ncontent-type: "
                    f"application/connect+json\r\ncontent-length: {len(body)}\r\n\r\n".encode() +
                    body)
        raw.recv(1)
        self.assertIn("\ncontactd_watchers 1\n", self.metrics())
        raw.close()
        self.wait_for("\ncontactd_watchers 0\n")

    def metrics(self):
        return self.ask("GET", "/metrics").body.decode()

    def wait_for(self, line):
        end = time.monotonic() + PATIENCE_S
        while line not in self.metrics():
            self.assertLess(time.monotonic(), end, line)
            time.sleep(0.02)

    def test_what_is_no_http_is_refused_and_ended(self):
        for bad in (b"\x16\x03\x01\x02\x00\x01\r\n\r\n", b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n",
                    b"PRI * HTTP/3.0\r\n\r\nSM\r\n\r\n", b"GET / HTTP/1.1\r\nno colon\r\n\r\n",
                    self.request("POST", b"zz\r\n", "transfer-encoding: chunked"),
                    self.request("POST", b"{}", "content-length: -1"),
                    self.request("POST", b"{}", "content-length: 1", "content-length: 2")):
            raw = self.connect()
            raw.sendall(bad)
            raw.shutdown(socket.SHUT_WR)
            answer = read_all(raw)
            self.assertTrue(answer == b"" or answer.startswith(b"HTTP/1.1 400 "), (bad, answer))
        self.assertEqual(self.ask("GET", "/healthz").status, 200)

    def test_two_hosts_are_refused(self):
        raw = self.connect()
        raw.sendall(self.request("POST", b"{}", "host: localhost"))
        self.assertEqual(read_answer(raw)[0], 400)

    def is_refused_with_what_follows(self, *headers):
        raw = self.connect()
        raw.sendall(self.request("POST", b"0\r\n\r\n", *headers) +
                    self.request("GET", b"", target="/healthz"))
        raw.shutdown(socket.SHUT_WR)
        answer = read_all(raw)
        self.assertTrue(answer.startswith(b"HTTP/1.1 400 "), answer)
        self.assertIn(b"\r\nconnection: close\r\n", answer)
        self.assertEqual(answer.count(b"\r\n\r\n"), 1, answer)

    def test_length_and_chunks_together_are_refused(self):
        chunked, length = "transfer-encoding: chunked", "content-length: 5"
        self.is_refused_with_what_follows(chunked, length)
        self.is_refused_with_what_follows(length, chunked)

    def test_a_body_whose_end_nobody_knows_is_refused(self):
        for coding in ("gzip", "identity", "chunked, identity"):
            self.is_refused_with_what_follows("transfer-encoding: " + coding)
            self.is_refused_with_what_follows("content-length: 5", "transfer-encoding: " + coding)

    def test_a_head_past_16_kib_is_refused(self):
        raw = self.connect()
        raw.sendall(self.request("POST", b"{}", "x-long: " + "x" * (20 << 10)))
        self.assertEqual(read_answer(raw)[0], 431)

    def test_a_body_past_the_limit_is_refused_before_it_is_sent(self):
        raw = self.connect()
        raw.sendall(self.request("POST", b"", "content-length: 3000000"))
        status, body = read_answer(raw)
        self.assertEqual((status, json.loads(body)["code"]), (429, "resource_exhausted"))

    def test_a_body_past_the_limit_is_refused_while_it_is_sent(self):
        raw = self.connect()
        raw.sendall(self.request("POST", b"", "transfer-encoding: chunked"))
        chunk = b"10000\r\n" + b" " * (1 << 16) + b"\r\n"
        for _ in range(33):
            raw.sendall(chunk)
        self.assertEqual(read_answer(raw)[0], 429)

    def test_a_head_is_answered_as_a_get_without_body(self):
        raw = self.connect()
        raw.sendall(self.request("HEAD", b"", "connection: close", target="/healthz"))
        answer = read_all(raw)
        self.assertIn(b"content-length: 3\r\n", answer)
        self.assertTrue(answer.endswith(b"\r\n\r\n"))

    def test_options_say_what_is_allowed(self):
        for target, allowed in self.ALLOWED.items():
            answer = self.ask("OPTIONS", target)
            self.assertEqual((answer.status, answer.headers["allow"]), (204, allowed), target)

    def test_what_is_not_allowed_is_405_and_nothing_else_is(self):
        for target, allowed in self.ALLOWED.items():
            for method in ("GET", "HEAD", "POST", "OPTIONS", "PUT", "DELETE"):
                if (method, target) == ("POST", "/"):
                    continue  # 404, for it may be a call that is not known.
                answer = self.ask(method, target)
                self.assertEqual(answer.status == 405, method not in allowed, (method, target))
                if answer.status == 405:
                    self.assertEqual(answer.headers["allow"], allowed)

    def test_a_host_that_is_not_ours_is_not_answered(self):
        for target in ("/", "/metrics", SERVICE + "GetServerInfo"):
            answer = self.ask("GET", target, headers={"host": "evil.example"})
            self.assertEqual(answer.status, 421)

    def test_a_page_of_elsewhere_is_not_answered(self):
        answer = self.call("GetServerInfo", {}, origin="http://evil.example")
        self.assertEqual(answer.status, 403)
        self.assertNotIn("access-control-allow-origin", answer.headers)

    def test_every_answer_says_what_a_browser_may_do_with_it(self):
        for answer in (self.ask("GET", "/healthz"), self.call("GetServerInfo", {}),
                       self.ask("GET", "/"), self.call("GetJob", {"name": "x"})):
            self.assertNotIn("unsafe", answer.headers["content-security-policy"])
            self.assertEqual(answer.headers["x-content-type-options"], "nosniff")
            self.assertEqual(answer.headers["referrer-policy"], "no-referrer")
        self.assertEqual(self.call("GetServerInfo", {}).headers["cache-control"], "no-store")

    def test_health_and_readiness(self):
        self.assertEqual(self.ask("GET", "/healthz").body, b"ok\n")
        self.assertEqual(self.ask("GET", "/readyz").body, b"ready\n")


class DocumentationTest(GatewayTest):

    @property
    def http_flags(self):
        return (f"--docs-dir={self.docs}",)

    def setUp(self):
        self.docs = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.docs / "gallery").mkdir()
        (self.docs / "index.html").write_text("front")
        (self.docs / "gallery/index.html").write_text("gallery")
        super().setUp()

    def test_the_site_is_at_docs_beside_the_dashboard(self):
        self.assertEqual(self.ask("GET", "/docs").headers["location"], "/docs/")
        for target, body in {"/docs/": b"front", "/docs/index.html?q=1": b"front",
                             "/docs/gallery/": b"gallery"}.items():
            answer = self.ask("GET", target)
            self.assertEqual((answer.status, answer.body), (200, body), target)
            self.assertEqual(answer.headers["content-type"], "text/html; charset=utf-8")
            self.assertNotIn("unsafe", answer.headers["content-security-policy"])
        tag = answer.headers["etag"]
        self.assertEqual(self.ask("GET", target, headers={"if-none-match": tag}).status, 304)
        for target in ("/docs/gallery", "/docs/../index.html", "/docs/%2e%2e/data/contactd.db"):
            self.assertEqual(self.ask("GET", target).status, 404, target)

    def test_without_a_site_a_person_is_told_why(self):
        (self.docs / "index.html").unlink()
        answer = self.ask("GET", "/docs/")
        self.assertEqual(answer.status, 404)
        self.assertIn(b"--docs-dir", answer.body)


class ConnectTest(GatewayTest):

    def test_post_in_json_and_bytes(self):
        name = self.one_job()
        self.assertEqual(self.call("GetJob", {"name": name}).json()["state"], "SUCCEEDED")
        request = job_service_pb2.GetJobRequest(name=name).SerializeToString()
        answer = self.ask("POST", SERVICE + "GetJob", request,
                          {"content-type": "application/proto"})
        self.assertEqual(answer.headers["content-type"], "application/proto")
        self.assertEqual(type(self.server.get(name)).FromString(answer.body).name, name)

    def test_get_of_a_call_without_side_effects(self):
        name = self.one_job()
        request = job_service_pb2.GetJobRequest(name=name).SerializeToString()
        for query in (f'encoding=json&message=%7B%22name%22%3A%22{name.replace("/", "%2F")}%22%7D',
                      f"encoding=json&base64=1&message={b64(json.dumps({'name': name}).encode())}",
                      f"encoding=proto&base64=1&connect=v1&message="
                      f"{base64.urlsafe_b64encode(request).decode().rstrip('=')}"):
            answer = self.ask("GET", f"{SERVICE}GetJob?{query}")
            self.assertEqual(answer.status, 200, answer.body)
            self.assertIn(name.encode(), answer.body)

    def test_a_stream_is_frames_that_end_with_an_end(self):
        answer, parts = self.stream("WatchJob", {"name": self.one_job()})
        self.assertEqual(answer.headers["content-type"], "application/connect+json")
        self.assertEqual({flags for flags, _ in parts[:-1]}, {0})
        self.assertEqual(parts[-1], (2, b"{}"))

    def test_a_stream_that_fails_is_200_and_says_why_in_its_end(self):
        answer, parts = self.stream("WatchJob", {"name": "jobs/none"})
        self.assertEqual((answer.status, len(parts), parts[0][0]), (200, 1, 2))
        self.assertEqual(json.loads(parts[0][1])["error"]["code"], "not_found")

    def test_errors_have_the_status_of_their_code_and_their_details(self):
        answer = self.call("GetJob", {"name": "jobs/none"})
        self.assertEqual((answer.status, answer.code()), (404, "not_found"))
        details = {detail["type"]: detail for detail in answer.json()["details"]}
        self.assertEqual(details["google.rpc.ErrorInfo"]["debug"]["reason"], "JOB_NOT_FOUND")
        self.assertEqual(self.call("ListJobs", {"pageSize": -1}).status, 400)
        running = self.server.create(endless()).name
        answer = self.call("DeleteJob", {"name": running})
        self.assertEqual((answer.status, answer.code()), (400, "failed_precondition"))

    def test_a_deadline_ends_the_call(self):
        body = frame(b"{}")
        for text, code in (("100", "deadline_exceeded"), ("x", "invalid_argument")):
            answer = self.ask("POST", SERVICE + "WatchJobs", body,
                              {"content-type": "application/connect+json",
                               "connect-timeout-ms": text})
            self.assertEqual(json.loads(frames(answer.body)[-1][1])["error"]["code"], code)

    def test_compressed_messages_are_refused_and_what_is_taken_is_said(self):
        answer = self.call("GetServerInfo", {}, content_encoding="gzip")
        self.assertEqual((answer.status, answer.code()), (501, "unimplemented"))
        self.assertEqual(answer.headers["accept-encoding"], "identity")
        answer = self.ask("POST", SERVICE + "WatchJobs", frame(b"{}", 1),
                          {"content-type": "application/connect+json"})
        self.assertEqual(json.loads(frames(answer.body)[0][1])["error"]["code"], "unimplemented")

    def test_a_type_that_the_method_has_not_is_415(self):
        self.assertEqual(self.ask("POST", SERVICE + "GetJob", "{}").status, 415)
        self.assertEqual(self.call("WatchJobs", {}).status, 415)

    def test_an_unknown_method_is_no_page(self):
        answer = self.ask("POST", SERVICE + "Nothing", "{}", {"content-type": "application/json"})
        self.assertEqual(answer.status, 404)

    def test_metadata_that_is_no_metadata_is_refused(self):
        self.assertEqual(self.call("GetServerInfo", {}, x_note_bin="!").code(), "invalid_argument")
        self.assertEqual(self.call("GetServerInfo", {}, x_note_bin="AP8").status, 200)

    def test_metadata_past_the_limit_is_the_servers_error(self):
        answer = self.call("GetServerInfo", {}, x_note="x" * 9000)
        self.assertEqual(answer.code(), "resource_exhausted")

    def test_series_may_be_plain_numbers(self):
        name = self.one_job()
        ask = {"name": name, "channels": ["B1.velocity"], "maxPoints": 10}
        packed = self.call("GetSeries", ask).json()
        plain = self.call("GetSeries", ask | {"plainNumbers": True}).json()
        for left, right in zip(packed["columns"], plain["columns"]):
            self.assertNotIn("values", right)
            numbers = right["numbers"]
            self.assertEqual(base64.b64decode(left["values"]),
                             struct.pack(f"<{len(numbers)}d", *numbers))

    def test_the_server_tells_where_its_gateway_is(self):
        self.assertEqual(self.call("GetServerInfo", {}).json()["httpAddress"],
                         f"http://127.0.0.1:{self.http}")


class WebTest(GatewayTest):

    def web(self, method, message, kind="application/grpc-web+proto", **headers):
        """The frames of an answer."""
        body = frame(message.SerializeToString())
        text = "text" in kind
        names = {"content-type": kind} | {key.replace("_", "-"): headers[key] for key in headers}
        answer = self.ask("POST", SERVICE + method, b64(body) if text else body, names)
        self.assertEqual((answer.status, answer.headers["content-type"]), (200, kind))
        if not text:
            return frames(answer.body)
        parts, rest = [], answer.body
        while rest:
            end = len(rest) if b"=" not in rest else rest.index(b"=")
            while end < len(rest) and rest[end:end + 1] == b"=":
                end += 1
            parts.append(base64.b64decode(rest[:end]))
            rest = rest[end:]
        return frames(b"".join(parts))

    def test_a_unary_call_is_a_message_and_trailers_in_bytes_and_text(self):
        request = job_service_pb2.GetJobRequest(name=self.one_job())
        for kind in ("application/grpc-web", "application/grpc-web+proto",
                     "application/grpc-web-text", "application/grpc-web-text+proto"):
            (first, _), (last, trailers) = self.web("GetJob", request, kind)
            self.assertEqual((first, last, trailers), (0, 0x80, b"grpc-status: 0\r\n"))

    def test_a_stream_ends_with_trailers(self):
        request = job_service_pb2.WatchJobRequest(name=self.one_job())
        for kind in ("application/grpc-web+proto", "application/grpc-web-text"):
            parts = self.web("WatchJob", request, kind)
            self.assertEqual(parts[-1], (0x80, b"grpc-status: 0\r\n"))
            self.assertGreater(len(parts), 1)

    def test_an_error_is_trailers_with_details(self):
        parts = self.web("GetJob", job_service_pb2.GetJobRequest(name="jobs/none"))
        self.assertEqual(len(parts), 1)
        self.assertIn(b"grpc-status: 5\r\ngrpc-message: there is no job jobs/none\r\n", parts[0][1])
        self.assertIn(b"grpc-status-details-bin: ", parts[0][1])

    def test_a_deadline_ends_the_call(self):
        parts = self.web("WatchJobs", job_service_pb2.WatchJobsRequest(), grpc_timeout="100m")
        self.assertIn(b"grpc-status: 4\r\n", parts[-1][1])

    def test_bad_frames_are_errors_of_the_protocol(self):
        for body, status in ((b"", b"12"), (b"\0\0", b"3"), (frame(b"", 1), b"12"),
                             (frame(b"\xff"), None)):
            answer = self.ask("POST", SERVICE + "GetJob", body,
                              {"content-type": "application/grpc-web"})
            trailers = frames(answer.body)[-1][1]
            self.assertNotIn(b"grpc-status: 0", trailers)
            if status:
                self.assertIn(b"grpc-status: " + status, trailers)


@unittest.skipUnless(shutil.which("curl"), "curl is not installed")
class CurlTest(GatewayTest):

    def test_curl_calls_and_is_told_what_is_wrong(self):
        run = subprocess.run(
            ["curl", "-sS", "-H", "content-type: application/json", "-d", '{"nam": "x"}',
             f"http://localhost:{self.http}{SERVICE}GetJob"],
            capture_output=True, text=True, timeout=PATIENCE_S, check=True)
        self.assertIn("nam: Cannot find field.", json.loads(run.stdout)["message"])


class RulesTest(unittest.TestCase):

    def test_each_rule_of_the_table_names_tests_that_there_are(self):
        here = pathlib.Path(__file__).parent
        named = re.findall(r"`(test_\w+|[A-Z][A-Za-z0-9]*[a-z][A-Z]\w+)`", (here / "README.md").read_text())
        named.remove("RulesTest")
        there = "".join(file.read_text() for file in here.glob("*_test.*"))
        self.assertGreater(len(named), 50)
        self.assertEqual([name for name in named if not re.search(rf"\b{name}\b[()]", there)], [])


if __name__ == "__main__":
    unittest.main()
