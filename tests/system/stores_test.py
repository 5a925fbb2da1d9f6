"""A store moves between a directory and a PostgreSQL database, by the commands of its README."""

import hashlib
import pathlib
import re
import subprocess
import unittest

from contactd import BINARY, PATIENCE_S, Job, Server, ServerTest, cluster, database_of, three_ball_chain

README = pathlib.Path(__file__).parents[2] / "server/storage/postgres/README.md"


def contents(server):
    """Every job with its log, without what only the live server adds."""
    jobs = server.list(page_size=1000).jobs
    return {job.name: (server.get(job.name), server.events(job.name)) for job in jobs}


class MoveTest(ServerTest):

    def contactd(self, *arguments, code=0):
        run = subprocess.run([BINARY, *arguments], capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual(run.returncode, code, run.stderr)
        return run.stdout + run.stderr

    def fill(self):
        for restitution in (0.5, 0.7, 0.9):
            scenario = three_ball_chain()
            scenario.contacts[0].restitution = restitution
            job = self.server.run(scenario, request_id=f"chain {restitution}")
            self.assertEqual(job.state, Job.SUCCEEDED)
        before = contents(self.server)
        self.server.terminate()
        return before

    def serve(self, *flags):
        self.server = Server(self.folder / "moved", *flags)
        self.addCleanup(self.server.kill)
        self.server.start()

    def test_jobs_move_into_a_database_and_back(self):
        before = self.fill()
        address = database_of(self.folder / "database")
        directory, back = str(self.server.data_dir), str(self.folder / "back")
        self.assertIn("is up to date", self.contactd("migrate", f"--store={address}"))
        told = self.contactd("copy-store", "--from", directory, "--to", address)
        self.assertRegex(told, r"^copied 3 jobs, \d+ events\n$")
        self.assertIn("has jobs", self.contactd("copy-store", "--from", directory, "--to", address,
                                                code=2))
        self.serve(f"--store={address}")
        self.assertEqual(contents(self.server), before)
        again = self.server.create(three_ball_chain(), request_id="another")
        self.server.events(again.name)
        self.server.delete(again.name)
        self.server.terminate()
        self.contactd("copy-store", "--from", address, "--to", back)
        self.contactd("fsck", "--data-dir", back)
        self.server = Server(back)
        self.addCleanup(self.server.kill)
        self.server.start()
        self.assertEqual(contents(self.server), before)

    def test_pg_dump_is_a_backup(self):
        before = self.fill()
        address = database_of(self.folder / "database")
        self.contactd("copy-store", "--from", str(self.server.data_dir), "--to", address)
        dump = str(self.folder / "monday.dump")
        restored = database_of(self.folder / "restored")
        for command in (["pg_dump", "-Fc", "-f", dump, address],
                        ["pg_restore", "-d", restored, dump]):
            subprocess.run([cluster().bin / command[0], *command[1:]], check=True)
        self.serve(f"--store={restored}")
        self.assertEqual(contents(self.server), before)


class AuditTest(ServerTest):
    """The head of the audit log of a server whose jobs are in a database."""

    def make_server(self):
        self.audit = self.folder / "audit.log"
        return Server(self.folder / "data", f"--audit-log={self.audit}", store="postgres")

    def head(self):
        [command] = re.findall(r"psql -At ADDRESS -c \"(.*)\"", README.read_text())
        rows = subprocess.run([cluster().bin / "psql", "-At", database_of(self.server.data_dir), "-c",
                               command], check=True, capture_output=True, text=True).stdout
        [digest] = re.findall(rf"^audit-head \S+ {self.audit}\|(.*)$", rows, re.MULTILINE)
        return digest

    def test_database_keeps_the_digest_of_the_last_line(self):
        for _ in range(20):
            self.server.create(three_ball_chain())
        self.server.terminate()
        lines = self.audit.read_bytes().splitlines()
        self.assertEqual(self.head(), hashlib.sha256(lines[-1]).hexdigest())
        self.server.start()
        self.assertNotIn("that was its last", self.server.log())
        self.server.terminate()
        self.audit.write_bytes(b"".join(line + b"\n" for line in lines[:-1]))
        self.server.start()
        self.assertIn("does not have the line that was its last", self.server.log())


if __name__ == "__main__":
    unittest.main()
