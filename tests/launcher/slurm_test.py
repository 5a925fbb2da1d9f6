"""The launcher with a whole Slurm on this machine, whose jobs the workers are."""

import time
import unittest

from launching import SlurmLauncherTest


class SlurmTest(SlurmLauncherTest):

    def test_slurm_itself_runs_a_job(self):
        self.assertEqual(len(self.slurm.run("srun", "-N2", "hostname").splitlines()), 2)

    def test_workers_come_within_seconds_and_no_more_than_are_wanted(self):
        self.launch("--max-workers=3", "--launch-interval=2s")
        time.sleep(1)
        self.assertEqual(self.jobs(), [])
        self.demand(3)
        start = time.monotonic()
        self.wait_for(lambda: len(self.notes()) == 3, "the workers do not begin")
        took = time.monotonic() - start
        print(f"three workers begin {took:.1f} s after there is work (≤ 10 s)")
        self.assertLess(took, 10)
        time.sleep(3)
        self.assertEqual(len(self.jobs()), 3)
        self.assertEqual(len(self.notes()), 3)

    def test_workers_that_wait_for_a_place_are_not_started_again(self):
        self.launch("--max-workers=6")  # On four cores.
        self.demand(100)
        self.wait_for(lambda: len(self.jobs("RUNNING")) == 4, "the cores are not used")
        time.sleep(2)
        self.assertEqual(len(self.jobs("PENDING")), 2)
        self.assertEqual(len(self.jobs()), 6)

    def test_a_worker_that_is_cancelled_is_told_and_replaced(self):
        self.launch("--max-workers=2")
        self.demand(2)
        first = self.wait_for_workers(2)
        self.wait_for(lambda: len(self.notes()) == 2, "the workers do not begin")
        self.slurm.cancel(first[0])
        self.wait_for(lambda: len(self.notes()) == 3, "no third worker has come")
        self.assertEqual(len(set(self.wait_for_workers(2)) - set(first)), 1)
        self.assertEqual(sum("terminated" in note for note in self.notes()), 1)

    def test_workers_that_leave_are_not_replaced_when_nothing_waits(self):
        self.launch("--max-workers=2")
        self.demand(2)
        self.wait_for(lambda: len(self.notes()) == 2, "the workers do not begin")
        self.demand(0)
        (self.folder / "leave").touch()
        self.wait_for(lambda: not self.jobs(), "the workers do not leave")
        time.sleep(1)
        self.assertEqual((self.jobs(), len(self.notes())), ([], 2))

    def test_workers_stay_when_the_launcher_ends_and_are_found_by_the_next(self):
        self.launch("--max-workers=2")
        self.demand(2)
        first = self.wait_for_workers(2)
        self.assertEqual(self.end(), 0)
        self.launch("--max-workers=2")
        time.sleep(2)
        self.assertEqual(self.wait_for_workers(2), first)

    def test_a_worker_is_told_before_its_time_limit_and_replaced(self):
        self.launch("--max-workers=1", "--slurm-time=1m")
        self.demand(1)
        self.wait_for(self.notes, "the worker does not begin")
        start = time.time()
        note = self.wait_for(
            lambda: next((note for note in self.notes() if "terminated" in note), None),
            "the worker is not told")
        self.assertLess(float(note.rsplit(" ", 1)[1]) - start, 60)
        self.assertIn("--stop-after=30s", note)
        self.wait_for(lambda: len(self.notes()) == 2, "no second worker has come")

    def test_the_address_of_the_store_is_in_no_script(self):
        store = self.store.replace("contactd@", "contactd:secret@")
        self.launch("--min-workers=1", store=store)
        job = self.wait_for_workers(1)[0]
        self.wait_for(self.notes, "the worker does not begin")
        self.assertIn(f"CONTACTD_STORE={store}\n", self.notes()[0])
        self.assertIn(f"SLURM_JOB_ID={job}\n", self.notes()[0])
        told = self.slurm.run("scontrol", "show", "job", "--details", job)
        told += self.slurm.run("scontrol", "write", "batch_script", job, "-")
        self.assertIn(str(self.worker), told)
        self.assertNotIn("secret", told + self.log())

    def test_a_submission_that_slurm_refuses_is_told_once(self):
        self.launch("--min-workers=1", "--slurm-partition=nowhere")
        self.wait_for(lambda: "invalid partition" in self.log(), "nothing is logged")
        time.sleep(3)
        self.assertEqual(self.log().count("invalid partition"), 1)

    def test_words_of_the_site_reach_sbatch_and_the_worker(self):
        self.launch("--min-workers=1", "--worker-threads=2", "--slurm-option=--comment=a b; 'c'",
                    "--worker-option=--name=it's $HOME")
        job = self.wait_for_workers(1)[0]
        self.wait_for(self.notes, "the worker does not begin")
        self.assertIn("--role=worker --workers=2 --exit-when-idle=300s --name=it's $HOME\n",
                      self.notes()[0])
        self.assertEqual(self.slurm.run("squeue", "-ho%C %k", f"--job={job}").strip(),
                         "2 a b; 'c'")


if __name__ == "__main__":
    unittest.main()
