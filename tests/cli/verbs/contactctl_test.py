"""contactctl against a real contactd."""

import fcntl
import json
import os
import pathlib
import pty
import select
import shutil
import signal
import socket
import struct
import subprocess
import termios
import threading
import time
import unittest

from cli_case import CHAIN, CONTACTCTL, LONG, REFERENCE, SCENARIOS, SPRING, CliTest, read_until
from contactd import PATIENCE_S, Job, is_cycle, wait_for


class SeriesTest(CliTest):

    def setUp(self):
        super().setUp()
        self.job = self.run_it("run", CHAIN, "-o", "name")[0].strip()

    def test_durations_are_those_of_the_servers_flags(self):
        name = self.run_it("run", CHAIN, "--ttl", "30d", "-o", "name")[0].strip()
        self.assertEqual(self.server.get(name).time_to_live.seconds, 30 * 24 * 3600)
        for text in ("0", "-1s", "1w"):
            self.run_it("run", CHAIN, f"--ttl={text}", code=2)

    def test_csv_holds_the_recorded_motion_with_units_in_its_header(self):
        lines = self.run_it("series", self.job, "--raw", "-o", "csv")[0].splitlines()
        header = lines[0].split(",")
        self.assertEqual(header[:3], ["time [s]", "B1.position [m]", "B1.velocity [m/s]"])
        self.assertEqual(header[-2:], ["system.dissipated_energy [J]", "system.load_work [J]"])
        self.assertIn("B2-B3.external_force [N]", header)
        self.assertEqual(len(lines), 1 + 1001)
        last = dict(zip(header, map(float, lines[-1].split(","))))
        self.assertEqual(last["time [s]"], 4e-3)
        self.assertAlmostEqual(last["B3.velocity [m/s]"], 0.155004951207, delta=1e-8)

    def test_few_points_keep_the_peak(self):
        def forces(*arguments):
            text, _ = self.run_it("series", self.job, "--channel", "B1-B2.contact_force",
                                  "-o", "json", *arguments)
            series = json.loads(text)
            self.assertEqual(series["columns"][1]["unit"], "N")
            return series["columns"][1]["values"]
        every, few = forces("--raw"), forces("--points", "10")
        self.assertLessEqual(len(few), 10)
        self.assertEqual(max(few), max(every))

    def test_table_shows_part_of_a_time_range(self):
        text, _ = self.run_it("series", self.job, "--channel", "B2.velocity", "--from", "1e-3",
                              "--to", "2e-3", "--points", "100")
        self.assertIn("time [s]  B2.velocity [m/s]", text)
        self.assertRegex(text, r"\d+ of 251 samples, no peak left out")

    def test_unknown_channels_are_told_with_those_that_exist(self):
        _, words = self.run_it("series", self.job, "--channel", "B1.velocty", "--channel", "x",
                               code=2)
        self.assertIn("channels[0]: 'B1.velocty' is no channel of this job — "
                      "did you mean 'B1.velocity'?", words)
        self.assertIn("channels[1]: 'x' is no channel of this job — channels are time, ", words)
        self.run_it("series", "none", code=6)


