"""Starts contactd for a test and talks to it as any client would."""

import atexit
import collections.abc
import functools
import os
import pathlib
import re
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import uuid

import grpc
from contact.v1 import job_pb2, job_service_pb2, job_service_pb2_grpc, scenario_pb2
from google.protobuf import duration_pb2
from google.rpc import error_details_pb2, status_pb2

BINARY = os.environ["CONTACTD"]
# With `postgres` every data directory has its jobs in a PostgreSQL database instead.
STORE = os.environ.get("CONTACT_STORE", "")
PATIENCE_S = 60  # More than anything here takes, also with sanitizers on a busy machine.

Job = job_pb2.Job
ENDED = (Job.SUCCEEDED, Job.FAILED, Job.CANCELLED)


@functools.cache
def cluster():
    """The PostgreSQL server of this test program; POSTGRES_SETTINGS is for those who measure."""
    sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "testing"))
    import postgres
    settings = os.environ.get("POSTGRES_SETTINGS", "").split()
    started = postgres.Cluster(**dict(setting.split("=", 1) for setting in settings))
    atexit.register(started.stop)
    return started


@functools.cache
def database_of(data_dir):
    """The address of the database that stands for the directory."""
    return cluster().create(f"data_{uuid.uuid4().hex}")


class Server:
    """One contactd process after the other on the same data directory.

    Listens on a free port of this host, unless a flag says where."""

    def __init__(self, data_dir, *flags, environment=None, store=STORE):
        self.data_dir = pathlib.Path(data_dir)
        self.flags = flags
        if store == "postgres":
            self.flags += (f"--store={database_of(self.data_dir)}",)
        self.environment = environment  # None: that of the test.
        self.log_path = self.data_dir.parent / "contactd.log"
        self.process = None
        self.channel = None

    def start(self, **popen):
        told = any(flag.startswith("--listen=") for flag in self.flags)
        listen = [] if told else ["--listen=127.0.0.1:0"]
        with open(self.log_path, "ab") as log:
            self.process = subprocess.Popen(
                [BINARY, *listen, f"--data-dir={self.data_dir}", *self.flags],
                stdout=subprocess.PIPE, stderr=log, text=True, env=self.environment, **popen)
        ready, _, _ = select.select([self.process.stdout], [], [], PATIENCE_S)
        self.greeting = self.process.stdout.readline() if ready else ""
        match = re.search(r"listening on (127\.0\.0\.1:(\d+)|unix:[^,]+)", self.greeting)
        if not match:
            self.kill()
            raise RuntimeError(f"contactd said {self.greeting!r} and logged {self.log()}")
        self.port = int(match[2] or 0)
        self.channel = grpc.insecure_channel(match[1])
        self.stub = job_service_pb2_grpc.JobServiceStub(self.channel)
        return self

    def log(self):
        return self.log_path.read_text()

    @property
    def address(self):
        """HOST:PORT of a running server."""
        return f"127.0.0.1:{self.port}"

    def kill(self):
        """As a power cut does, as far as a process can see."""
        self._end(signal.SIGKILL)

    def terminate(self):
        """Asks it to end; returns its exit code and how long it took, in seconds."""
        start = time.monotonic()
        return self._end(signal.SIGTERM), time.monotonic() - start

    def _end(self, how):
        if self.channel:
            self.channel.close()
            self.channel = None
        if self.process is None:
            return None
        self.process.send_signal(how)
        code = self.process.wait(PATIENCE_S)
        self.process.stdout.close()
        self.process = None
        return code

    # The calls, with a deadline.

    def create(self, scenario, **request):
        labels = request.pop("labels", {})
        job = Job(scenario=scenario, labels=labels)
        return self.stub.CreateJob(
            job_service_pb2.CreateJobRequest(job=job, **request), timeout=PATIENCE_S)

    def get(self, name):
        return self.stub.GetJob(job_service_pb2.GetJobRequest(name=name), timeout=PATIENCE_S)

    def list(self, **request):
        return self.stub.ListJobs(
            job_service_pb2.ListJobsRequest(**request), timeout=PATIENCE_S)

    def cancel(self, name):
        return self.stub.CancelJob(
            job_service_pb2.CancelJobRequest(name=name), timeout=PATIENCE_S)

    def delete(self, name):
        return self.stub.DeleteJob(
            job_service_pb2.DeleteJobRequest(name=name), timeout=PATIENCE_S)

    def watch(self, name, **request):
        return self.stub.WatchJob(
            job_service_pb2.WatchJobRequest(name=name, **request), timeout=PATIENCE_S)

    def events(self, name, **request):
        """All events until the watch ends with OK."""
        return [event for message in self.watch(name, **request) for event in message.events]

    def run(self, scenario, **request):
        """Submits, watches to the end, returns the ended job."""
        name = self.create(scenario, **request).name
        self.events(name, kinds=["state_changed"])
        job = self.get(name)
        if job.state not in ENDED:
            raise AssertionError(f"the end of {name} was told, and it is {Job.State.Name(job.state)}")
        return job

    def wait_until(self, name, wanted):
        """Watches until an event for which `wanted` is true has come; returns the events."""
        seen = []
        call = self.watch(name)
        for message in call:
            for event in message.events:
                seen.append(event)
                if wanted(event):
                    call.cancel()
                    return seen
        raise AssertionError(f"{name} ended without it: {self.get(name)}")


