#pragma once

#include <fmt/format.h>
#include <google/protobuf/text_format.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "contact/v1/scenario.pb.h"
#include "wire/scenario/scenario_codec.h"

namespace contact {

inline v1::Scenario FromText(const std::string& text) {
  v1::Scenario scenario;
  if (!google::protobuf::TextFormat::ParseFromString(text, &scenario)) {
    throw std::invalid_argument(text);
  }
  return scenario;
}

/// Two balls that touch, and nothing more than what is required.
inline v1::Scenario TwoBalls() {
  return FromText(R"(
      bodies { name: "B1" mass_kg: 0.5 radius_m: 0.05 velocity_m_per_s: 0.2 }
      bodies { name: "B2" mass_kg: 0.5 radius_m: 0.05 position_m: 0.1 }
      contacts { between: "B1" between: "B2" stiffness: 1e8 restitution: 0.8 }
      end_time_s: 4e-3)");
}

/// `field: description — hint` of each violation.
inline std::vector<std::string> Lines(const std::vector<Violation>& violations) {
  std::vector<std::string> lines;
  for (const Violation& v : violations) {
    lines.push_back(
        fmt::format("{}: {}{}{}", v.field, v.description, v.hint.empty() ? "" : " — ", v.hint));
  }
  return lines;
}

inline std::vector<std::string> LinesOf(const v1::Scenario& message) {
  return Lines(DecodeScenario(message).violations);
}

}  // namespace contact