class SweepTest(CliTest):

    def file(self, text):
        path = self.folder / "sweep.yaml"
        path.write_text(text)
        return path

    def test_table_3_of_the_paper_converges_in_every_cell(self):
        text, words = self.run_it("sweep", "run", SCENARIOS / "table-3-sweep.yaml")
        self.assertIn("SUCCEEDED  50 of 50 cells\n", text)
        self.assertIn("iterations over bodies[0].velocity_m_per_s (down) and "
                      "contacts[*].restitution (across, 0.95 … 0.5)", text)
        self.assertNotIn("!", text.split("░")[0].rsplit("across", 1)[1])
        job = words.split()[0]
        lines = self.run_it("sweep", "export", job, "-o", "csv")[0].splitlines()
        self.assertEqual(lines[0], "cell,bodies[0].velocity_m_per_s,contacts[*].restitution,"
                         "iterations,cycles[B1-B2].alpha,cycles[B2-B3].mu_over_k_s_per_m,"
                         "final_bodies[B3].velocity_m_per_s,state,convergence,message")
        rows = [line.split(",") for line in lines[1:]]
        self.assertEqual([int(row[0]) for row in rows], list(range(50)))
        alpha = {0.9: 0.188225042195671, 0.7: 0.8260690232648109, 0.5: 2.206095738306658}
        for row in rows:  # One solution for all velocities, as tests/reference/table3.json knows.
            self.assertEqual(row[7:], ["SUCCEEDED", "FULL", ""])
            if float(row[2]) in alpha:
                self.assertAlmostEqual(float(row[4]), alpha[float(row[2])], delta=1e-6)

    def test_an_axis_of_laws_takes_their_names(self):
        path = self.file(f"base: {CHAIN}\naxes:\n- {{field: 'contacts[*].damping', "
                         "values: [EXACT, HUNT_CROSSLEY]}\n"
                         "- {field: 'contacts[*].reference_velocity_m_per_s', values: [0.2]}\n"
                         "metrics: ['cycles[B1-B2].restitution_out']\n")
        job = self.run_it("sweep", "run", path, "-o", "name")[0].strip()
        rows = self.run_it("sweep", "export", job, "-o", "csv")[0].splitlines()[1:]
        for row, law in zip(rows, ("EXACT", "HUNT_CROSSLEY")):
            one = self.run_it("run", CHAIN, "--set", f"contacts[*].damping={law}", "--set",
                              "contacts[*].reference_velocity_m_per_s=0.2", "-o", "name")[0].strip()
            cycle = next(c for c in self.server.get(one).cycles if c.contact == "B1-B2")
            self.assertEqual(float(row.split(",")[3]), cycle.restitution_out)

    def test_heat_map_hatches_and_crosses(self):
        base = CHAIN.read_text().replace("\n", "\n  ")
        path = self.file(f"base:\n  {base}\naxes:\n"
                         "- {field: 'contacts[0].restitution', values: [0.5, 1.5]}\n"
                         "- {field: 'solver.max_iterations', values: [1, 50]}\n"
                         "metrics: ['iterations']\n")
        job = self.run_it("sweep", "run", path, "-o", "name")[0].strip()
        figure = self.folder / "map.svg"
        self.run_it("sweep", "export", job, "--heatmap", figure)
        svg = figure.read_text("utf-8")
        self.assertEqual(svg.count("<pattern"), 1)  # One cell did not converge.
        self.assertEqual(svg.count("stroke: #b00020"), 4)  # Two failed; a cross has two lines.
        self.assertIn("restitution of B1-B2 [1]", svg)
        png = self.folder / "map.png"
        self.run_it("sweep", "export", job, "--heatmap", png)
        self.assertTrue(png.read_bytes().startswith(b"\x89PNG"))

    def test_validate_checks_sweep_files_in_the_same_words(self):
        said, _ = self.run_it("validate", SCENARIOS / "table-3-sweep.yaml")
        self.assertIn("valid; 50 cells, 2 axes, 4 metrics", said)
        path = self.file(f"base: {CHAIN}\naxes:\n- {{field: 'contacts[0].restituton', "
                         "values: [0.5]}\nmetrics: [iterations]\n")
        _, checked = self.run_it("validate", path, code=3)
        _, run = self.run_it("sweep", "run", path, code=3)
        self.assertEqual(checked, run)
        self.assertIn("did you mean 'restitution'?", checked)

    def test_cells_that_fail_are_marked_and_the_others_go_on(self):
        base = CHAIN.read_text().replace("\n", "\n  ")
        path = self.file(f"base:\n  {base}\naxes:\n"
                         "- {field: 'contacts[0].restitution', values: [0.5, 1.5]}\n"
                         "- {field: 'solver.max_iterations', values: [1, 50]}\n"
                         "metrics: ['iterations']\n")
        text, _ = self.run_it("sweep", "run", path, code=7)
        self.assertIn("4 of 4 cells, 2 failed, 1 not converged", text)
        self.assertIn("SCENARIO_INVALID", text)
        self.assertRegex(text, r"0\.5  .! ..\n")
        self.assertRegex(text, r"1\.5  ×× ××\n")
        job = json.loads(self.run_it("list", "-o", "json")[0])["jobs"][0]["name"]
        exported = json.loads(self.run_it("sweep", "export", job, "-o", "json")[0])
        self.assertEqual([cell["index"] for cell in exported["cells"]], [0, 1, 2, 3])
        self.assertIn("is 1.5; must be in (0, 1]", exported["cells"][2]["message"])

    def test_mistakes_are_told_at_their_place(self):
        shutil.copy(CHAIN, self.folder / "chain.yaml")
        path = self.file("base: chain.yaml\n"
                         "axes:\n"
                         "- {field: 'contacts[0].restituton', values: [0.5]}\n"
                         "- {field: 'bodies[0].mass_kg'}\n"
                         "metrics: [mu]\n")
        _, words = self.run_it("sweep", "run", path, code=3)
        self.assertIn(f"{path}:3:11: axes[0].field: 'contacts[0].restituton': unknown field — "
                      "did you mean 'restitution'?", words)
        self.assertIn(f"{path}:4:3: axes[1]: has no values", words)
        self.assertIn("metrics[0]: 'mu': unknown field 'mu'", words)
        self.assertIn("3 errors", words)

    def test_sweep_of_a_missing_base_or_job_says_so(self):
        path = self.file("base: none.yaml\naxes: []\n")
        self.run_it("sweep", "run", path, code=11)
        self.run_it("sweep", "watch", "none", code=6)
        job = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        self.assertIn("is no sweep", self.run_it("sweep", "watch", job, code=2)[1])


