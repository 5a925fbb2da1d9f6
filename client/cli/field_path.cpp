#include "cli/field_path.h"

#include <charconv>

namespace contact::cli {
namespace {

// Reads `name` or `name[index]`.
std::optional<PathStep> ParseStep(std::string_view text) {
  const std::size_t bracket = text.find('[');
  PathStep step{.name = std::string(text.substr(0, bracket)), .index = {}};
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
  if (error != std::errc{} || end != inside.data() + inside.size() || index < 0)
    return std::nullopt;
  step.index = index;
  return step;
}

}  // namespace

std::vector<PathStep> ParsePath(std::string_view text) {
  std::vector<PathStep> steps;
  while (true) {
    const std::size_t dot = text.find('.');
    const std::optional<PathStep> step = ParseStep(text.substr(0, dot));
    if (!step) return {};
    steps.push_back(*step);
    if (dot == std::string_view::npos) return steps;
    text.remove_prefix(dot + 1);
  }
}

std::string_view ParentPath(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? std::string_view() : path.substr(0, dot);
}

}  // namespace contact::cli
