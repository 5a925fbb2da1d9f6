#include "cli/settings/config_edit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <vector>

#include "cli/base/failure.h"
#include "cli/base/files.h"
#include "cli/settings/config.h"

namespace contact::cli {
namespace {

std::string Trimmed(const std::string& line) {
  return boost::trim_copy_if(line, boost::is_any_of(" \t\r"));
}

// The key that a line sets; empty for other lines.
std::string KeyOf(const std::string& line) {
  const std::size_t equals = line.find('=');
  return equals == std::string::npos ? "" : Trimmed(line.substr(0, equals));
}

bool IsSection(const std::string& line) { return Trimmed(line).starts_with('['); }

// The line after the header of the section of `profile`, which is added at the end if missing.
std::vector<std::string>::iterator BeginOf(const std::string& profile,
                                           std::vector<std::string>* lines) {
  const std::string header = fmt::format("[profile.{}]", profile);
  auto begin = std::ranges::find(*lines, header, Trimmed);
  if (begin == lines->end()) {
    if (!lines->empty()) lines->emplace_back();
    lines->push_back(header);
    begin = lines->end() - 1;
  }
  return begin + 1;
}

}  // namespace

std::string WithValue(const std::string& text, const std::string& profile, const std::string& key,
                      const std::string& value) {
  std::vector<std::string> lines = LinesOf(text);
  const std::string name = key == kProfileKey ? kUseProfileKey : key;
  const char quote = value.find('\'') == std::string::npos ? '\'' : '"';
  const std::string setting = fmt::format("{} = {}{}{}", name, quote, value, quote);
  const auto begin = profile.empty() ? lines.begin() : BeginOf(profile, &lines);
  const auto end = std::find_if(begin, lines.end(), IsSection);
  const auto old = std::ranges::find(begin, end, name, KeyOf);
  if (old != end) {
    *old = setting;
  } else {
    auto last = end;  // After the values of the section, before the blank lines.
    while (last != begin && Trimmed(*(last - 1)).empty()) --last;
    lines.insert(last, setting);
  }
  std::string changed = fmt::format("{}\n", fmt::join(lines, "\n"));
  const ConfigFile file = ReadConfig("the changed file", changed, {key, kProfileKey});
  const auto now = FindValue({file}, key, profile);
  const bool other_keys = file.mistake.find("unknown key") != std::string::npos;
  if ((!file.mistake.empty() && !other_keys) || !now || now->text != value) {
    throw Failure(ExitCode::kLocal, "cannot change it line by line; edit the file by hand");
  }
  return changed;
}

}  // namespace contact::cli
