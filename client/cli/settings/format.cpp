#include "cli/settings/format.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>

namespace contact::cli {

const std::vector<FormatInfo>& Formats() {
  static const std::vector<FormatInfo> kFormats = {
#define FORMAT(enumerator, name, ending, uses, about) \
  {OutputFormat::enumerator, name, ending, uses, about},
#include "cli/settings/formats.def"
  };
  return kFormats;
}

const FormatInfo& InfoOf(OutputFormat format) {
  return Formats()[static_cast<std::size_t>(format)];
}

std::optional<OutputFormat> FindFormat(std::string_view name) {
  const auto found = std::ranges::find(Formats(), name, &FormatInfo::name);
  return found == Formats().end() ? std::nullopt : std::optional(found->format);
}

std::optional<OutputFormat> FormatOfFile(const std::string& path, FormatUse use) {
  const std::string ending = std::filesystem::path(path).extension();
  if (ending.empty()) return std::nullopt;
  for (const FormatInfo& info : Formats()) {
    if (info.ending == ending && (info.uses & use) != 0) return info.format;
  }
  return std::nullopt;
}

std::vector<std::string> FormatNames(unsigned uses) {
  std::vector<std::string> names;
  for (const FormatInfo& info : Formats()) {
    if ((info.uses & uses) != 0) names.emplace_back(info.name);
  }
  return names;
}

std::string FormatHelp(FormatUse use) {
  std::string help;
  for (const FormatInfo& info : Formats()) {
    if ((info.uses & use) == 0) continue;
    help += fmt::format("{}{}", help.empty() ? "" : ", ", info.name);
    if (!info.about.empty()) help += fmt::format(" ({})", info.about);
  }
  return help;
}

std::string FormatEndings(FormatUse use) {
  std::vector<std::string_view> endings;
  for (const FormatInfo& info : Formats()) {
    if ((info.uses & use) != 0 && !info.ending.empty()) endings.push_back(info.ending);
  }
  return fmt::format("{}", fmt::join(endings, ", "));
}

}  // namespace contact::cli
