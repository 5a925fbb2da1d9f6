#include "identity/certificate_rules.h"

#include <algorithm>
#include <sstream>
#include <string_view>

#include "identity/lines.h"

namespace contact {
namespace {

// Compares the text with the pattern, and appends what each `*` stands for.
bool Matches(std::string_view pattern, std::string_view text, std::vector<std::string>* stars) {
  if (pattern.empty() || pattern.front() != '*') {
    if (pattern.empty() || text.empty()) return pattern.empty() && text.empty();
    return pattern.front() == text.front() && Matches(pattern.substr(1), text.substr(1), stars);
  }
  const std::size_t most = std::min(text.find('/'), text.size());
  for (std::size_t taken = most; taken > 0; --taken) {
    stars->emplace_back(text.substr(0, taken));
    if (Matches(pattern.substr(1), text.substr(taken), stars)) return true;
    stars->pop_back();
  }
  return false;
}

// The text with $1 to $9 replaced.
std::string Fill(const std::string& text, const std::vector<std::string>& stars) {
  std::string filled;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool place =
        text[i] == '$' && i + 1 < text.size() && text[i + 1] >= '1' && text[i + 1] <= '9';
    if (place) {
      const auto star = static_cast<std::size_t>(text[++i] - '1');
      if (star < stars.size()) filled += stars[star];
    } else {
      filled += text[i];
    }
  }
  return filled;
}

// What is wrong with a rule, if every `*` stood for `x`; empty: nothing.
std::string MistakeOf(const std::string& pattern, const std::string& principal) {
  const auto stars = static_cast<std::size_t>(std::ranges::count(pattern, '*'));
  std::string mistake;
  ParsePrincipal(Fill(principal, std::vector<std::string>(stars, "x")), &mistake);
  return mistake;
}

}  // namespace

std::variant<CertificateRules, std::string> CertificateRules::Parse(const std::string& text) {
  CertificateRules rules;
  std::string mistake = ReadLines(text, [&](const std::string& line) -> std::string {
    std::istringstream words(line);
    std::string kind, pattern, principal;
    words >> kind >> pattern;
    std::getline(words >> std::ws, principal);
    if (kind != "cert" || pattern.empty()) {
      return "a rule is 'cert PATTERN user:NAME tenant:NAME roles:ROLE' or 'cert PATTERN nobody'";
    }
    if (principal == "nobody") {
      rules.rules_.push_back({pattern, ""});
      return "";
    }
    rules.rules_.push_back({pattern, principal});
    return MistakeOf(pattern, principal);
  });
  if (!mistake.empty()) return mistake;
  return rules;
}

std::optional<Principal> CertificateRules::Find(const std::vector<std::string>& names) const {
  constexpr std::size_t kLongestName = 256;  // Nobody needs more, and comparing must not take long.
  for (const Rule& rule : rules_) {
    for (const std::string& name : names) {
      std::vector<std::string> stars;
      if (name.size() > kLongestName || !Matches(rule.pattern, name, &stars)) continue;
      std::string mistake;
      auto principal = ParsePrincipal(Fill(rule.principal, stars), &mistake);
      if (principal) principal->how = "certificate";
      return principal;
    }
  }
  return std::nullopt;
}

}  // namespace contact
