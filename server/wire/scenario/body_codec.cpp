#include "wire/scenario/body_codec.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>
#include <unordered_map>
#include <utility>

#include "base/spelling.h"
#include "wire/scenario/material_codec.h"
#include "wire/scenario/motion_codec.h"

namespace contact {
namespace {

double SphereMass(double radius, double density) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius * density;
}

double MassFromDensity(const v1::Body& message, const Rules& rules) {
  const double density =
      rules.Check<v1::Body>(v1::Body::kDensityKgPerM3FieldNumber, message.density_kg_per_m3());
  if (message.has_mass_kg()) {
    rules.Break("density_kg_per_m3", "is given beside mass_kg", "give one of the two");
  }
  if (message.radius_m() == 0) {
    rules.Break("radius_m", message.has_radius_m() ? "is 0, which gives no mass" : "is missing",
                "density_kg_per_m3 needs a radius_m > 0");
    return 0;
  }
  const double mass = SphereMass(message.radius_m(), density);
  const Range& masses = NumberOf<v1::Body>(v1::Body::kMassKgFieldNumber).range;
  const Range& densities = NumberOf<v1::Body>(v1::Body::kDensityKgPerM3FieldNumber).range;
  const Range& radii = NumberOf<v1::Body>(v1::Body::kRadiusMFieldNumber).range;
  const bool inputs_right =
      densities.Contains(density) && radii.Contains(message.radius_m()) && !message.has_mass_kg();
  if (inputs_right && !masses.Contains(mass)) {
    rules.Break("density_kg_per_m3",
                fmt::format("gives a mass of {} kg; must be {}", mass, masses.text));
  }
  return mass;
}

double DecodeMass(const v1::Body& message, const Rules& rules) {
  if (message.has_mass_kg()) rules.Check<v1::Body>(v1::Body::kMassKgFieldNumber, message.mass_kg());
  if (message.has_density_kg_per_m3()) return MassFromDensity(message, rules);
  if (message.has_mass_kg()) return message.mass_kg();
  if (!message.fixed() && !message.has_motion()) {
    rules.Break("mass_kg", "is missing", "give mass_kg, or density_kg_per_m3 and radius_m");
  }
  return Body{}.mass;
}

// Places of bodies by name.
using BodyIndex = std::unordered_map<std::string_view, std::size_t>;

void CheckDriven(const v1::Body& message, const Rules& rules) {
  if (message.fixed()) rules.Break("fixed", "is true beside motion", "give one of the two");
  if (message.velocity_m_per_s() != 0) {
    rules.Break("velocity_m_per_s", "is given beside motion, which tells the velocity",
                "remove it");
  }
}

Body DecodeBody(const v1::Body& message, const Rules& rules) {
  if (message.name().empty()) {
    rules.Break("name", "is missing", "contacts refer to the body by its name");
  } else if (!IsName(message.name())) {
    BreakName(message.name(), rules);
  }
  Body body{.name = message.name(), .fixed = message.fixed() || message.has_motion()};
  body.mass = DecodeMass(message, rules);
  using Field = v1::Body;
  body.radius = rules.Check<Field>(Field::kRadiusMFieldNumber, message.radius_m());
  body.position = rules.Check<Field>(Field::kPositionMFieldNumber, message.position_m());
  body.velocity = rules.Check<Field>(Field::kVelocityMPerSFieldNumber, message.velocity_m_per_s());
  if (message.has_material()) CheckMaterial(message.material(), rules.In("material"));
  if (message.has_motion()) {
    CheckDriven(message, rules);
  } else if (body.fixed && body.velocity != 0) {
    rules.Break("velocity_m_per_s", fmt::format("is {}; must be 0 for a fixed body", body.velocity),
                "motion: {uniform: {velocity_m_per_s: …}} moves it");
  }
  return body;
}

// The position of a body beside one that comes before it.
double PositionNextTo(const v1::Body& message, const Body& body, const std::vector<Body>& before,
                      const BodyIndex& index, const Rules& rules) {
  const double gap = rules.Check<v1::Body>(v1::Body::kGapMFieldNumber, message.gap_m());
  if (message.position_m() != 0) {
    rules.Break("position_m", "is given beside next_to", "give one of the two");
  }
  const auto found = index.find(message.next_to());
  if (found == index.end()) {
    rules.Break("next_to",
                fmt::format("is {}, which no body before is called", Quoted(message.next_to())),
                "name a body that comes earlier in the list");
    return body.position;
  }
  const Body& other = before[found->second];
  return other.position + other.radius + body.radius + gap;
}

std::size_t LongestName() {
  static const int longest = RuleOf<v1::Body>(v1::Body::kNameFieldNumber).max_characters();
  return static_cast<std::size_t>(longest);
}

}  // namespace

bool IsName(std::string_view text) {
  const auto allowed = [](char c) {
    return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '_' ||
           c == '.' || c == '-';
  };
  return !text.empty() && text.size() <= LongestName() && std::ranges::all_of(text, allowed);
}

void BreakName(const std::string& name, const Rules& rules) {
  rules.Break("name", fmt::format("is {}; must be 1 to {} letters, digits, '_', '.' or '-'",
                                  Quoted(name), LongestName()));
}

std::vector<Body> DecodeBodies(const v1::Scenario& message, std::vector<Drive>* drives,
                               std::vector<Violation>* violations) {
  if (message.bodies().empty()) {
    Rules(violations).Break("bodies", "is missing", "a scenario needs at least one body");
  }
  std::vector<Body> bodies;
  bodies.reserve(static_cast<std::size_t>(message.bodies_size()));
  BodyIndex names;
  for (int i = 0; i < message.bodies_size(); ++i) {
    const Rules rules(violations, "bodies", i);
    const v1::Body& entry = message.bodies(i);
    Body body = DecodeBody(entry, rules);
    if (!entry.next_to().empty()) {
      body.position = PositionNextTo(entry, body, bodies, names, rules);
    } else if (entry.gap_m() != 0) {
      rules.Break("gap_m", "is given, but goes only with next_to", "remove it");
    }
    if (entry.has_motion()) {
      AddMotion(DecodeMotion(entry.motion(), body.position, rules.In("motion")), i, &body, drives);
    }
    bodies.push_back(std::move(body));
    const std::string& name = entry.name();
    if (!name.empty() && !names.emplace(name, bodies.size() - 1).second) {
      rules.Break("name", fmt::format("is {}, which another body is called", Quoted(name)),
                  "names of bodies are unique");
    }
  }
  return bodies;
}

BodyNames::BodyNames(const std::vector<Body>& bodies) : bodies_(bodies) {
  index_.reserve(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    index_.emplace(bodies[i].name, static_cast<int>(i));
  }
}

int BodyNames::Find(std::string_view name, std::string_view field, const Rules& rules) const {
  if (name.empty()) {
    rules.Break(field, "is missing", "give the name of a body");
    return kNone;
  }
  const auto found = index_.find(name);
  if (found != index_.end()) return found->second;
  if (!rules.full()) {
    rules.Break(field, fmt::format("is {}, which no body is called", Quoted(name)), Hint(name));
  }
  return kNone;
}

std::string BodyNames::Hint(std::string_view name) const {
  std::vector<std::string_view> names;
  for (const Body& body : bodies_) names.push_back(body.name);
  constexpr std::size_t kFew = 8;
  const bool few = !names.empty() && names.size() <= kFew && std::ranges::all_of(names, IsName);
  return DidYouMean(name, names, few ? fmt::format("bodies are {}", fmt::join(names, ", ")) : "");
}

}  // namespace contact
