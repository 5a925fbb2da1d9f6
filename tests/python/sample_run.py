"""Runs without a server: one that is made, and those that a file holds."""

import math
import pathlib

import numpy as np
from contact.v1 import event_pb2, job_pb2, scenario_pb2
from contactsim import Result
from contactsim.recording import Recording
from google.protobuf.internal.decoder import _DecodeVarint32

GOLDEN = pathlib.Path(__file__).parent / "golden"


def sample_run():
    """Ball A hits ball B, which hits the wall W. Times are 0 to 1 s in steps of 1/64 s; each contact has
    one cycle, of half a second."""
    job = job_pb2.Job(name="jobs/sample", state=job_pb2.Job.SUCCEEDED,
                      convergence=job_pb2.Job.FULL, spec_sha256="0123456789abcdef",
                      server_version="0.1.0", server_revision="abc")
    scenario = job.scenario
    scenario.title, scenario.end_time_s = "Two balls & a <wall>", 1.0
    for place, name in enumerate("AB"):
        scenario.bodies.add(name=name, mass_kg=2, radius_m=0.5, position_m=place)
    scenario.contacts.add(name="A-B", between=["A", "B"], stiffness=1e8, restitution=0.8)
    scenario.contacts.add(name="W", between=["B"], stiffness=1e8, restitution=0.8,
                          wall=scenario_pb2.Wall(position_m=1.75, side=scenario_pb2.Wall.RIGHT))
    for start, contact in ((0.0, "A-B"), (0.5, "W")):
        job.cycles.add(contact=contact, number=1, kind=job_pb2.Cycle.COLLISION,
                       end=job_pb2.Cycle.SEPARATION, status=job_pb2.Cycle.CONVERGED,
                       start_time_s=start, turn_time_s=start + 0.25, end_time_s=start + 0.5,
                       restitution_in=0.8, restitution_out=0.79, peak_force_n=100,
                       mu_over_k_s_per_m=0.5)
    time = np.arange(65) / 64
    columns = {"time": ("time", "s", time)}
    for body in "AB":
        columns |= {f"{body}.position": ("position", "m", 2 * time),
                    f"{body}.velocity": ("velocity", "m/s", 2 * time)}
    for contact in ("A-B", "W"):
        columns |= {f"{contact}.{quantity}": (quantity, unit, 100 * np.sin(time))
                    for quantity, unit in (("deformation", "m"), ("deformation_velocity", "m/s"),
                                           ("contact_force", "N"), ("external_force", "N"))}
    columns |= {f"{body}.acceleration": ("acceleration", "m/s^2", 2 + time) for body in "AB"}
    scenario.supports.add(body="A", stiffness_n_per_m=10)
    columns |= {"A-ground.support_force": ("support_force", "N", -20 * time),
                "A-ground.support_energy": ("support_energy", "J", 20 * time * time)}
    columns |= {f"system.{name}": (name, "J", values) for name, values in (
        ("kinetic_energy", 8 - 3 * time), ("contact_energy", time), ("support_energy", time),
        ("dissipated_energy", 4 * time), ("load_work", 3 * time))}
    return run_of(job, columns, [
        event_pb2.Iteration(episode=1, number=number, accepted=number == 2, unknowns=[
            event_pb2.Iteration.Unknown(contact="A-B", number=1, mu=1e6 * (number + 1),
                                        residual=0 if number == 2 else -0.1 / (number + 1))])
        for number in range(3)])


def run_of(job, columns, iterations=()):
    """The result of a job with these columns: quantity, unit and values by name."""
    recording = Recording()
    if columns:
        chunk = event_pb2.FrameChunk(samples=len(columns["time"][2]))
        for name, (quantity, unit, values) in columns.items():
            chunk.columns.add(name=name, quantity=quantity, unit=unit,
                              values=np.asarray(values, "<f8").tobytes())
        recording.add(event_pb2.Event(sequence=1, frame_chunk=chunk))
    for place, iteration in enumerate(iterations):
        recording.add(event_pb2.Event(sequence=2 + place, iteration=iteration))
    return Result(job, recording)


def row_run(contacts, samples=400):
    """A wave through a row of balls, one contact after the other."""
    job = job_pb2.Job(name="jobs/row", state=job_pb2.Job.SUCCEEDED, spec_sha256="00" * 8,
                      server_version="0.1.0", server_revision="abc")
    job.scenario.title = f"A row of {contacts} contacts"
    for ball in range(contacts + 1):
        job.scenario.bodies.add(name=f"B{ball}", mass_kg=1, radius_m=0.5, position_m=ball)
    time = np.linspace(0, 1e-3, samples)
    columns = {"time": ("time", "s", time)}
    for ball in range(contacts + 1):
        moved = np.clip(time * contacts / 1e-3 - ball, 0, 1)
        columns[f"B{ball}.position"] = ("position", "m", ball + 1e-5 * moved)
        columns[f"B{ball}.velocity"] = ("velocity", "m/s", np.exp(-(4 * (moved - 0.5))**2))
    for place in range(contacts):
        name = f"B{place}-B{place + 1}"
        job.scenario.contacts.add(name=name, between=[f"B{place}", f"B{place + 1}"], stiffness=1e8,
                                  restitution=0.9)
        middle, width = 1e-3 * (place + 0.5) / contacts, 2e-3 / (contacts + 3)
        shape = np.maximum(1 - ((time - middle) / width)**2, 0) * math.exp(-place / contacts)
        for quantity, unit, size in (("deformation", "m", 1e-5), ("deformation_velocity", "m/s", 1),
                                     ("contact_force", "N", 300), ("external_force", "N", 150)):
            columns[f"{name}.{quantity}"] = (quantity, unit, size * shape)
        job.cycles.add(contact=name, number=1, status=job_pb2.Cycle.CONVERGED,
                       kind=job_pb2.Cycle.COLLISION, end=job_pb2.Cycle.SEPARATION,
                       start_time_s=max(middle - width, 0), end_time_s=middle + width,
                       turn_time_s=middle, restitution_in=0.9, restitution_out=0.9,
                       peak_force_n=300 * math.exp(-place / contacts), mu_over_k_s_per_m=0.1)
    return run_of(job, columns)


def stored_run(name):
    """A run that `contactctl export -o protobuf` wrote."""
    data = (GOLDEN / f"{name}.pb").read_bytes()
    place, messages = 0, []
    while place < len(data):
        size, place = _DecodeVarint32(data, place)
        messages.append(data[place:place + size])
        place += size
    recording = Recording()
    for message in messages[1:]:
        recording.add(event_pb2.Event.FromString(message))
    return Result(job_pb2.Job.FromString(messages[0]), recording)