class RunTest(CliTest):

    def job(self, *arguments, code=0):
        printed, _ = self.run_it("run", *arguments, "-o", "json", code=code)
        return json.loads(printed)  # One document, or this fails.

    def test_chain_ends_as_the_paper_s_case_does(self):
        job = self.job(CHAIN)
        self.assertEqual(job["state"], "SUCCEEDED")
        self.assertEqual(job["convergence"], "FULL")
        for body, expected in zip(job["final_bodies"],
                                  (-0.003731206344, 0.048726255138, 0.155004951207)):
            self.assertAlmostEqual(body["velocity_m_per_s"], expected, delta=1e-8)
        for cycle in job["cycles"]:
            self.assertLess(abs(cycle["restitution_out"] - cycle["restitution_in"]),
                            1e-8 * cycle["restitution_in"])
            self.assertEqual(cycle["delta_start_m"], 0)  # Zeros are printed.

    def test_spring_supported_ball_has_the_known_cycles(self):
        cycles = self.job(SPRING)["cycles"]
        known = json.loads(REFERENCE.read_text())
        self.assertEqual([c["end"] for c in cycles[:6]],
                         ["SEPARATION"] * 4 + ["NON_SEPARATION"] * 2)
        for cycle, reference in zip(cycles, known):
            self.assertAlmostEqual(cycle["mu_over_k_s_per_m"], reference["mu_over_k"], delta=1e-6)

    def test_isolated_collision_obeys_the_exact_law(self):
        job = self.job(SCENARIOS / "two-balls.yaml")
        self.assertAlmostEqual(job["cycles"][0]["alpha"], 1.43275053327, delta=1e-6)
        velocities = [body["velocity_m_per_s"] for body in job["final_bodies"]]
        self.assertAlmostEqual(velocities[0], 0.25, delta=1e-8)
        self.assertAlmostEqual(velocities[1], 0.75, delta=1e-8)

    def test_glass_balls_meet_as_hertz_says(self):
        job = json.loads(self.run_it("run", SCENARIOS / "glass-balls.yaml", "-o", "json")[0])
        cycle, = job["cycles"]
        self.assertAlmostEqual(cycle["delta_max_m"] / 274.1127e-6, 1, delta=1e-6)
        self.assertAlmostEqual(cycle["peak_force_n"] / 10696.89, 1, delta=1e-6)
        self.assertAlmostEqual(
            (cycle["end_time_s"] - cycle["start_time_s"]) / 40.33946e-6, 1, delta=1e-6)

    def test_pulse_begins_a_cycle_where_it_begins(self):
        job = json.loads(self.run_it("run", SCENARIOS / "half-sine-pulse.yaml", "-o", "json",
                                     code=None)[0])
        self.assertEqual(job["cycles"][0]["kind"], "NIRV")
        self.assertAlmostEqual(job["cycles"][0]["start_time_s"], 1e-3, delta=1e-12)
        self.assertLess(job["summary"]["energy_residual"], 1e-9)

    def test_law_that_misses_is_told(self):
        job = json.loads(self.run_it("run", CHAIN, "--set", "contacts[0].damping=HUNT_CROSSLEY",
                                     "-o", "json", code=None)[0])
        self.assertIn("its law delivers a restitution of", job["warnings"][0])

    def test_laws_are_compared_by_their_closed_form_or_by_a_run(self):
        printed = self.run_it("model", "compare", "-o", "csv", "--restitution", "0.3,0.5")[0]
        rows = [line.split(",") for line in printed.splitlines()]
        self.assertEqual(rows[0], ["law", "requested", "delivered", "miss", "method"])
        self.assertEqual(len(rows), 1 + 2 * 15)
        delivered = {(row[0], row[1]): float(row[2]) for row in rows[1:]}
        self.assertAlmostEqual(delivered["HUNT_CROSSLEY", "0.5"], 0.66296, delta=5e-6)
        methods = {row[0]: row[4] for row in rows[1:]}
        for law in ("ENERGY_RESTITUTION", "KELVIN_VOIGT", "HERTZ_QUARTER_POWER"):
            self.assertEqual(methods.pop(law), "simulation")
            self.assertAlmostEqual(delivered[law, "0.3"], 0.3, delta=3e-9)
        self.assertEqual(set(methods.values()), {"closed form"})
        self.assertEqual(len(json.loads(self.run_it("list", "-o", "json")[0]).get("jobs", [])), 0)

    def test_ball_bounces_with_its_restitution(self):
        cycles = self.job(SCENARIOS / "bouncing-ball.yaml")["cycles"]
        self.assertGreater(len(cycles), 3)
        for cycle in cycles:
            self.assertAlmostEqual(cycle["restitution_out"], 0.8, delta=1e-7)

    def test_overrides_and_labels_reach_the_server(self):
        job = self.job(CHAIN, "--set", "contacts[*].damping=flores", "--set", "title=F",
                       "--label", "law=flores", "--label", "n=1")
        self.assertEqual([c["damping"] for c in job["scenario"]["contacts"]], ["FLORES"] * 2)
        self.assertEqual(job["labels"], {"law": "flores", "n": "1"})
        self.assertEqual(self.run_it("list", "--label", "law=flores", "-o", "name")[0],
                         job["name"] + "\n")

    def test_printed_scenario_can_be_run_again_to_the_same_result(self):
        first = self.job(CHAIN)
        again = self.folder / "again.json"
        again.write_text(json.dumps(first["scenario"]))
        self.assertEqual(self.job(again)["cycles"], first["cycles"])

    def test_table_shows_the_iteration_as_a_message_and_the_ledger_as_data(self):
        printed, said = self.run_it("run", CHAIN)
        self.assertRegex(printed, r"(?m)^B1-B2 +1 +1  COLLISION  SEPARATION  CONVERGED")
        self.assertIn("convergence FULL", printed)
        self.assertRegex(said, r"(?m)^jobs/\w+ submitted$")
        self.assertRegex(said, r"(?m)^ +1 +0  B1-B2 .*NEWTON$")
        self.assertRegex(said, r"(?m)^Next:  contactctl watch \w+")
        self.assertNotIn("\x1b", printed + said)

    def test_color_is_for_those_who_ask(self):
        printed, _ = self.run_it("--color", "always", "run", CHAIN)
        self.assertIn("\x1b[32mSUCCEEDED", printed)


