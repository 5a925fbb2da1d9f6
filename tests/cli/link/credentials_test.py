"""contactctl against a server that asks who calls: files, exit codes, profiles, tokens, audit."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import time
import unittest

from authority import Authority
from cli_case import CHAIN, CONTACTCTL
from contactd import PATIENCE_S, Server, wait_for


class CredentialsTest(unittest.TestCase):

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="contactd-test-"))
        self.addCleanup(shutil.rmtree, self.folder)
        ca = Authority(self.folder)
        pair = ca.issue("server", "DNS:localhost,IP:127.0.0.1")
        self.ca, self.tokens = ca.pem, self.folder / "tokens"
        self.ada = ca.issue("ada", "URI:spiffe://acme/user/ada")
        (self.folder / "rules").write_text("cert spiffe://acme/user/* user:$1 tenant:acme "
                                           "roles:submit\n")
        self.token = self.make_token("ci", "submit")
        self.server = Server(self.folder / "data", f"--tls-cert={pair[0]}", f"--tls-key={pair[1]}",
                             f"--tokens={self.tokens}", f"--audit-log={self.folder / 'audit.log'}")
        self.addCleanup(self.server.kill)
        self.server.start()

    def make_token(self, name, role):
        path = self.folder / f"{name}.token"
        shown = self.run_it("server", "token", "create", "--tokens", self.tokens, "--name", name,
                            "--role", role, "-f", path,
                            *(() if role == "server" else ("--tenant", "acme")))[0]
        self.assertEqual(shown, "")
        self.assertEqual(path.stat().st_mode & 0o777, 0o600)
        return path

    def run_it(self, *arguments, code=0, environment=None):
        run = subprocess.run([CONTACTCTL, *map(str, arguments)], capture_output=True, text=True,
                             timeout=PATIENCE_S, cwd=self.folder,
                             env={**os.environ, **(environment or {})})
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout, run.stderr

    def ask(self, *arguments, **keywords):
        return self.run_it("--server", f"localhost:{self.server.port}", "--tls-ca", self.ca,
                           *arguments, **keywords)

    def test_token_lets_a_job_run(self):
        self.ask("--token-file", self.token, "run", CHAIN, "-o", "name")
        status = self.ask("--token-file", self.token, "server", "status")[0]
        self.assertIn("you       ci of acme, submit", status)

    def test_a_token_of_the_server_copies_the_store_and_one_of_an_admin_does_not(self):
        copy = self.folder / "copy.db"
        for name, role, code in (("boss", "admin", 9), ("backup", "server", 0)):
            token = self.make_token(name, role)
            wait_for(lambda: name in self.audit_log())
            self.ask("--token-file", token, "server", "backup", "-o", copy, code=code)
        self.assertEqual(copy.read_bytes()[:15], b"SQLite format 3")

    def audit_log(self):
        return (self.folder / "audit.log").read_text()

    def test_who_is_not_known_or_not_allowed_gets_code_9(self):
        said = self.ask("list", code=9)[1]
        self.assertIn("--token-file FILE", said)
        secret = "NotTheSecretOfAnyTokenThatThisServerKnowsAt"
        unknown = self.folder / "unknown.token"
        unknown.touch(mode=0o600)
        unknown.write_text(f"ctk_00000000_{secret}")
        self.assertNotIn(secret, self.ask("--token-file", unknown, "list", code=9)[1])
        said = self.ask("--token-file", self.token, "server", "backup", "-f", "x.db", code=9)[1]
        self.assertIn("role server", said)
        reader = self.make_token("eye", "read")
        self.ask("--token-file", reader, "submit", CHAIN, code=9)

    def test_without_tls_there_is_no_connection_and_no_token_goes_out(self):
        self.run_it("--server", f"localhost:{self.server.port}", "list", code=4)
        said = self.run_it("--server", f"localhost:{self.server.port}", "--token-file", self.token,
                           "list", code=2)[1]
        self.assertIn("unencrypted", said)

    def test_file_that_others_can_read_is_refused(self):
        self.token.chmod(0o644)
        said = self.ask("--token-file", self.token, "list", code=11)[1]
        self.assertIn("chmod 600", said)
        self.assertNotIn(self.token.read_text()[13:], said)

    def test_profile_and_variables_name_the_files(self):
        home = self.folder / "home" / "contact"
        home.mkdir(parents=True)
        (home / "config.toml").write_text(
            f'[profile.lab]\nserver = "localhost:{self.server.port}"\ntls_ca = "{self.ca}"\n'
            f'token_file = "{self.token}"\n')
        where = {"XDG_CONFIG_HOME": str(home.parent)}
        self.run_it("--profile", "lab", "list", environment=where)
        self.ask("list", environment={"CONTACT_TOKEN_FILE": str(self.token)})

    def test_tokens_are_listed_and_revoked(self):
        listed = json.loads(self.run_it("server", "token", "list", "--tokens", self.tokens,
                                        "-o", "json")[0])
        self.assertEqual([(row["user"], row["tenant"], row["roles"], row["state"])
                          for row in listed], [("ci", "acme", ["submit"], "valid")])
        secret = self.token.read_text().strip()
        self.assertNotIn(secret[13:], self.tokens.read_text() + json.dumps(listed))
        self.assertEqual(self.tokens.stat().st_mode & 0o777, 0o600)
        self.run_it("server", "token", "revoke", listed[0]["id"], "--tokens", self.tokens)
        self.run_it("server", "token", "revoke", "nobody", "--tokens", self.tokens, code=6)
        table = self.run_it("server", "token", "list", "--tokens", self.tokens)[0]
        self.assertIn("revoked", table)

    def test_audit_log_tells_which_tokens_are_made_and_revoked(self):
        self.make_token("late", "read")
        listed = json.loads(self.run_it("server", "token", "list", "--tokens", self.tokens,
                                        "-o", "json")[0])
        first, late = [row["id"] for row in listed]
        told = [("VALID", "ci", first), ("CREATED", "late", late)]
        self.wait_for_audit(told)
        self.run_it("server", "token", "revoke", late, "--tokens", self.tokens)
        self.wait_for_audit([*told, ("REVOKED", "late", late)])

    def wait_for_audit(self, expected):
        end, told = time.monotonic() + PATIENCE_S, None
        while told != expected and time.monotonic() < end:
            time.sleep(0.05)
            lines = map(json.loads, (self.folder / "audit.log").read_text().splitlines())
            told = [(line["code"], line["principal"], line["token"]) for line in lines
                    if line["method"] == "token"]
        self.assertEqual(told, expected)

    def test_audit_log_of_several_files_is_verified_in_their_order(self):
        self.server.terminate()
        self.server.flags = (*self.server.flags, "--max-audit-bytes=400")
        self.server.start()
        for _ in range(3):
            self.ask("list", code=9)
        self.server.terminate()
        audit = self.folder / "audit.log"
        said = self.run_it("server", "audit", "verify", audit)[0]
        self.assertRegex(said, r"\d lines in [3-9] files, unbroken")
        first = audit.with_name("audit.log.1")
        text = first.read_text()
        first.write_text(text.replace("acme", "evil", 1))
        self.assertRegex(self.run_it("server", "audit", "verify", audit, code=1)[1],
                         r"audit\.log\.(1:2|2:1): does not fit")  # The line after it.
        first.unlink()
        said = self.run_it("server", "audit", "verify", audit)[1]
        self.assertIn("audit.log.1 are not here", said)

    def test_audit_log_is_verified_with_its_key(self):
        key = self.folder / "key"
        key.write_text("k" * 32 + "\n")
        key.chmod(0o600)
        self.server.terminate()
        self.server.flags += (f"--audit-key={key}",)
        (self.folder / "audit.log").unlink()
        self.server.start()
        self.ask("list", code=9)
        self.server.terminate()
        verify = "server", "audit", "verify", self.folder / "audit.log"
        head = "--head", self.folder / "data" / "audit-head"
        self.assertIn("unbroken", self.run_it(*verify, *head, "--key", key)[0])
        self.assertIn("does not fit", self.run_it(*verify, code=1)[1])
        key.chmod(0o644)
        self.assertIn("chmod 600", self.run_it(*verify, "--key", key, code=11)[1])

    def test_audit_log_is_verified(self):
        self.ask("--token-file", self.token, "run", CHAIN, "-o", "name")
        self.ask("list", code=9)
        self.server.terminate()
        audit = self.folder / "audit.log"
        said = self.run_it("server", "audit", "verify", audit)[0]
        self.assertRegex(said, r"3 lines, unbroken; the last is [0-9a-f]{64}")
        verify = "server", "audit", "verify", audit, "--head", self.folder / "data" / "audit-head"
        self.run_it(*verify)
        whole = audit.read_text()
        for kept in (2, 0):
            audit.write_text("".join(whole.splitlines(keepends=True)[:kept]))
            self.assertIn("is not there: lines are cut off", self.run_it(*verify, code=1)[1])
        self.server.start()
        self.assertIn("does not have the line that was its last", self.server.log())
        self.server.terminate()
        audit.write_text(whole)
        audit.write_text(audit.read_text().replace('"ci"', '"eve"', 1))
        said = self.run_it("server", "audit", "verify", audit, code=1)[1]
        self.assertIn("audit.log:2: does not fit", said)


if __name__ == "__main__":
    unittest.main()
