#pragma once

#include "simulation/model/scenario.h"

namespace contact {

/// Two bodies and a wall, for codecs that need the names of contacts.
inline Scenario TwoContacts() {
  Scenario scenario;
  scenario.bodies = {{.name = "a"}, {.name = "b"}};
  scenario.contacts = {{.name = "a-b", .left = 0, .right = 1, .stiffness = 1},
                       {.name = "b-wall", .left = 1, .stiffness = 4}};
  scenario.end_time = 8;
  return scenario;
}

}  // namespace contact
