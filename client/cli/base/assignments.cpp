#include "cli/base/assignments.h"

#include <fmt/format.h>

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

}  // namespace contact::cli
