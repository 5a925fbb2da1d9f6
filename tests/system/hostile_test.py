"""Every number of a scenario, made hostile: the rules are those that the contract states."""

import math
import struct
import unittest

import grpc
from contact.v1 import field_rules_pb2, job_service_pb2, motion_pb2, scenario_pb2
from contactd import PATIENCE_S, Job, ServerTest, details_of, three_ball_chain
from google.protobuf.descriptor import FieldDescriptor

DENORMAL = struct.unpack("<d", struct.pack("<Q", 1))[0]
LARGEST = struct.unpack("<d", struct.pack("<Q", 0x7FEFFFFFFFFFFFFF))[0]
DOUBLES = (math.nan, math.inf, -math.inf, -0.0, DENORMAL, LARGEST, -LARGEST, -1.0, 0.0, 1e300)
INTEGERS = {FieldDescriptor.CPPTYPE_INT32: (2**31 - 1, -2**31, -1, 0),
            FieldDescriptor.CPPTYPE_INT64: (2**63 - 1, -2**63, -1, 0)}


def everything():
    """A good scenario that has every number at least once."""
    body, contact, load = scenario_pb2.Body, scenario_pb2.Contact, scenario_pb2.Load
    motion = motion_pb2.Motion
    steel = scenario_pb2.Material(youngs_modulus_pa=2e11, poisson_ratio=0.3)
    wall = scenario_pb2.Wall(position_m=3.0, side=scenario_pb2.Wall.RIGHT, material=steel)
    return scenario_pb2.Scenario(
        bodies=[
            body(name="A", mass_kg=0.5, radius_m=0.05, position_m=0.0, velocity_m_per_s=0.2,
                 material=steel),
            body(name="B", mass_kg=0.5, radius_m=0.05, position_m=1.0, material=steel),
            body(name="C", density_kg_per_m3=7800.0, radius_m=0.05, position_m=2.0,
                 material=steel),
            body(name="D", mass_kg=1.0, next_to="C", gap_m=10.0),
            body(name="E", motion=motion(uniform=motion.Uniform(velocity_m_per_s=1.0))),
            body(name="F", motion=motion(sine=motion.Sine(
                amplitude_m=1.0, angular_frequency_rad_per_s=1.0, phase_rad=0.1))),
            body(name="G", motion=motion(position_table=motion.PositionTable(points=[
                motion.PositionTable.Point(time_s=0.0, position_m=0.0),
                motion.PositionTable.Point(time_s=1e-3, position_m=1.0)]))),
            body(name="H", motion=motion(velocity_table=motion.VelocityTable(points=[
                motion.VelocityTable.Point(time_s=0.0, velocity_m_per_s=0.0),
                motion.VelocityTable.Point(time_s=1e-3, velocity_m_per_s=1.0)]))),
            body(name="I", motion=motion(acceleration_table=motion.AccelerationTable(
                velocity_m_per_s=1.0, points=[
                    motion.AccelerationTable.Point(time_s=0.0, acceleration_m_per_s2=0.0),
                    motion.AccelerationTable.Point(time_s=1e-3, acceleration_m_per_s2=1.0)]))),
            body(name="J", motion=motion(position_table=motion.PositionTable(
                times_s=[0.0, 1e-3], positions_m=[0.0, 1.0]))),
            body(name="K", motion=motion(velocity_table=motion.VelocityTable(
                times_s=[0.0, 1e-3], velocities_m_per_s=[0.0, 1.0]))),
            body(name="L", motion=motion(acceleration_table=motion.AccelerationTable(
                times_s=[0.0, 1e-3], accelerations_m_per_s2=[0.0, 1.0]))),
        ],
        contacts=[
            contact(between=["A", "B"], restitution=0.8),
            contact(between=["B", "C"], stiffness=1e8, exponent=1.5, damping=contact.MU, mu=1e6),
            contact(between=["C"], wall=wall, restitution=0.8, damping=contact.HUNT_CROSSLEY,
                    reference_velocity_m_per_s=0.1),
            contact(between=["D"], wall=scenario_pb2.Wall(position_m=12.0, motion=motion(
                        sine=motion.Sine(amplitude_m=0.1, frequency_hz=1.0))),
                    clearance_m=1.0, stiffness=1e8, restitution=0.8),
        ],
        supports=[scenario_pb2.Support(body="A", stiffness_n_per_m=1e3, damping_n_s_per_m=1.0,
                                       rest_position_m=0.1, higher_stiffness=[1.0, 1e3]),
                  scenario_pb2.Support(body="B", stiffness_n_per_m=1e3, rest_position_m=1.0,
                                       slip_force_n=10.0)],
        loads=[
            load(body="A", constant=load.Constant(force_n=1.0)),
            load(body="A", sine=load.Sine(amplitude_n=1.0, angular_frequency_rad_per_s=10.0,
                                          phase_rad=0.1)),
            load(body="A", sine=load.Sine(amplitude_n=1.0, frequency_hz=10.0)),
            load(gravity=load.Gravity(acceleration_m_per_s2=1.0)),
            load(body="A", step=load.Step(force_n=1.0, start_time_s=1e-3)),
            load(body="A", rectangular_pulse=load.RectangularPulse(
                force_n=1.0, start_time_s=1e-3, duration_s=1e-3)),
            load(body="A", half_sine_pulse=load.HalfSinePulse(
                amplitude_n=1.0, start_time_s=1e-3, duration_s=1e-3)),
            load(body="A", table=load.Table(points=[
                load.Table.Point(time_s=0.0, force_n=0.0),
                load.Table.Point(time_s=1e-3, force_n=1.0)])),
            load(body="A", table=load.Table(times_s=[0.0, 1e-3], forces_n=[0.0, 1.0],
                                            period_s=2e-3)),
        ],
        solver=scenario_pb2.Solver(
            method=scenario_pb2.Solver.RK4, step_s=1e-6, relative_tolerance=1e-11,
            restitution_tolerance=1e-8, max_iterations=50, settled_fraction=1e-9,
            max_steps=10**8),
        output=scenario_pb2.Output(sample_interval_s=1e-4),
        end_time_s=1e-2)


