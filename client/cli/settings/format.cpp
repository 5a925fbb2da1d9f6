#include "cli/settings/format.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <cstddef>
#include <filesystem>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

// The ending of a file name in small letters, such as `.svg`; empty without one.
std::string EndingOf(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension();
  return ending == "." ? "" : boost::to_lower_copy(ending);
}

}  // namespace

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
  const std::string ending = EndingOf(path);
  if (ending.empty()) return std::nullopt;
  for (const FormatInfo& info : Formats()) {
    if (info.ending == ending && (info.uses & use) != 0) return info.format;
  }
  return std::nullopt;
}

OutputFormat RequireFormatOfFile(const std::string& path, FormatUse use, OutputFormat standard) {
  const std::optional<OutputFormat> format = FormatOfFile(path, use);
  if (format || EndingOf(path).empty()) return format.value_or(standard);
  throw Failure(ExitCode::kUsage, fmt::format("{}: no format has the ending {}; there are {}", path,
                                              EndingOf(path), FormatEndings(use)));
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
