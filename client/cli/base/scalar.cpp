#include "cli/base/scalar.h"

#include <fmt/format.h>

#include <boost/locale/utf.hpp>

#include "cli/base/failure.h"

namespace contact::cli {

std::map<std::string, std::string> ParseAssignments(const std::vector<std::string>& texts,
                                                    std::string_view flag,
                                                    std::string_view expected) {
  std::map<std::string, std::string> values;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw Failure(ExitCode::kUsage, fmt::format("{} {}: expected {}", flag, text, expected));
    }
    values[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return values;
}

std::optional<double> ParseNumber(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  if (text.starts_with('-') || text.starts_with('+')) return std::nullopt;
  const bool special = text.starts_with(".i") || text.starts_with(".I") || text.starts_with(".n") ||
                       text.starts_with(".N");
  if (special) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return negative ? -value : value;
}

std::optional<bool> ParseBool(std::string_view text) {
  if (text == "true" || text == "True" || text == "TRUE") return true;
  if (text == "false" || text == "False" || text == "FALSE") return false;
  return std::nullopt;
}

bool IsUtf8(std::string_view text) {
  namespace utf = boost::locale::utf;
  for (auto at = text.begin(); at != text.end();) {
    const utf::code_point point = utf::utf_traits<char>::decode(at, text.end());
    if (point == utf::illegal || point == utf::incomplete) return false;
  }
  return true;
}

}  // namespace contact::cli
