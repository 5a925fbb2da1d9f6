#include "identity/lines.h"

#include <fmt/format.h>

#include <sstream>

namespace contact {

std::string ReadLines(const std::string& text,
                      const std::function<std::string(const std::string&)>& read) {
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    if (const std::string mistake = read(line); !mistake.empty()) {
      return fmt::format("line {}: {}", number, mistake);
    }
  }
  return "";
}

}  // namespace contact
