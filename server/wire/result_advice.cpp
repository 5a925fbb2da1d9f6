#include "wire/result_advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "simulation/forecast/missing_contacts.h"
#include "simulation/model/derived.h"
#include "wire/column_bytes.h"

namespace contact {
namespace {

constexpr double kHertz = 1.5;      // Exponent of Hertz's law.
constexpr double kDeep = 0.1;       // δ/R above which Hertz's law does not hold.
constexpr double kDeepest = 1;      // δ/R above which no law of spheres does.
constexpr double kRounding = 1e-9;  // Of places, relative to their size.
constexpr int kColumnsOfABody = 2;  // Position and velocity, after the time.

const Body& BodyAt(const Scenario& scenario, int index) {
  return scenario.bodies[static_cast<std::size_t>(index)];
}

// A cycle that went deep for the radius of a body.
struct Deep {
  const v1::Cycle* cycle = nullptr;
  const Body* body = nullptr;
  bool hertz = false;
  double share() const { return cycle == nullptr ? 0 : cycle->delta_max_m() / body->radius; }
  bool too_deep() const { return share() > (hertz ? kDeep : kDeepest); }
};

// The deepest of the cycles that are too deep of each contact.
std::unordered_map<std::string_view, Deep> DeepCycles(const Scenario& scenario,
                                                      const v1::Job& result) {
  std::unordered_map<std::string_view, Deep> spheres;
  for (const Contact& contact : scenario.contacts) {
    spheres[contact.name] = {.body = SmallerSphere(scenario, contact),
                             .hertz = contact.exponent == kHertz};
  }
  std::unordered_map<std::string_view, Deep> deepest;
  for (const v1::Cycle& cycle : result.cycles()) {
    const auto sphere = spheres.find(cycle.contact());
    if (sphere == spheres.end() || sphere->second.body == nullptr) continue;
    Deep deep = sphere->second;
    deep.cycle = &cycle;
    if (!deep.too_deep()) continue;
    Deep& most = deepest[cycle.contact()];
    if (deep.share() > most.share()) most = deep;
  }
  return deepest;
}

std::string AndOthers(std::size_t others, std::string_view one, std::string_view many) {
  if (others == 0) return "";
  return fmt::format("; and so {} other {}", others, others == 1 ? one : many);
}

void AdviseOnDepth(const Scenario& scenario, const v1::Job& result,
                   std::vector<Violation>* advice) {
  const auto deepest = DeepCycles(scenario, result);
  const Deep* most = nullptr;
  for (const Contact& contact : scenario.contacts) {  // In their order, so that ties are settled.
    const auto found = deepest.find(contact.name);
    if (found == deepest.end()) continue;
    if (most == nullptr || found->second.share() > most->share()) most = &found->second;
  }
  if (most == nullptr) return;
  advice->push_back(
      {fmt::format("contacts[{}]", most->cycle->contact()),
       fmt::format("is {:.3g} m deep in cycle {}, more than {}the radius of {}, {:g} m{}",
                   most->cycle->delta_max_m(), most->cycle->number(),
                   most->hertz ? "a tenth of " : "", most->body->name, most->body->radius,
                   AndOthers(deepest.size() - 1, "contact", "contacts")),
       most->hertz ? "Hertz's law is of deformations far below the radius; is the stiffness right?"
                   : "a sphere ends there; is the stiffness right?"});
}

}  // namespace

Passings::Passings(const Scenario& scenario) {
  for (const Contact& pair : MissingContacts(scenario)) {
    const Body& left = BodyAt(scenario, pair.left);
    const Body& right = BodyAt(scenario, pair.right);
    const double size = std::abs(left.position) + std::abs(right.position);
    const double reach = left.radius + right.radius;
    pairs_.push_back(
        {left.name, right.name, pair.left, pair.right, reach - kRounding * (size + reach)});
  }
}

void Passings::See(const v1::FrameChunk& chunk) {
  for (Pair& pair : pairs_) {
    const int left = 1 + kColumnsOfABody * pair.left;
    const int right = 1 + kColumnsOfABody * pair.right;
    if (std::max(left, right) >= chunk.columns_size()) continue;
    for (std::size_t i = 0; std::cmp_less(i, chunk.samples()) && !pair.met; ++i) {
      See(DoubleAt(chunk.columns(0).values(), i), DoubleAt(chunk.columns(left).values(), i),
          DoubleAt(chunk.columns(right).values(), i), &pair);
    }
  }
}

void Passings::SeeEnd(const v1::Job& result) {
  for (Pair& pair : pairs_) {
    if (std::max(pair.left, pair.right) >= result.final_bodies_size()) continue;
    See(result.summary().time_reached_s(), result.final_bodies(pair.left).position_m(),
        result.final_bodies(pair.right).position_m(), &pair);
  }
}

void Passings::See(double time, double left, double right, Pair* pair) {
  if (!pair->met && right - left < pair->reach) pair->met = time;
}

std::optional<Violation> Passings::Advice() const {
  const Pair* first = nullptr;
  std::size_t met = 0;
  for (const Pair& pair : pairs_) {
    if (!pair.met) continue;
    ++met;
    if (first == nullptr || *pair.met < *first->met) first = &pair;
  }
  if (first == nullptr) return std::nullopt;
  return Violation{
      "contacts",
      fmt::format("have none between {} and {}, which passed into each other by {:.3g} s{}",
                  first->left_name, first->right_name, *first->met,
                  AndOthers(met - 1, "pair", "pairs")),
      fmt::format("add one with between: [{}, {}]", first->left_name, first->right_name)};
}

std::vector<Violation> AdviseOnResult(const Scenario& scenario, const v1::Job& result,
                                      Passings passings) {
  std::vector<Violation> advice;
  if (!scenario.contacts.empty() && result.cycles().empty()) {
    advice.push_back({"contacts", fmt::format("were not touched in {:g} s", scenario.end_time),
                      "see velocities, gaps, the signs of loads, and end_time_s"});
  }
  passings.SeeEnd(result);
  if (std::optional<Violation> passed = passings.Advice()) advice.push_back(*std::move(passed));
  AdviseOnDepth(scenario, result, &advice);
  return advice;
}

}  // namespace contact
