#include "jobs/read/label_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "contact/v1/job.pb.h"
#include "wire/rules/field_rule.h"

namespace contact {
namespace {

constexpr std::size_t kMaxLabelLength = 63;

bool IsLabelCharacter(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         c == '.' || c == '-';
}

bool IsLabelText(const std::string& text) {
  return text.size() <= kMaxLabelLength && std::all_of(text.begin(), text.end(), IsLabelCharacter);
}

}  // namespace

void CheckLabels(const Labels& labels, std::vector<Violation>* violations) {
  const auto most =
      static_cast<std::size_t>(RuleOf<v1::Job>(v1::Job::kLabelsFieldNumber).max_entries());
  if (labels.size() > most) {
    violations->push_back(
        {"labels", fmt::format("has {} entries; must have at most {}", labels.size(), most), ""});
  }
  for (const auto& [key, value] : labels) {
    if (!key.empty() && IsLabelText(key) && IsLabelText(value)) continue;
    violations->push_back({fmt::format("labels[{}]", key.substr(0, kMaxLabelLength)),
                           "key and value must be at most 63 letters, digits, '_', '.' and '-', "
                           "and the key not empty",
                           ""});
    if (violations->size() > most) return;
  }
}

}  // namespace contact
