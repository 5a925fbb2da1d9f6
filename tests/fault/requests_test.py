"""A request that is repeated makes one job, whoever repeats it and whatever dies meanwhile."""

import unittest

import grpc
from contactd import spring_wall, three_ball_chain
from fault import *

CLIENTS, RETRIES = 16, 63  # 1,008 in all.


class DuplicateTest(FaultTest):
    """F14."""

    def test_a_thousand_retries_make_one_job(self):
        chain = three_ball_chain()
        golden = self.golden(chain)

        def keep_asking():
            for _ in range(RETRIES):
                patient(lambda: submit(self.server, self.history, chain, "same"))

        with clients() as start:
            for _ in range(CLIENTS):
                start(keep_asking)
            for calls in 1, 500:
                wait_for(lambda calls=calls: len(self.history.calls) > calls)
                self.server.kill()
                self.server.start()
        self.assertFails(grpc.StatusCode.ALREADY_EXISTS, "REQUEST_ID_REUSED", submit,
                         self.server, self.history, spring_wall(0.1), "same")
        final = self.assertPromises(self.server, golden=golden)
        self.assertEqual(len(final), 1)
        unknown = sum(call.outcome == "unknown" for call in self.history.calls)
        self.figures |= dict(calls=len(self.history.calls), unknown=unknown, jobs=len(final))


if __name__ == "__main__":
    unittest.main()
