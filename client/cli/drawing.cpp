#include "cli/drawing.h"

#include "cli/gnuplot.h"
#include "cli/output_file.h"
#include "cli/scratch_folder.h"
#include "cli/text_file.h"

namespace contact::cli {
namespace {

void Remove(std::string_view part, std::string* text) {
  for (auto at = text->find(part); at != std::string::npos; at = text->find(part, at)) {
    text->erase(at, part.size());
  }
}

}  // namespace

void Draw(const Figure& figure, std::string_view format, const std::string& path) {
  DrawScript(GnuplotScript(figure, format, path), path);
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
  Remove("<title>Gnuplot</title>", &svg);  // Would be shown wherever the pointer is.
  return svg;
}

}  // namespace contact::cli