class ExitCodeTest(CliTest):

    flags = ("--workers=1", "--max-queued-jobs=1", "--max-bodies=3")

    def test_failed_run_is_1(self):
        printed, _ = self.run_it("run", SPRING, "--set", "solver.max_steps=10", code=1)
        self.assertIn("FAILED (BUDGET_STEPS)", printed)

    def test_partly_converged_run_is_7_with_its_ledger(self):
        printed, said = self.run_it("run", CHAIN, "--set", "solver.max_iterations=1", code=7)
        self.assertIn("NOT_CONVERGED", printed)
        self.assertIn("convergence PARTIAL", printed)
        self.assertIn("--set solver.max_iterations=", said)

    def test_run_that_must_converge_and_does_not_is_1(self):
        self.run_it("run", CHAIN, "--set", "solver.max_iterations=1", "--set",
                    "solver.on_not_converged=fail", code=1)

    def test_what_the_server_refuses_is_3_at_its_place_in_the_file(self):
        file = self.folder / "four.yaml"
        file.write_text("end_time_s: 1\nbodies:\n" + "".join(
            f"- {{name: B{i}, mass_kg: 1, position_m: {i}}}\n" for i in range(4)))
        _, said = self.run_it("submit", file, code=3)
        self.assertEqual(said, f"{file}:3:1: bodies: holds 4; must hold at most 3\n1 error\n")

    def test_unknown_job_is_6(self):
        for command in (["describe"], ["watch"], ["wait"], ["cancel"], ["delete"], ["label", "n=1"]):
            _, said = self.run_it(*command, "nosuchjob", code=6)
            self.assertIn("JOB_NOT_FOUND", said)

    def test_unknown_kind_is_2(self):
        name = self.run_it("submit", CHAIN, "-o", "name")[0].strip()
        self.run_it("watch", name, "--kinds", "cycel", code=2)

    def test_time_that_is_up_is_5_and_the_job_continues(self):
        _, said = self.run_it("run", SPRING, *LONG, "--timeout", "500ms", code=5)
        self.assertRegex(said, r"the job continues: contactctl watch \w+")
        name = self.run_it("list", "--state", "running", "-o", "name")[0].strip()
        self.run_it("wait", name, "--timeout", "0.2", code=5)
        self.run_it("delete", name, code=1)
        self.run_it("cancel", name)
        self.run_it("wait", name, code=1)
        self.run_it("watch", name, code=1)
        self.run_it("delete", name)
        self.run_it("describe", name, code=6)

    def test_full_queue_is_10(self):
        self.server.wait_until(self.submit_long(), is_cycle)  # It has left the queue.
        self.submit_long()
        _, said = self.run_it("submit", CHAIN, code=10)
        self.assertIn("QUEUE_FULL", said)

    def test_server_that_does_not_answer_is_unreachable_or_late(self):
        with socket.create_server(("127.0.0.1", 0)) as silent:
            address = f"127.0.0.1:{silent.getsockname()[1]}"
            run = subprocess.run(self.command("list", "--timeout", "500ms", server=address),
                                 capture_output=True, encoding="utf-8", timeout=PATIENCE_S)
        self.assertIn(run.returncode, (4, 5), run.stderr)

    def test_interrupt_is_130_and_the_job_continues(self):
        for command in (["run", SPRING, *LONG], ["watch", None], ["wait", None]):
            with self.subTest(command[0]):
                if command[1] is None:
                    command[1] = self.run_it("list", "-o", "name")[0].split()[0]
                process = self.start(*command)
                if command[0] == "run":
                    read_until(process.stderr, b"submitted")
                    read_until(process.stderr, b"NEWTON")
                elif command[0] == "watch":
                    read_until(process.stdout, b"cycle 1")
                else:
                    until_it_listens(process)  # It says nothing; before, it dies by the signal.
                process.send_signal(signal.SIGINT)
                out, said = process.communicate(timeout=PATIENCE_S)
                self.assertEqual(process.returncode, 130, said)
                self.assertIn(b"the job continues: contactctl watch ", said)
        self.assertEqual(len(self.run_it("list", "--state", "RUNNING", "-o", "name")[0].split()), 1)


