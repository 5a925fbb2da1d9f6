"""A server with a large store begins to serve as soon as one with a small store.

START_GIGABYTES says how large the store is.
"""

import os
import sqlite3
import time
import unittest

from contactd import three_ball_chain
from fault import *

GIGABYTES = float(os.environ.get("START_GIGABYTES", "0.5"))
JOB_BYTES = 256 << 10  # Of the events of a job, in four of them.


class StartTest(FaultTest):

    def test_the_size_of_the_store_does_not_hold_up_the_start(self):
        name = self.server.run(three_ball_chain()).name
        self.server.terminate()
        jobs = self.fill(int(GIGABYTES * 1e9 / JOB_BYTES))
        before = time.monotonic()
        self.server.start()
        self.assertKept("serves_after", time.monotonic() - before, 2)
        self.assertEqual(self.server.get(name).state, Job.SUCCEEDED)
        self.figures |= dict(jobs=jobs, gigabytes=round(self.size() / 1e9, 1))

    def size(self):
        return (self.server.data_dir / "contactd.db").stat().st_size

    def fill(self, jobs):
        """Adds copies of the one job; returns how many there are."""
        store = sqlite3.connect(self.server.data_dir / "contactd.db", isolation_level=None)
        store.row_factory = sqlite3.Row
        store.execute("PRAGMA synchronous=OFF")
        tables = {table: dict(store.execute(f"SELECT * FROM {table}").fetchone())
                  for table in ("jobs", "specs", "results", "events")}
        payload = os.urandom(JOB_BYTES // 4)
        store.execute("BEGIN")
        for number in range(2, jobs + 2):
            for table, row in tables.items():
                row = dict(row, **{"number" if table == "jobs" else "job": number})
                if table == "jobs":
                    row |= dict(name=f"jobs/copy{number}", request_id=None)
                for sequence in range(1, 5) if table == "events" else (0,):
                    if sequence:
                        row |= dict(sequence=sequence, payload=payload)
                    store.execute(f"INSERT INTO {table}({','.join(row)}) "
                                  f"VALUES({','.join('?' * len(row))})", tuple(row.values()))
        store.execute("COMMIT")
        store.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        store.close()
        return jobs + 1


if __name__ == "__main__":
    unittest.main()