def numbers(message, path=""):
    """(message, field, path) of every number in it; of what is repeated, of each."""
    for field in message.DESCRIPTOR.fields:
        here = f"{path}.{field.name}"
        repeated = field.label == field.LABEL_REPEATED
        if field.message_type:
            if repeated:
                for i, part in enumerate(getattr(message, field.name)):
                    yield from numbers(part, f"{here}[{i}]")
            elif message.HasField(field.name):
                yield from numbers(getattr(message, field.name), here)
        elif field.cpp_type == field.CPPTYPE_DOUBLE or field.cpp_type in INTEGERS:
            for i in range(len(getattr(message, field.name)) if repeated else 0):
                yield message, field, f"{here}[{i}]"
            if not repeated:
                yield message, field, here


def put(message, field, path, value):
    """Gives one of the numbers, as they are named above, another value."""
    if field.label == field.LABEL_REPEATED:
        getattr(message, field.name)[int(path.rpartition("[")[2][:-1])] = value
    else:
        setattr(message, field.name, value)


def allows(field, value):
    """True if the rules of the contract allow the value; every number must be finite."""
    rule = field.GetOptions().Extensions[field_rules_pb2.rule]
    low = rule.WhichOneof("low")
    return (math.isfinite(value) and
            (low != "min" or value >= rule.min) and
            (low != "above" or value > rule.above) and
            (not rule.HasField("max") or value <= rule.max))


def has_range(field):
    rule = field.GetOptions().Extensions[field_rules_pb2.rule]
    return rule.WhichOneof("low") is not None


class HostileValuesTest(ServerTest):

    def violations(self, scenario):
        """Fields that the server finds fault with; none: it takes the scenario."""
        request = job_service_pb2.CreateJobRequest(job=Job(scenario=scenario), validate_only=True)
        try:
            self.server.stub.CreateJob(request, timeout=PATIENCE_S)
            return []
        except grpc.RpcError as error:
            self.assertEqual(error.code(), grpc.StatusCode.INVALID_ARGUMENT)
            details = details_of(error)
            self.assertEqual(details["ErrorInfo"].reason, "SCENARIO_INVALID")
            return [violation.field for violation in details["BadRequest"].field_violations]

    def test_every_number_is_checked_as_the_contract_says(self):
        self.assertEqual(self.violations(everything()), [])
        ranges = {field.full_name for _, field, _ in numbers(everything()) if has_range(field)}
        cases = refused = 0
        for position, (_, field, path) in enumerate(list(numbers(everything()))):
            for value in INTEGERS.get(field.cpp_type, DOUBLES):
                scenario = everything()
                message, _, _ = list(numbers(scenario))[position]
                put(message, field, path, value)
                found = self.violations(scenario)
                with self.subTest(field=path, value=value):
                    if not allows(field, value):
                        self.assertIn(f"scenario{path}", found)
                    for violation in found:  # Refused for its neighbours, it is a path too.
                        self.assertTrue(violation.startswith("scenario."), violation)
                cases += 1
                refused += bool(found)
        print(f"{cases} cases, {refused} of them refused; {len(ranges)} ranges in the contract")
        self.assertGreater(cases, 200)
        self.assertGreater(refused, cases / 2)
        self.assertGreater(len(ranges), 25)
        self.assertEqual(list(self.server.list().jobs), [])
        self.assertEqual(self.server.run(three_ball_chain()).state, Job.SUCCEEDED)


if __name__ == "__main__":
    unittest.main()