def until_it_listens(process):
    """Waits until the process handles SIGINT."""
    deadline = time.monotonic() + PATIENCE_S
    while time.monotonic() < deadline:
        status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
        caught = int(status.split("SigCgt:")[1].split()[0], 16)
        if caught & 1 << (signal.SIGINT - 1):
            return
        time.sleep(0.01)
    raise AssertionError("it never listened")


def shut(one):
    try:
        one.shutdown(socket.SHUT_RDWR)
    except OSError:
        pass  # The other side was first.


class Link:
    """A wire between client and server that can be cut, and mends itself."""

    def __init__(self, port):
        self.port = port
        self.open = []
        self.all = []
        self.cuts = 0
        self.lock = threading.Lock()
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.address = f"127.0.0.1:{self.listener.getsockname()[1]}"
        threading.Thread(target=self._accept, daemon=True).start()

    def cut(self):
        """Breaks what is connected; False if nothing is."""
        with self.lock:
            cut, self.open = self.open, []
        for one in cut:
            shut(one)
        self.cuts += bool(cut)
        return bool(cut)

    def close(self):
        self.listener.close()
        self.cut()
        for one in self.all:
            one.close()

    def _accept(self):
        while True:
            try:
                near, _ = self.listener.accept()
            except OSError:
                return
            try:
                far = socket.create_connection(("127.0.0.1", self.port))
            except OSError:
                near.close()
                continue
            with self.lock:
                self.open += [near, far]
                self.all += [near, far]
            for source, sink in ((near, far), (far, near)):
                threading.Thread(target=self._copy, args=(source, sink), daemon=True).start()

    @staticmethod
    def _copy(source, sink):
        try:
            while block := source.recv(65536):
                sink.sendall(block)
        except OSError:
            pass
        for one in (source, sink):
            shut(one)


