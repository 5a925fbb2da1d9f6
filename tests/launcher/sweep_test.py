"""A sweep is computed by workers in Slurm that come, are cancelled, run out of time and leave."""

import subprocess
import time
import unittest

from contact.v1 import job_service_pb2, scenario_pb2
from launching import BINARY, SlurmLauncherTest
from contactd import ENDED, Job, Server, three_ball_chain

CELLS = 2000
# contactd without a limit for so much work, which it would have for one client among many.
UNLIMITED = ("--max-steps=0", "--max-wall-time=0", "--step-timeout=0")


def has_workers():
    told = subprocess.run([BINARY, "--help"], check=True, capture_output=True, text=True).stdout
    return "worker" in told.split("--role", 1)[1].split("\n", 1)[0]


def long_sweep():
    """Cells that take about two minutes on two cores."""
    base = three_ball_chain()
    base.solver.method = scenario_pb2.Solver.RK4
    base.solver.step_s = 4e-8
    base.solver.max_steps = 10**9
    axis = scenario_pb2.Sweep.Axis(
        field="contacts[0].restitution",
        linear=scenario_pb2.Sweep.Range(low=0.6, high=0.9, count=CELLS))
    return scenario_pb2.Sweep(base=base, axes=[axis], metrics=["iterations", "cycles[0].mu"])


def is_cell(event):
    return event.WhichOneof("payload") == "sweep_cell"


def cells_of(server, name):
    """The bytes of each cell by its number, from the whole log, in which each stands once."""
    cells = [event.sweep_cell for event in server.events(name) if is_cell(event)]
    by_number = {cell.index: cell.SerializeToString(deterministic=True) for cell in cells}
    assert len(by_number) == len(cells), "a cell stands in the log twice"
    return by_number


@unittest.skipUnless(has_workers(), "this contactd has no role worker")
class SweepTest(SlurmLauncherTest):

    def serve(self, folder, *flags):
        server = Server(self.folder / folder / "data", *UNLIMITED, *flags, store="")
        server.data_dir.parent.mkdir()
        self.addCleanup(server.kill)
        return server.start()

    def submit(self, server):
        return server.stub.CreateJob(
            job_service_pb2.CreateJobRequest(job=Job(sweep=long_sweep())), timeout=60).name

    def launch_workers(self):
        """Workers that leave after 60 s of the two minutes that they may take. Slurm looks for jobs
        near their limit twice a minute, so that its notice comes half a minute early at most: 85 s
        after their start, when --stop-after is over."""
        self.worker = BINARY
        self.launch("--max-workers=2", "--worker-threads=2", "--launch-interval=2s",
                    "--slurm-time=2m", "--slurm-option=--signal=B:TERM@5", "--exit-when-idle=5s",
                    *(f"--worker-option={flag}" for flag in (*UNLIMITED, "--lease=3s")))

    def watch_first_cell(self, front, name, start):
        front.wait_until(name, is_cell)
        took = time.monotonic() - start
        print(f"first cell {took:.1f} s after the sweep was submitted to 0 workers (≤ 10 s)")
        self.assertLess(took, 10)

    def watch_two_at_once(self, start):
        """Waits until a worker has computed cells that the one that has the sweep lent it."""
        self.wait_for(lambda: self.postgres.run("SELECT count(*) FROM contactd.loans WHERE done",
                                                "sweep") != "0", "only one worker computes")
        print(f"two workers compute {time.monotonic() - start:.1f} s after it was submitted")

    def run_out_of_time(self, front, name):
        """Waits until a worker has left the running sweep because its time was over, as it says."""
        def left():
            self.assertNotIn(front.get(name).state, ENDED, "the sweep is too short")
            said = {log.stem.rsplit("-", 1)[1] for log in self.folder.glob("worker-*.log")
                    if "the time of --stop-after is over" in log.read_text()}
            return said - set(self.jobs())
        return self.wait_for(left, "no worker runs out of time", patience_s=120, every_s=0.5)

    def wait_for_end(self, server, name):
        self.wait_for(lambda: server.get(name).state in ENDED, "the sweep does not end",
                      patience_s=600, every_s=0.5)
        self.assertEqual(server.get(name).state, Job.SUCCEEDED)

    def test_a_sweep_ends_complete_and_equal_though_workers_come_and_go(self):
        self.store = self.postgres.create("sweep")
        subprocess.run([BINARY, "migrate", f"--store={self.store}"], check=True)
        front = self.serve("front", "--role=front", f"--store={self.store}")
        self.launch_workers()
        start = time.monotonic()
        name = self.submit(front)
        self.watch_first_cell(front, name, start)
        self.watch_two_at_once(start)
        cancelled = self.jobs("RUNNING")[0]
        self.slurm.cancel(cancelled)
        print(f"job {cancelled} cancelled")
        print(f"jobs {self.run_out_of_time(front, name)} out of time")
        self.wait_for_end(front, name)
        print(f"the sweep ends {time.monotonic() - start:.0f} s after it was submitted")
        self.wait_for(lambda: not self.jobs(), "the workers do not leave")
        alone = self.serve("alone")
        undisturbed = self.submit(alone)
        self.wait_for_end(alone, undisturbed)
        self.assertEqual(len(cells_of(front, name)), CELLS)
        self.assertEqual(cells_of(front, name), cells_of(alone, undisturbed))


if __name__ == "__main__":
    unittest.main()
