#include "wire/rules/field_path.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "base/spelling.h"

namespace contact {
namespace {

// The first point outside of brackets; names may have points.
std::size_t FindPoint(std::string_view text) {
  const std::size_t point = text.find('.');
  const std::size_t bracket = text.find('[');
  if (bracket == std::string_view::npos || point < bracket) return point;
  const std::size_t end = text.find(']', bracket);
  return end == std::string_view::npos ? end : text.find('.', end);
}

// Reads `name`, `name[index]` or `name[key]`.
std::optional<PathStep> ParseStep(std::string_view text, bool keys) {
  const std::size_t bracket = text.find('[');
  PathStep step{.name = std::string(text.substr(0, bracket))};
  if (step.name.empty()) return std::nullopt;
  if (bracket == std::string_view::npos) return step;
  if (text.back() != ']') return std::nullopt;

  const std::string_view inside = text.substr(bracket + 1, text.size() - bracket - 2);
  if (inside == "*") {
    step.index = PathStep::kEvery;
    return step;
  }
  int index = 0;
  const auto [end, error] = std::from_chars(inside.data(), inside.data() + inside.size(), index);
  if (error == std::errc{} && end == inside.data() + inside.size() && index >= 0) {
    step.index = index;
  } else if (keys && !inside.empty()) {
    step.key = std::string(inside);
  } else {
    return std::nullopt;
  }
  return step;
}

// A quantity that people give where the contract has another one.
struct Relative {
  std::string_view begin;  // Of the names that they give it.
  std::string_view field;
  std::string_view hint;
};
constexpr Relative kRelatives[] = {
    {"freq", "frequency_hz", "frequency_hz is the frequency in Hz"},
    {"period", "frequency_hz", "frequency_hz is 1 divided by the period"},
    {"phase_deg", "phase_rad", "phase_rad is π/180 times the phase in degrees"},
    {"diameter", "radius_m", "radius_m is half of the diameter"},
};

}  // namespace

std::vector<PathStep> ParsePath(std::string_view text, bool keys) {
  std::vector<PathStep> steps;
  while (true) {
    const std::size_t point = FindPoint(text);
    const std::optional<PathStep> step = ParseStep(text.substr(0, point), keys);
    if (!step) return {};
    steps.push_back(*step);
    if (point == std::string_view::npos) return steps;
    text.remove_prefix(point + 1);
  }
}

std::string_view ParentPath(std::string_view path) {
  const std::size_t point = path.rfind('.');
  return point == std::string_view::npos ? std::string_view() : path.substr(0, point);
}

std::string FieldHint(const google::protobuf::Descriptor& message, const std::string& name) {
  for (const auto& [begin, field, hint] : kRelatives) {
    const bool has = message.FindFieldByName(std::string(field)) != nullptr;
    if (has && name.starts_with(begin)) return std::string(hint);
  }
  std::vector<std::string_view> names;
  names.reserve(static_cast<std::size_t>(message.field_count()));
  for (int i = 0; i < message.field_count(); ++i) names.push_back(message.field(i)->name());
  return DidYouMean(name, names, fmt::format("fields are {}", fmt::join(names, ", ")));
}

}  // namespace contact
