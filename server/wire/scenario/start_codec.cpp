#include "wire/scenario/start_codec.h"

#include <fmt/format.h>

#include <string>

#include "base/spelling.h"
#include "simulation/model/derived.h"
#include "simulation/model/index.h"
#include "simulation/statics/equilibrium.h"

namespace contact {
namespace {

// What has a velocity presses nothing, so nothing may reach it.
void CheckMoving(const Scenario& scenario, const Rules& rules) {
  const auto moves = [&](int body) {
    return body != kNone && scenario.bodies[At(body)].velocity != 0;
  };
  for (const Contact& contact : scenario.contacts) {
    if (!moves(contact.left) && !moves(contact.right)) continue;
    const double gap = InitialGap(scenario, contact);
    if (gap >= 0) continue;
    rules.Break(
        "start",
        fmt::format("is AT_EQUILIBRIUM, in which contact {}, a side of which has a velocity, "
                    "overlaps: δ = {} m",
                    Quoted(contact.name), -gap),
        "move that body away");
  }
}

}  // namespace

void DecodeStart(const v1::Scenario& message, const Rules& rules, Scenario* scenario) {
  rules.RequireKnown("start", message.start());
  if (message.start() != v1::Scenario::AT_EQUILIBRIUM || !rules.empty()) return;
  const Equilibrium found = FindEquilibrium(*scenario);
  if (!found.unheld.empty()) {
    const std::string& farthest = scenario->bodies[At(found.unheld[0])].name;
    rules.Break("start",
                fmt::format("is AT_EQUILIBRIUM, but no positions were found at which all forces "
                            "balance; in search of them {} goes farthest",
                            Quoted(farthest)),
                "let a contact or support hold it, give it a velocity, or set start: AS_GIVEN");
    return;
  }
  for (std::size_t i = 0; i < scenario->bodies.size(); ++i) {
    scenario->bodies[i].position = found.positions[i];
  }
  scenario->starts_at_rest = true;
  CheckMoving(*scenario, rules);
}

}  // namespace contact