class ServerTest(unittest.TestCase):
    """A test with a server of its own, `self.server`, in a folder of its own, `self.folder`."""

    flags = ()

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="contactd-test-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.server = self.make_server()
        self.addCleanup(self.server.kill)
        self.server.start()

    def make_server(self):
        return Server(self.folder / "data", *self.flags)

    def assertFails(self, code, reason, call, *arguments, **keywords):
        """Checks code and reason of a call that must fail; returns its google.rpc details, and what
        it says."""
        with self.assertRaises(grpc.RpcError) as caught:
            answer = call(*arguments, **keywords)
            if isinstance(answer, collections.abc.Iterable):
                list(answer)  # A stream fails when it is read.
        self.assertEqual(caught.exception.code(), code, caught.exception)
        details = details_of(caught.exception)
        self.assertEqual(details["ErrorInfo"].domain, "contact")
        self.assertEqual(details["ErrorInfo"].reason, reason)
        return details | {"message": caught.exception.details()}

    def assertWholeLog(self, events, after=0):
        """Checks that no stored event is missing or doubled, and that a final state ends them."""
        sequences = [event.sequence for event in events if stored(event)]
        self.assertEqual(sequences, list(range(after + 1, after + 1 + len(sequences))))
        self.assertEqual(events[-1].WhichOneof("payload"), "state_changed")
        self.assertIn(events[-1].state_changed.state, ENDED)


def wait_for(condition, limit=PATIENCE_S):
    """Seconds until it held."""
    start = time.monotonic()
    while not condition():
        if time.monotonic() - start > limit:
            raise AssertionError(f"not so after {limit} s")
        time.sleep(0.02)
    return time.monotonic() - start


def stored(event):
    return event.WhichOneof("payload") not in ("progress", "bookmark", "gap")


def to_bytes(message):
    """For comparing: a NaN does not equal itself, its bytes do."""
    return message.SerializeToString(deterministic=True)


def details_of(error):
    """The google.rpc details of a failed call by the name of their type."""
    trailer = dict(error.trailing_metadata())["grpc-status-details-bin"]
    status = status_pb2.Status.FromString(trailer)
    details = {}
    for packed in status.details:
        name = packed.type_url.rsplit(".", 1)[-1]
        details[name] = getattr(error_details_pb2, name).FromString(packed.value)
    return details


def seconds(value):
    return duration_pb2.Duration(seconds=int(value), nanos=int(value % 1 * 1e9))


# Scenarios.


def three_ball_chain(**changes):
    """The paper's section 6.1."""
    body, contact = scenario_pb2.Body, scenario_pb2.Contact
    scenario = scenario_pb2.Scenario(
        title="Triple-ball chain",
        bodies=[
            body(name="B1", mass_kg=0.5, radius_m=0.05, position_m=0.0, velocity_m_per_s=0.2),
            body(name="B2", mass_kg=0.5, radius_m=0.05, position_m=0.1),
            body(name="B3", mass_kg=0.5, radius_m=0.05, position_m=0.2),
        ],
        contacts=[
            contact(name="B1-B2", between=["B1", "B2"], stiffness=1e8, restitution=0.8),
            contact(name="B2-B3", between=["B2", "B3"], stiffness=1e8, restitution=0.7),
        ],
        solver=scenario_pb2.Solver(restitution_tolerance=1e-8),
        end_time_s=4e-3)
    scenario.MergeFrom(scenario_pb2.Scenario(**changes))
    return scenario


def spring_wall(end_time_s):
    """The paper's section 6.2: a driven ball that hits a wall again and again, for ever."""
    contact, load = scenario_pb2.Contact, scenario_pb2.Load
    wall = scenario_pb2.Wall(position_m=0.048, side=scenario_pb2.Wall.RIGHT)
    return scenario_pb2.Scenario(
        bodies=[scenario_pb2.Body(name="ball", mass_kg=0.5, radius_m=0.05, position_m=-0.01)],
        contacts=[contact(name="ball-wall", between=["ball"], wall=wall, stiffness=1.8e7,
                          restitution=0.9)],
        supports=[scenario_pb2.Support(body="ball", stiffness_n_per_m=1e6,
                                       damping_n_s_per_m=100.0)],
        loads=[
            load(body="ball", constant=load.Constant(force_n=500.0)),
            load(body="ball", sine=load.Sine(amplitude_n=250.0,
                                             angular_frequency_rad_per_s=2000.0)),
        ],
        end_time_s=end_time_s)


def two_balls_and_a_wall(**solver):
    """A ball pushed against a wall by a heavier one, so that the first cycle there has no μ."""
    body, contact = scenario_pb2.Body, scenario_pb2.Contact
    wall = scenario_pb2.Wall(position_m=0.1506, side=scenario_pb2.Wall.RIGHT)
    return scenario_pb2.Scenario(
        title="Two balls and a wall",
        bodies=[
            body(name="B1", mass_kg=3.0433, radius_m=0.05, velocity_m_per_s=1.535),
            body(name="B2", mass_kg=1.0897, radius_m=0.05, position_m=0.1),
        ],
        contacts=[
            contact(name="pair", between=["B1", "B2"], stiffness=5744379, restitution=0.805),
            contact(name="wall", between=["B2"], wall=wall, stiffness=184680686.4,
                    restitution=0.678),
        ],
        solver=scenario_pb2.Solver(**solver),
        end_time_s=0.02)


def endless():
    """A run that makes cycles for longer than any test waits."""
    scenario = spring_wall(end_time_s=1e5)
    scenario.output.sample_interval_s = 0.1
    scenario.solver.max_steps = 10**12
    return scenario


def endless_and_slow():
    """The same at about a hundred events a second: its ledger stays small."""
    scenario = endless()
    scenario.solver.method = scenario_pb2.Solver.RK4
    scenario.solver.step_s = 1e-7
    return scenario


def is_cycle(event):
    return event.WhichOneof("payload") == "cycle"
