#include "cli/figures/draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/erase.hpp>
#include <filesystem>
#include <vector>

#include "cli/base/output_file.h"
#include "cli/base/scratch_folder.h"
#include "cli/base/text_file.h"
#include "cli/figures/gnuplot.h"
#include "cli/figures/gnuplot_script.h"
#include "cli/figures/provenance_stamp.h"

namespace contact::cli {
namespace {

// What Draw writes to a file.
std::string Drawn(const Figure& figure, OutputFormat format, int columns,
                  const FigureStyle& style = {}) {
  const ScratchFolder scratch;
  const std::string path = scratch.path() / "figure";
  Draw(figure, format, path, columns, style);
  return ReadText(path);
}

// The width of a txt figure on the terminal of the standard output.
int ColumnsOf(const Settings& settings) {
  constexpr int kLeast = 40;
  const int width = settings.OutputStyle().width;
  return width > 0 ? std::max(width, kLeast) : GnuplotTerminal::kColumns;
}

}  // namespace

OutputFormat FormatOfFigure(const std::string& path) {
  return RequireFormatOfFile(path, kFigure, OutputFormat::kSvg);
}

OutputFormat FigureFormat(const std::string& file, const Settings& settings) {
  if (settings.output == OutputFormat::kTable) return FormatOfFigure(file);
  settings.RequireUse(kFigure);
  return settings.output;
}

std::string FigurePath(const std::string& file, const std::string& name, const Settings& settings) {
  return file.empty() ? name + std::string(InfoOf(FigureFormat(file, settings)).ending) : file;
}

void WriteFigure(const Figure& figure, const std::string& name, const std::string& file,
                 const Settings& settings, const FigureStyle& style) {
  const OutputFormat format = FigureFormat(file, settings);
  if (format == OutputFormat::kText && file.empty()) {
    fmt::print("{}", Drawn(figure, format, ColumnsOf(settings), style));
    return;
  }
  const std::string path = FigurePath(file, name, settings);
  Draw(figure, format, path, ColumnsOf(settings), style);
  fmt::print("{}\n", path);
}

void Draw(const Figure& figure, OutputFormat format, const std::string& path, int columns,
          const FigureStyle& style) {
  if (format == OutputFormat::kCsv) return WriteText(FigureCsv(figure), path);
  if (format == OutputFormat::kGnuplot) {
    const auto drawn =
        std::filesystem::path(path).replace_extension(InfoOf(OutputFormat::kSvg).ending);
    const GnuplotTerminal svg(OutputFormat::kSvg, columns, style);
    return WriteText(GnuplotScript(figure, svg, drawn), path);
  }
  DrawScript(GnuplotScript(figure, GnuplotTerminal(format, columns, style), path), path);
  const bool told = format != OutputFormat::kText || style.provenance;
  StampProvenance(format, path, figure.title, told ? figure.sources : std::vector<Provenance>());
}

void DrawScript(const std::string& script, const std::string& path) {
  const OutputFile writable(path);  // Reports a file that cannot be written, before gnuplot does.
  const ScratchFolder scratch;
  const std::string script_path = scratch.path() / "figure.gp";
  WriteText(script, script_path);
  RunGnuplot(script_path);
}

std::string DrawInline(const Figure& figure) {
  return InlineSvg(Drawn(figure, OutputFormat::kSvg, GnuplotTerminal::kColumns));
}

std::string InlineSvg(std::string_view document) {
  const auto begin = document.find("<svg");
  std::string svg(begin == std::string_view::npos ? "" : document.substr(begin));
  // HTML knows both name spaces by itself.
  boost::erase_all(svg, R"(xmlns="http://www.w3.org/2000/svg")");
  boost::erase_all(svg, R"(xmlns:xlink="http://www.w3.org/1999/xlink")");
  const auto title = svg.find("<title>");
  const auto end = svg.find("</title>");
  if (end != std::string::npos) svg.erase(title, end + 8 - title);
  return svg;
}

}  // namespace contact::cli
