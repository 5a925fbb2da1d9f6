#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/settings/settings.h"
#include "wire/scenario/law_catalogue.h"

namespace contact::cli {

/// What a law gives back of the restitution asked for, in an isolated collision.
struct LawPoint {
  const LawEntry* law = nullptr;
  double requested = 0;
  double delivered = 0;
  std::string_view method;  ///< `closed form` or `simulation`.

  double miss() const { return delivered / requested - 1; }
};

/// The law with this name; `hunt-crossley` is as good as HUNT_CROSSLEY. Throws Failure (kUsage),
/// which suggests the nearest one.
const LawEntry& FindLaw(const std::string& text);

/// The scenario in which each of these points is a ball that hits a wall of its own, one after
/// the other. Contact i of its ledger is point i.
v1::Scenario CollisionsOf(const std::vector<LawPoint>& points);

/// Fills `delivered` of points without a closed form from a run on the server, which is removed
/// afterwards. Throws Failure.
void Simulate(std::vector<LawPoint>* points, const Settings& settings);

}  // namespace contact::cli
