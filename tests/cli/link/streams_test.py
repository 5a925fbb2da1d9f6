"""contactctl's streams: list --watch, watch --live, artifact."""

import json
import os
import signal
import subprocess
import unittest

from contactd import (PATIENCE_S, Job, ServerTest, endless, is_cycle, job_service_pb2,
                      scenario_pb2, spring_wall, three_ball_chain)

CONTACTCTL = os.environ["CONTACTCTL"]


class StreamsTest(ServerTest):

    def command(self, *arguments):
        return [CONTACTCTL, "--server", f"127.0.0.1:{self.server.port}", *arguments]

    def run_it(self, *arguments, code=0):
        run = subprocess.run(self.command(*arguments), capture_output=True, encoding="utf-8",
                             timeout=PATIENCE_S, check=False)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout, run.stderr

    def start(self, *arguments):
        process = subprocess.Popen(self.command(*arguments), stdout=subprocess.PIPE, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def test_list_watch_tells_each_job_to_its_end(self):
        before = self.server.run(three_ball_chain()).name
        watch = self.start("list", "--watch", "-o", "jsonl")
        self.assertEqual(json.loads(watch.stdout.readline())["name"], before)
        name = self.server.create(three_ball_chain()).name
        states = []
        while "SUCCEEDED" not in states:
            job = json.loads(watch.stdout.readline())
            self.assertEqual(job["name"], name)
            states.append(job["state"])
        self.assertEqual(len(states), len(set(states)), "a state was told twice")
        self.server.delete(name)
        self.assertEqual(json.loads(watch.stdout.readline()), {"gone": [name]})
        watch.send_signal(signal.SIGINT)
        self.assertEqual(watch.wait(PATIENCE_S), 130)

    def test_list_watch_ends_at_its_timeout(self):
        self.server.run(three_ball_chain(), labels={"study": "a"})
        out, _ = self.run_it("list", "--watch", "--label", "study=a", "--timeout", "1s", code=5)
        self.assertIn("SUCCEEDED", out)
        out, _ = self.run_it("list", "--watch", "--label", "study=b", "--timeout", "1s", code=5)
        self.assertEqual(out, "")

    def test_watch_live_begins_with_what_happens_now(self):
        name = self.server.create(endless()).name
        self.server.wait_until(name, is_cycle)
        last = self.server.get(name).last_sequence
        watch = self.start("watch", name, "--live", "--kinds", "cycle", "-o", "jsonl")
        self.assertGreaterEqual(int(json.loads(watch.stdout.readline())["sequence"]), last)

    def test_frame_interval_leaves_out_all_chunks_but_the_newest(self):
        scenario = spring_wall(0.4)
        scenario.output.sample_interval_s = 1e-4
        name = self.server.run(scenario).name
        def chunks(*flags):
            lines, _ = self.run_it("watch", name, "--kinds", "frame_chunk,gap", "-o", "jsonl",
                                   *flags)
            events = [json.loads(line) for line in lines.splitlines()]
            return ([e["sequence"] for e in events if "frame_chunk" in e],
                    sum("gap" in e for e in events))
        every, gaps = chunks()
        self.assertGreater(len(every), 3)
        self.assertEqual(gaps, 0)
        few, gaps = chunks("--min-frame-interval", "1h")
        self.assertLess(len(few), len(every))
        self.assertEqual(few[-1], every[-1])
        self.assertGreater(gaps, 0)
        _, told = self.run_it("watch", name, "--min-frame-interval", "often", code=2)
        self.assertIn("often", told)

    def test_artifacts_are_listed_and_fetched(self):
        name = self.server.run(three_ball_chain()).name
        self.assertEqual(self.run_it("artifact", "list", name)[0], "cycles.csv\ngroups.csv\ntrajectory.csv\n")
        path = self.folder / "cycles.csv"
        _, told = self.run_it("artifact", "get", name, "cycles.csv", "-f", str(path))
        self.assertIn(f"{path.stat().st_size}", told.replace(",", "").replace(" ", ""))
        lines = path.read_text().splitlines()
        self.assertTrue(lines[0].startswith("contact,number [1],kind,"))
        self.assertEqual([line.split(",")[0] for line in lines[1:]], ["B1-B2", "B2-B3"])
        _, told = self.run_it("artifact", "get", name, "none.csv", "-f", str(path), code=6)
        self.assertIn("ARTIFACT_NOT_FOUND", told)
        self.assertEqual(list(self.folder.glob("*.part")), [])

    def test_cells_of_a_sweep_keep_their_trajectories(self):
        sweep = scenario_pb2.Sweep(base=three_ball_chain(), keep_trajectories=[1])
        sweep.axes.add(field="contacts[0].restitution", values=[0.7, 0.8])
        job = self.server.stub.CreateJob(
            job_service_pb2.CreateJobRequest(job=Job(sweep=sweep)), timeout=PATIENCE_S).name
        self.server.events(job)
        name = "cells/1/trajectory.csv"
        self.assertEqual(self.run_it("artifact", "list", job)[0], name + "\n")
        kept, alone = self.folder / "kept.csv", self.folder / "alone.csv"
        self.run_it("artifact", "get", job, name, "-f", str(kept))
        same = self.server.run(three_ball_chain()).name
        self.run_it("artifact", "get", same, "trajectory.csv", "-f", str(alone))
        self.assertEqual(kept.read_bytes(), alone.read_bytes())


if __name__ == "__main__":
    unittest.main()
