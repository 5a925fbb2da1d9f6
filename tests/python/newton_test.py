"""Why Newton's restitution is not ε, from the ledger alone."""

import math
import unittest

from contact.v1 import job_pb2
from sample_run import run_of


def collision(**fields):
    return dict(contact="floor", kind=job_pb2.Cycle.COLLISION, end=job_pb2.Cycle.SEPARATION,
                work_compression_j=2, delta_max_m=0.01, **fields)


class NewtonTest(unittest.TestCase):

    # ½ m v² = W_c − P δ_m and ½ m v⁺² = ε² W_c − P δ_m.
    def test_a_constant_load_is_told_with_the_ratio_that_it_leaves(self):
        ratio = math.sqrt((0.25 * 2 - 0.3) / (2 - 0.3))
        job = job_pb2.Job()
        job.cycles.add(number=1, newton_restitution=ratio, restitution_out=0.5,
                       external_work_compression_j=0.3, external_work_restitution_j=-0.3,
                       **collision())
        row = run_of(job, {}).newton.iloc[0]
        self.assertAlmostEqual(row.external_force_n, 30)
        self.assertAlmostEqual(row.predicted, ratio, delta=1e-15)

    def test_of_a_load_that_changes_there_is_no_such_number(self):
        job = job_pb2.Job()
        job.cycles.add(number=1, newton_restitution=0.4, restitution_out=0.5,
                       external_work_compression_j=0.3, external_work_restitution_j=-0.2,
                       **collision())
        row = run_of(job, {}).newton.iloc[0]
        self.assertTrue(math.isnan(row.external_force_n) and math.isnan(row.predicted))

    def test_cycles_that_do_not_separate_and_those_of_older_servers_have_none(self):
        job = job_pb2.Job()
        for value in (math.nan, 0):
            job.cycles.add(newton_restitution=value, **collision())
        self.assertTrue(run_of(job, {}).newton.empty)


if __name__ == "__main__":
    unittest.main()
