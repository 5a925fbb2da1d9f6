#include "cli/help/contract/field_rules.h"

#include <regex>

namespace contact::cli {
namespace {

std::optional<std::smatch> Find(const std::string& text, const char* pattern) {
  std::smatch match;
  if (!std::regex_search(text, match, std::regex(pattern))) return std::nullopt;
  return match;
}

std::optional<int> FindCount(const std::string& text, const char* pattern) {
  const auto match = Find(text, pattern);
  return match ? std::optional(std::stoi((*match)[1].str())) : std::nullopt;
}

}  // namespace

FieldRules RulesOf(const std::string& comment) {
  FieldRules rules;
  rules.required = Find(comment, R"(\bRequired(\.|;|, unique))").has_value();
  const auto range = Find(comment, R"(Range: ([[(])(-?[0-9.e+-]+), (-?[0-9.e+-]+)([\])]))");
  if (range) {
    rules.low = Bound{std::stod((*range)[2].str()), (*range)[1] == "("};
    rules.high = Bound{std::stod((*range)[3].str()), (*range)[4] == ")"};
  } else if (const auto above = Find(comment, R"(Range: > (-?[0-9]+))")) {
    rules.low = Bound{std::stod((*above)[1].str()), true};
  }
  if (const auto value = Find(comment, R"(Default: ([^\s]*[^\s.,])[.,]?(\s|$))")) {
    rules.default_value = (*value)[1].str();
  }
  rules.max_characters = FindCount(comment, R"(at most ([0-9]+) characters)");
  rules.max_entries = FindCount(comment, R"([Aa]t most ([0-9]+)\.)");
  return rules;
}

}  // namespace contact::cli
