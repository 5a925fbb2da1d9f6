#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "contact/v1/scenario.pb.h"
#include "simulation/laws/damping_law.h"

namespace contact {

// The numbers of DampingLaw are those of the contract, and each of these has a row.
static_assert(v1::Contact::Damping_ARRAYSIZE == kDampingLaws + 1);
static_assert(v1::Contact::ENERGY_RESTITUTION == static_cast<int>(DampingLaw::kEnergyRestitution));
static_assert(v1::Contact::MU == static_cast<int>(DampingLaw::kGiven));
static_assert(v1::Contact::DASHPOT == static_cast<int>(DampingLaw::kDashpot));
static_assert(v1::Contact::FORCE_TABLE == static_cast<int>(DampingLaw::kForceTable));

/// A damping law as clients list it: a row of the table in simulation/laws.
using LawEntry = DampingLawRow;

/// Every law that makes μ from ε, so all but MU, DASHPOT and FORCE_TABLE, in the order of the
/// contract. The rows live as long as the program.
inline const std::vector<LawEntry>& LawCatalogue() {
  static const std::vector<LawEntry> laws = [] {
    std::vector<LawEntry> some;
    std::ranges::copy_if(DampingLaws(), std::back_inserter(some),
                         [](const LawEntry& law) { return !IsGiven(law.law); });
    return some;
  }();
  return laws;
}

/// The value of the contract for a law.
constexpr v1::Contact::Damping DampingOf(DampingLaw law) {
  return static_cast<v1::Contact::Damping>(law);
}

}  // namespace contact
