#include "simulation/kinds/machines.h"

namespace contact::testing {
namespace {

constexpr Machine kMachines[] = {
    {"placed", Placed, "one to four balls put on a floor, under one load more than their weight"},
    {"stack", Stack, "balls that rest on each other and are hit by one that falls"},
    {"settling", Column, "balls that fall on a floor and on each other, and settle"},
    {"zeno", Bounce, "a ball bounces to rest, then a second one falls on it"},
    {"late", Late, "a pressed ball gets a pulse or a step after it has come to rest"},
    {"valve", Valve, "a valve on its seat under a spring, opened by pulses of pressure"},
    {"press", Press, "a pin pressed against a stop by a ramp, held, released by a ramp"},
    {"damper", Damper, "a mass between two stops of a body that is shaken on a spring"},
    {"springs", Joined, "bodies joined by stiff springs fall, are struck or push"},
    {"shaken", Shaken, "a ball on a table that goes up and down"},
    {"piston", Piston, "a driven piston against balls before a wall"},
    {"pulses", Pulses, "a row of balls, perhaps at a wall, under tables and pulses"},
    {"plastic", Plastic, "a ball thrown on a floor, restitution 0.002 to 0.1, for seconds"},
    {"elastic", Elastic, "rows with restitution 1 beside 0.01 to 0.1"},
    {"exponents", Exponents, "rows with exponents 1 to 4"},
    {"laws", Laws, "rows in which named laws stand beside the iterated one"},
    {"ratios", Ratios, "rows with masses and stiffnesses up to 1e6 apart"},
    {"sizes", Sizes, "spheres of real materials, micrometres to 100 m"},
    {"clip", Clipped, "strongly damped, loaded contacts that may not pull"},
    {"box", Box, "one or two balls between two walls"},
    {"gas", Gas, "eight to twenty balls between two walls"},
    {"fixed", Held, "balls between bodies that never move"},
    {"grazing", Grazing, "touches of almost no speed, and balls pulled apart"},
    {"ring", Ring, "contacts that do not stand in a row"},
    {"ties", Ties, "two touches at one instant"},
    {"neargaps", NearGaps, "two touches 1e-12 to 1e-4 of a gap apart"},
    {"table", Table, "balls on a table that moves as a sine"},
    {"rattle", Rattle, "a ball with play in a slot that is shaken, swings or stands"},
    {"moved", Moved, "a row that a stop pushes as a table of its velocity says"},
    {"clamped", Clamped, "a row clamped between walls, at equilibrium until a load comes"},
    {"nearspeeds", NearSpeeds, "touching balls with speeds 1e-11 to 1e-7 apart"},
};

}  // namespace

std::span<const Machine> Machines() { return kMachines; }

Scenario Roll(const Machine& machine, unsigned seed) {
  Maker maker(machine.name, seed);
  maker.s.solver.max_steps = 3'000'000;  // Some seconds; what needs more is a fault.
  machine.build(maker);
  return maker.s;
}

}  // namespace contact::testing
