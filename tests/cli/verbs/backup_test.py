"""contactctl server: what it says of a server, and the copy it takes of what is stored there."""

import json
import subprocess
import unittest

from cli_case import CHAIN, CliTest
from contactd import BINARY, PATIENCE_S


class BackupTest(CliTest):

    def setUp(self):
        super().setUp()
        self.name = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        self.to = self.folder / "restored"
        self.to.mkdir()
        self.file = self.to / "contactd.db"

    def test_copy_is_what_a_new_server_starts_on(self):
        printed, said = self.run_it("server", "backup", "-o", str(self.file))
        self.assertEqual(said, "")
        self.assertEqual(printed, f"{self.file}  {self.file.stat().st_size} bytes, checked\n")
        self.assertEqual([path.name for path in self.to.iterdir()], ["contactd.db"])
        checked = subprocess.run([BINARY, "fsck", "--data-dir", str(self.to)],
                                 capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
        job = self.server.get(self.name)
        self.server.terminate()
        self.server.data_dir = self.to
        self.server.start()
        self.assertEqual(self.server.get(self.name), job)

    def test_older_copy_is_replaced_only_by_a_whole_one(self):
        self.file.write_text("an older copy")
        self.run_it("server", "backup", "-o", str(self.file), code=4,
                    server="127.0.0.1:1")
        self.assertEqual(self.file.read_text(), "an older copy")
        self.assertEqual(list(self.to.iterdir()), [self.file])
        self.run_it("server", "backup", "-o", str(self.file))
        self.assertEqual(self.file.read_bytes()[:15], b"SQLite format 3")

    def test_file_that_cannot_be_written_is_a_local_failure(self):
        printed, said = self.run_it("server", "backup", "-o", str(self.to / "no" / "x"), code=11)
        self.assertEqual(printed, "")
        self.assertIn("No such file or directory", said)

    def test_status_tells_version_load_and_limits(self):
        table = self.run_it("server", "status")[0]
        for word in "contactd 0", "workers", "0 running, 0 queued", "cells", "watchers":
            self.assertIn(word, table)
        status = json.loads(self.run_it("server", "status", "-o", "json")[0])
        self.assertGreater(status["workers"], 0)
        self.assertGreater(status["limits"]["max_cells"], 0)


if __name__ == "__main__":
    unittest.main()
