// Kinds of seeded random scenarios that look like machines: they rest and are disturbed, touch at
// one instant, stand beside stiff springs, creep, and end inside a contact.
#pragma once

#include <ostream>
#include <span>
#include <string_view>

#include "simulation/kinds/maker.h"

namespace contact::testing {

/// A kind of scenario: fills the scenario of a maker.
struct Machine {
  std::string_view name;
  void (*build)(Maker&);
  std::string_view shows;  ///< What it is, in a line.
};

inline std::ostream& operator<<(std::ostream& out, const Machine& machine) {
  return out << machine.name;
}

/// Every kind. Order and names do not change what a kind rolls.
std::span<const Machine> Machines();

/// The scenario of a kind and a seed; it obeys the rules of the contract.
Scenario Roll(const Machine& machine, unsigned seed);

// rest.cpp: bodies that rest, and are disturbed.
void Placed(Maker& m);
void Stack(Maker& m);
void Column(Maker& m);
void Bounce(Maker& m);
void Late(Maker& m);
void Valve(Maker& m);
void Press(Maker& m);
// driven.cpp: bodies on springs, tables and pistons.
void Damper(Maker& m);
void Joined(Maker& m);
void Shaken(Maker& m);
void Piston(Maker& m);
void Pulses(Maker& m);
// moved.cpp: what moves as given, has play, or is pressed when the run begins.
void Table(Maker& m);
void Rattle(Maker& m);
void Moved(Maker& m);
void Clamped(Maker& m);
// blows.cpp: blows of extreme restitution, exponent, mass and size.
void Plastic(Maker& m);
void Elastic(Maker& m);
void Exponents(Maker& m);
void Laws(Maker& m);
void Ratios(Maker& m);
void Sizes(Maker& m);
void Clipped(Maker& m);
// meetings.cpp: who meets whom, and when.
void Box(Maker& m);
void Gas(Maker& m);
void Held(Maker& m);
void Grazing(Maker& m);
void Ring(Maker& m);
void Ties(Maker& m);
void NearGaps(Maker& m);
void NearSpeeds(Maker& m);

}  // namespace contact::testing
