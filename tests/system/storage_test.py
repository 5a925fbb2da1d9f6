"""What contactd does with data that is not as it left it, and with a copy of it."""

import hashlib
import os
import sqlite3
import subprocess
import time
import unittest

from contact.v1 import admin_service_pb2, admin_service_pb2_grpc
from contactd import (BINARY, PATIENCE_S, ServerTest, endless, is_cycle, spring_wall,
                      three_ball_chain)

REFUSAL_S = 1  # What is promised; a test waits five times as long.


def run(*arguments, **options):
    """Exit code, standard output and error of a contactd that must end by itself."""
    start = time.monotonic()
    ended = subprocess.run([BINARY, *arguments], capture_output=True, text=True,
                           timeout=PATIENCE_S, **options)
    return ended, time.monotonic() - start


def fsck(data_dir):
    ended, _ = run("fsck", f"--data-dir={data_dir}")
    return ended


def contents(data_dir):
    """Hash of the database; the lock is written by whoever tries."""
    return hashlib.sha256((data_dir / "contactd.db").read_bytes()).hexdigest()


class RefusalTest(ServerTest):

    def setUp(self):
        super().setUp()
        self.server.run(three_ball_chain())
        self.server.terminate()
        self.data = self.server.data_dir
        self.database = self.data / "contactd.db"

    def assertRefused(self, code, *words, **options):
        before = contents(self.data)
        ended, took = run("--listen=127.0.0.1:0", f"--data-dir={self.data}", **options)
        self.assertEqual(ended.returncode, code, ended.stderr)
        self.assertEqual(ended.stdout, "")
        self.assertEqual(ended.stderr.count("\n"), 1, ended.stderr)
        self.assertTrue(ended.stderr.startswith("contactd: "), ended.stderr)
        self.assertIn(str(self.data), ended.stderr)
        for word in words:
            self.assertIn(word, ended.stderr)
        self.assertLess(took, 5 * REFUSAL_S)
        self.assertEqual(contents(self.data), before)

    def test_garbage_in_the_header(self):
        whole = self.database.read_bytes()
        self.database.write_bytes(b"x" * 100 + whole[100:])
        self.assertRefused(2, "is damaged", "restore it from a backup")

    def test_truncated(self):
        whole = self.database.read_bytes()
        for size in 50, 1000, len(whole) // 2, len(whole) - 4096:
            self.database.write_bytes(whole[:size])
            self.assertRefused(2, "is damaged", "restore it from a backup")

    def test_empty(self):
        self.database.write_bytes(b"")
        self.assertRefused(2, "is empty", "restore it from a backup")

    def test_newer_schema(self):
        with sqlite3.connect(self.database) as raw:
            raw.execute("PRAGMA user_version=99")
        raw.close()
        self.assertRefused(2, "schema version 99", "newer program")

    @unittest.skipIf(os.geteuid() != 0, "needs another user")
    def test_files_of_another_user(self):
        self.folder.chmod(0o755)
        other = dict(user=65534, group=65534, extra_groups=[])
        self.assertRefused(2, "Permission denied", "run contactd as the user", **other)
        os.chown(self.data, 65534, 65534)
        (self.data / "lock").unlink()
        self.database.chmod(0o600)
        self.assertRefused(2, "Permission denied", "run contactd as the user", **other)

    def test_second_process_learns_who_is_there(self):
        self.server.start()
        self.assertRefused(3, f"process {self.server.process.pid}", "stop it")
        self.server.run(three_ball_chain())

    def test_data_of_its_own_are_for_the_owner_only(self):
        self.assertEqual(self.data.stat().st_mode & 0o777, 0o700)


class FsckTest(ServerTest):

    def test_exit_code_tells_good_from_damaged_from_held_from_none(self):
        self.server.run(three_ball_chain())
        self.assertEqual(fsck(self.server.data_dir).returncode, 3, "held by the server")
        self.server.terminate()
        good = fsck(self.server.data_dir)
        self.assertEqual(good.returncode, 0, good.stdout)
        self.assertRegex(good.stdout, r"^\S+: 1 job, \d+ events, 0 findings\n$")
        with sqlite3.connect(self.server.data_dir / "contactd.db") as raw:
            raw.execute("UPDATE events SET payload=zeroblob(LENGTH(payload)) WHERE sequence=3")
        raw.close()
        before = contents(self.server.data_dir)
        damaged = fsck(self.server.data_dir)
        self.assertEqual(damaged.returncode, 1)
        self.assertIn("event 3 fails its checksum\n", damaged.stdout)
        self.assertIn("1 finding\n", damaged.stdout)
        self.assertEqual(contents(self.server.data_dir), before)
        none = fsck(self.folder / "none")
        self.assertEqual(none.returncode, 2)
        self.assertIn(str(self.folder / "none"), none.stderr)

    def test_what_a_kill_leaves_is_whole(self):
        name = self.server.create(endless()).name
        self.server.wait_until(name, is_cycle)
        self.server.kill()
        after = fsck(self.server.data_dir)
        self.assertEqual(after.returncode, 0, after.stdout)


class BackupTest(ServerTest):

    flags = ("--workers=1",)

    def backup(self, to):
        """Puts a backup of the server into a new data directory."""
        to.mkdir()
        stub = admin_service_pb2_grpc.AdminServiceStub(self.server.channel)
        with open(to / "contactd.db", "wb") as file:
            for chunk in stub.Backup(admin_service_pb2.BackupRequest(), timeout=PATIENCE_S):
                file.write(chunk.data)

    def test_restored_server_has_all_jobs_and_goes_on(self):
        ended = self.server.run(three_ball_chain(), request_id="one")
        log = self.server.events(ended.name)
        running = self.server.create(endless()).name
        before = self.server.wait_until(running, is_cycle)
        queued = self.server.create(spring_wall(end_time_s=0.01)).name
        self.backup(self.folder / "restored")
        self.server.kill()
        checked = fsck(self.folder / "restored")
        self.assertEqual(checked.returncode, 0, checked.stdout)

        self.server.data_dir = self.folder / "restored"
        self.server.start()
        self.assertEqual([job.name for job in self.server.list().jobs],
                         [queued, running, ended.name])
        self.assertEqual(self.server.get(ended.name), ended)
        self.assertEqual(self.server.events(ended.name), log)
        kept = [event for event in before if event.sequence > 0]
        again = self.server.wait_until(
            running, lambda e: e.HasField("attempt_started") and e.attempt_started.attempt == 2)
        self.assertEqual(again[:len(kept)], kept)
        self.server.cancel(running)
        self.assertWholeLog(self.server.events(running))
        self.assertWholeLog(self.server.events(queued))
        new = self.server.create(three_ball_chain()).name
        self.assertEqual(self.server.list().jobs[0].name, new, "the newest")
        self.assertEqual(self.server.create(three_ball_chain(), request_id="one").name, ended.name)

    def test_crash_in_a_backup_leaves_nothing_behind(self):
        draft = self.server.data_dir / "backup.tmp"
        self.server.kill()
        draft.write_bytes(b"half a backup")
        self.server.start()
        self.assertFalse(draft.exists())


if __name__ == "__main__":
    unittest.main()
