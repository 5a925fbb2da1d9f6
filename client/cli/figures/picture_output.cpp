#include "cli/figures/picture_output.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/figures/drawing.h"

namespace contact::cli {
namespace {

int Columns(const Settings& settings) {
  constexpr int kLeast = 40;
  const int width = settings.OutputStyle().width;
  return width > 0 ? std::max(width, kLeast) : Medium::kColumns;
}

}  // namespace

std::string PictureFormat(const std::string& file, const Settings& settings) {
  if (settings.output == OutputFormat::kTable) return FormatOf(file);
  settings.RequireOutput({OutputFormat::kSvg, OutputFormat::kPng, OutputFormat::kPdf,
                          OutputFormat::kText, OutputFormat::kTikz, OutputFormat::kGnuplot,
                          OutputFormat::kCsv});
  return std::string(NameOf(settings.output));
}

std::string PicturePath(const std::string& file, const std::string& name,
                        const Settings& settings) {
  return file.empty() ? name + "." + EndingOf(PictureFormat(file, settings)) : file;
}

void WritePicture(const Figure& figure, const std::string& name, const std::string& file,
                  const Settings& settings) {
  const std::string format = PictureFormat(file, settings);
  if (format == "txt" && file.empty()) {
    fmt::print("{}", DrawText(figure, Columns(settings)));
    return;
  }
  const std::string path = PicturePath(file, name, settings);
  Draw(figure, format, path, Columns(settings));
  fmt::print("{}\n", path);
}

}  // namespace contact::cli
