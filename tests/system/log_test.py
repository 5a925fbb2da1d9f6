"""What contactd logs of a job can be found by its name, in both formats."""

import json
import re
import unittest

from contactd import Job, ServerTest, endless, is_cycle, three_ball_chain


class TextLogTest(ServerTest):

    def moves(self, name):
        """(state, reason) of each line about a job."""
        found = re.findall(r"info job=(\S+) state=(\w+) attempt=\d+(?: reason=(\w+))?$",
                           self.server.log(), re.MULTILINE)
        return [(state, reason) for job, state, reason in found if job == name]

    def test_every_move_of_a_job_is_a_line(self):
        done = self.server.run(three_ball_chain()).name
        running = self.server.create(endless()).name
        self.server.wait_until(running, is_cycle)
        self.server.cancel(running)
        self.server.events(running)
        start = [("QUEUED", "WAITING_FOR_WORKER"), ("RUNNING", "")]
        self.assertEqual(self.moves(done), [*start, ("SUCCEEDED", "")])
        self.assertEqual(self.moves(running), [*start, ("CANCELLED", "USER_REQUEST")])


class JsonLogTest(ServerTest):

    flags = ("--log-format=json",)

    def test_every_line_is_an_object(self):
        name = self.server.run(three_ball_chain(title='"}{"level":"error')).name
        self.assertEqual(self.server.get(name).state, Job.SUCCEEDED)
        self.server.terminate()
        lines = [json.loads(line) for line in self.server.log().splitlines()]
        self.assertEqual(sum(line["message"].startswith(f"job={name} ") for line in lines), 3)
        for line in lines:
            self.assertEqual(set(line), {"time", "level", "message"})
            self.assertNotEqual(line["level"], "error")


if __name__ == "__main__":
    unittest.main()
