#include "cli/verbs/job/figure_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/base/files.h"

namespace contact::cli {
namespace {

OutputFormat FigureFormat(const std::string& file, const Settings& settings) {
  if (settings.output == OutputFormat::kTable) return FormatOfFigure(file);
  settings.RequireUse(kFigure);
  return settings.output;
}

// The width of a txt figure on the terminal of the standard output.
int ColumnsOf(const Settings& settings) {
  constexpr int kLeast = 40;
  constexpr int kUsual = 80;
  const int width = settings.OutputStyle().width;
  return width > 0 ? std::max(width, kLeast) : kUsual;
}

}  // namespace

OutputFormat FormatOfFigure(const std::string& path) {
  return RequireFormatOfFile(path, kFigure, OutputFormat::kSvg);
}

std::vector<std::string> FigureWords(const std::string& file, const std::string& name,
                                     const Settings& settings) {
  const OutputFormat format = FigureFormat(file, settings);
  std::vector<std::string> words = {fmt::format("--format={}", NameOf(format)),
                                    fmt::format("--columns={}", ColumnsOf(settings))};
  if (!file.empty()) RequireWritable(file);
  if (!file.empty() || format != OutputFormat::kText) {
    const std::string path = file.empty() ? name + std::string(InfoOf(format).ending) : file;
    words.push_back("--file=" + path);
  }
  return words;
}

}  // namespace contact::cli