class WatchTest(CliTest):

    def lines(self, text):
        return [line for line in map(json.loads, text.splitlines()) if int(line.get("sequence", 0))
                and "bookmark" not in line and "gap" not in line]

    def test_killed_watcher_leaves_the_job_and_the_next_sees_it_from_the_start(self):
        name = self.submit_long()
        first = self.start("watch", name, "-o", "jsonl")
        read_until(first.stdout, b'"cycle"')
        first.kill()
        first.wait()
        self.assertEqual(self.server.get(name).state, Job.RUNNING)
        self.run_it("cancel", name)
        printed, _ = self.run_it("watch", name, "-o", "jsonl", code=1)
        sequences = [int(line["sequence"]) for line in self.lines(printed)]
        self.assertEqual(sequences, list(range(1, len(sequences) + 1)))

    def test_no_event_is_missed_or_repeated_when_the_link_is_cut_twenty_times(self):
        link = Link(self.server.port)
        self.addCleanup(link.close)
        name = self.submit_long()
        # Frames may be spared to a slow watcher; everything else may not.
        kinds = ("--kinds", "log_entry,cycle,attempt_started")
        watch = self.start("watch", name, "-o", "jsonl", *kinds, server=link.address)
        seen = []
        reader = threading.Thread(
            target=lambda: seen.extend(iter(lambda: os.read(watch.stdout.fileno(), 65536), b"")))
        reader.start()
        for _ in range(20):
            heard = len(seen)
            wait_for(lambda: link.open and len(seen) > heard, 5)  # A cut costs less than a second.
            self.assertTrue(link.cut())
        self.run_it("cancel", name)
        reader.join(PATIENCE_S)
        self.assertEqual(watch.wait(PATIENCE_S), 1)
        self.assertIn(b"connection lost", watch.stderr.read())
        whole, _ = self.run_it("watch", name, "-o", "jsonl", *kinds, code=1)
        self.assertGreater(len(self.lines(whole)), 100)
        self.assertEqual(self.lines(b"".join(seen).decode()), self.lines(whole))

    def test_watch_goes_on_with_the_next_server_on_the_same_data(self):
        link = Link(self.server.port)
        self.addCleanup(link.close)
        name = self.submit_long()
        watch = self.start("watch", name, server=link.address)
        read_until(watch.stdout, b"cycle 2:")
        self.server.kill()
        self.server.start()
        link.port = self.server.port
        read_until(watch.stdout, b"attempt 2 ")  # Anew, or from a checkpoint.
        self.run_it("cancel", name)
        read_until(watch.stdout, b"CANCELLED")
        self.assertEqual(watch.wait(PATIENCE_S), 1)
        said = watch.stderr.read().decode().splitlines()
        self.assertEqual([line.split(" (")[0] for line in said if "conn" in line],
                         ["connection lost", "connected again"])

    def test_watch_tells_from_where_a_long_run_goes_on(self):
        self.server.terminate()
        self.server.flags = ("--checkpoint-interval=50ms",)
        self.server.start()
        name = self.submit_long()
        self.server.wait_until(name, lambda event: is_cycle(event) and event.cycle.number > 500)
        time.sleep(0.5)  # Far more than a checkpoint needs.
        self.server.kill()
        self.server.start()
        watch = self.start("watch", name, "--kinds", "attempt_started")
        seen = read_until(watch.stdout, b"follows again\n").decode()
        self.assertRegex(seen, r"attempt \d goes on from t = [\d.e+-]+ m?s; what was recorded before "
                               r"follows again\n")
        self.run_it("cancel", name)

    def test_watch_can_begin_later_and_choose(self):
        name = self.run_it("run", SPRING, "-o", "name")[0].strip()
        printed, _ = self.run_it("watch", name, "-o", "jsonl", "--kinds", "cycle")
        cycles = [line for line in self.lines(printed) if "cycle" in line]
        self.assertEqual(len(cycles), len(self.server.get(name).cycles))
        after = cycles[3]["sequence"]
        printed, _ = self.run_it("watch", name, "-o", "jsonl", "--kinds", "cycle",
                                 "--after-sequence", after)
        self.assertEqual([line for line in self.lines(printed) if "cycle" in line], cycles[4:])
        self.assertEqual(self.run_it("watch", name, "--after-sequence", 10**9, "-o", "jsonl")[0],
                         "")


