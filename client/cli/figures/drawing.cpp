#include "cli/figures/drawing.h"

#include <fmt/format.h>

#include <filesystem>

#include "cli/base/output_file.h"
#include "cli/base/scratch_folder.h"
#include "cli/base/text_file.h"
#include "cli/figures/gnuplot.h"
#include "cli/figures/picture_source.h"

namespace contact::cli {
namespace {

void Remove(std::string_view part, std::string* text) {
  for (auto at = text->find(part); at != std::string::npos; at = text->find(part, at)) {
    text->erase(at, part.size());
  }
}

}  // namespace

std::string FormatOf(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension();
  if (ending == ".tex") return "tikz";
  for (const char* format : {"png", "pdf", "txt", "gp", "csv"}) {
    if (ending == std::string(".") + format) return format;
  }
  return "svg";
}

std::string EndingOf(const std::string& format) { return format == "tikz" ? "tex" : format; }

void Draw(const Figure& figure, std::string_view format, const std::string& path, int columns) {
  if (format == "csv") return WriteText(FigureCsv(figure), path);
  if (format == "gp") {
    const auto picture = std::filesystem::path(path).replace_extension("svg");
    return WriteText(GnuplotScript(figure, Medium("svg"), picture), path);
  }
  DrawScript(GnuplotScript(figure, Medium(format, columns), path), path);
  DescribePicture(format, path, figure.title, figure.sources);
}

std::string DrawText(const Figure& figure, int columns) {
  const ScratchFolder scratch;
  const std::string path = scratch.path() / "figure.txt";
  Draw(figure, "txt", path, columns);
  return ReadText(path);
}

void DrawScript(const std::string& script, const std::string& path) {
  const OutputFile writable(path);  // Told in our words, before gnuplot's.
  const ScratchFolder scratch;
  const std::string script_path = scratch.path() / "figure.gp";
  WriteText(script, script_path);
  RunGnuplot(script_path);
}

std::string DrawInline(const Figure& figure) {
  const ScratchFolder scratch;
  const std::string path = scratch.path() / "figure.svg";
  Draw(figure, "svg", path);
  return InlineSvg(ReadText(path));
}

std::string InlineSvg(std::string_view document) {
  const auto begin = document.find("<svg");
  std::string svg(begin == std::string_view::npos ? "" : document.substr(begin));
  // HTML knows both name spaces by itself.
  Remove(R"(xmlns="http://www.w3.org/2000/svg")", &svg);
  Remove(R"(xmlns:xlink="http://www.w3.org/1999/xlink")", &svg);
  const auto title = svg.find("<title>");  // Would be shown wherever the pointer is.
  const auto end = svg.find("</title>");
  if (end != std::string::npos) svg.erase(title, end + 8 - title);
  return svg;
}

}  // namespace contact::cli
