#include "simulation/forecast/missing_contacts.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "simulation/model/derived.h"
#include "simulation/model/index.h"

namespace contact {
namespace {

// The indices of the bodies from left to right.
std::vector<int> InOrder(const Scenario& scenario) {
  std::vector<int> order(scenario.bodies.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int i) { return scenario.bodies[At(i)].position; });
  return order;
}

// What lies between bodies: pairs with a contact, and kNone beside one that has a wall there.
std::set<std::pair<int, int>> Touching(const Scenario& scenario) {
  std::set<std::pair<int, int>> pairs;
  for (const Contact& contact : scenario.contacts) pairs.insert({contact.left, contact.right});
  return pairs;
}

bool CanMeet(const Scenario& scenario, const Contact& pair) {
  const Body& left = scenario.bodies[At(pair.left)];
  const Body& right = scenario.bodies[At(pair.right)];
  if (left.fixed && right.fixed) return false;
  return left.position < right.position && InitialGap(scenario, pair) >= 0;
}

}  // namespace

std::vector<Contact> MissingContacts(const Scenario& scenario) {
  const std::vector<int> order = InOrder(scenario);
  const std::set<std::pair<int, int>> touching = Touching(scenario);
  std::vector<Contact> missing;
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    const int left = order[i];
    const int right = order[i + 1];
    if (touching.contains({left, right}) || touching.contains({right, left}) ||
        touching.contains({left, kNone}) || touching.contains({kNone, right})) {
      continue;
    }
    Contact pair{.name = scenario.bodies[At(left)].name + "-" + scenario.bodies[At(right)].name,
                 .left = left,
                 .right = right,
                 .stiffness = 1};
    if (CanMeet(scenario, pair)) missing.push_back(std::move(pair));
  }
  return missing;
}

}  // namespace contact