class TerminalTest(CliTest):

    def test_progress_is_one_line_that_fits_the_terminal_and_is_erased(self):
        for width in (40, 100):
            master, slave = pty.openpty()
            fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, width, 0, 0))
            process = subprocess.Popen(self.command("run", SPRING, *LONG), stdin=slave,
                                       stdout=slave, stderr=slave, env={**os.environ, "TERM": "xterm"})
            os.close(slave)
            seen = read_until(master, b"more iterations;")
            seen += read_until(master, b" %")
            process.send_signal(signal.SIGINT)
            seen += read_until(master, b"the job continues")
            self.assertEqual(process.wait(PATIENCE_S), 130)
            os.close(master)
            progress = [part for part in seen.decode(errors="replace").split("\r\x1b[K")
                        if " % " in part]
            self.assertTrue(progress)
            for part in progress[:-1]:
                self.assertLess(len(part), width, part)
                self.assertNotIn("\n", part)


class ListTest(CliTest):

    def test_pages_are_one_list(self):
        names = [self.run_it("submit", CHAIN, "-o", "name")[0] for _ in range(3)]
        self.assertTrue(all(name.startswith("jobs/") and name.endswith("\n") for name in names))
        self.assertEqual(self.run_it("list", "-o", "name")[0], "".join(reversed(names)))
        self.assertEqual(self.run_it("list", "--all", "-o", "name")[0],
                         "".join(reversed(names)))
        printed, said = self.run_it("list", "--limit", "2")
        self.assertEqual(len(printed.splitlines()), 1 + 2)
        self.assertIn("--all", said)
        jobs = json.loads(self.run_it("list", "-o", "json")[0])["jobs"]
        self.assertEqual([job["name"] + "\n" for job in jobs], names[::-1])

    def test_same_request_id_is_the_same_job(self):
        names = {self.run_it("submit", CHAIN, "--request-id", "r", "-o", "name")[0]
                 for _ in range(2)}
        self.assertEqual(len(names), 1)

    def test_describe_and_result_are_one(self):
        name = self.run_it("run", CHAIN, "-o", "name")[0].strip()
        short = name.removeprefix("jobs/")
        self.assertEqual(self.run_it("describe", name), self.run_it("result", short))
        self.assertEqual(json.loads(self.run_it("result", short, "-o", "json")[0])["name"], name)
        self.assertEqual(self.run_it("wait", short)[0], f"{name}  SUCCEEDED\n")

    def test_server_tells_what_it_is(self):
        self.assertIn("workers", self.run_it("server", "info")[0])
        info = json.loads(self.run_it("server", "info", "-o", "json")[0])
        self.assertGreater(info["limits"]["max_bodies"], 0)


if __name__ == "__main__":
    unittest.main()
