"""What the end of a run cuts, and what was not touched, is told as such, without a server."""

import math
import unittest

import matplotlib.pyplot as plt
from contact.v1 import event_pb2, job_pb2
from contactsim import Result, SweepResult, compare
from contactsim.progress import _words
from contactsim.recording import Recording

Cell = event_pb2.SweepCell
METRIC = "cycles[C].peak_force_n"


def solved(status, **fields):
    """A run with one cycle."""
    job = job_pb2.Job(name=f"jobs/{fields.get('number', 1)}", state=job_pb2.Job.SUCCEEDED,
                      convergence=job_pb2.Job.FULL)
    job.cycles.add(contact="C", status=status, **fields)
    return Result(job, Recording())


def swept(*sources):
    """A sweep over two axes, two cells a row, in which all metrics are 5."""
    job = job_pb2.Job(name="jobs/s", state=job_pb2.Job.SUCCEEDED)
    for field in ("bodies[0].mass_kg", "end_time_s"):
        job.sweep.axes.add(field=field)
    job.sweep.metrics.append(METRIC)
    return SweepResult(job, [
        Cell(index=i, values=[i // 2, i % 2], metrics=[5], sources=[source] if source else [],
             state=job_pb2.Job.SUCCEEDED, convergence=job_pb2.Job.FULL)
        for i, source in enumerate(sources)])


class ResultTest(unittest.TestCase):

    def test_statuses_have_their_names_in_the_ledger(self):
        for status in ("RELEASED", "LIMITED", "CUT"):
            result = solved(getattr(job_pb2.Cycle, status))
            self.assertEqual(list(result.cycles.status), [status])

    def test_cut_cycles_are_counted_beside_the_convergence(self):
        result = solved(job_pb2.Cycle.CUT, peak_force_n=math.nan)
        self.assertNotIn("cut", repr(result))
        result.job.summary.cycles_cut = 1
        self.assertIn("convergence FULL, 1 cycles (1 cut by the end), ", repr(result))
        self.assertTrue(result.converged)
        self.assertTrue(math.isnan(result.cycles.peak_force_n[0]))

    def test_restitution_of_settled_cycles_is_not_compared(self):
        for status, same in ((job_pb2.Cycle.SETTLED, True), (job_pb2.Cycle.RELEASED, True),
                             (job_pb2.Cycle.CONVERGED, False)):
            runs = solved(status, restitution_out=62.8), solved(status, restitution_out=math.nan)
            self.assertEqual(bool(compare(*runs)), same)


class SweepTest(unittest.TestCase):

    def test_metrics_that_are_not_known_are_nan_and_have_a_word(self):
        sweep = swept(Cell.RESULT, Cell.CUT, Cell.NO_CONTACT, Cell.SOURCE_UNSPECIFIED)
        self.assertEqual(list(sweep.unknown[METRIC]), ["", "CUT", "no contact", ""])
        self.assertEqual(list(sweep.frame[METRIC].isna()), [False, True, True, False])
        self.assertEqual(list(sweep.frame.message), ["", f"{METRIC}: CUT", f"{METRIC}: no contact", ""])

    def test_cell_without_a_cycle_says_so(self):
        job = swept().job
        for cycles, message in ((0, "no contact"), (1, "")):
            cell = Cell(values=[1, 1], metrics=[5], cycles=cycles, state=job_pb2.Job.SUCCEEDED)
            self.assertEqual(list(SweepResult(job, [cell]).frame.message), [message])

    def test_heat_map_has_a_legend_for_them(self):
        self.addCleanup(plt.close, "all")
        self.assertIsNone(swept(Cell.RESULT, Cell.RESULT).heatmap().get_legend())
        ax = swept(Cell.RESULT, Cell.CUT, Cell.NO_CONTACT, Cell.RESULT).heatmap()
        self.assertEqual([text.get_text() for text in ax.get_legend().get_texts()],
                         ["CUT", "no contact"])
        ax.figure.canvas.draw()


class ProgressTest(unittest.TestCase):

    def test_words_tell_what_keeps_a_run_busy(self):
        progress = job_pb2.Progress(time_s=1, end_time_s=4)
        self.assertEqual(_words(progress), "1 of 4 s, 0 cycles")
        progress.busy_with = "C, λh 2e4"
        self.assertEqual(_words(progress), "1 of 4 s, 0 cycles; busy: C, λh 2e4")


if __name__ == "__main__":
    unittest.main()
