#include "cli/figures/gnuplot.h"

#include <fmt/format.h>

#include <system_error>

#include "cli/base/failure.h"
#include "cli/base/latex.h"
#include "cli/base/process.h"

namespace contact::cli {

// In single quotes only the quote is special.
std::string GnuplotString(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') quoted += '\'';
    quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return quoted + "'";
}

std::string Medium::Terminal(double height_in) const {
  if (format_ == "pdf") {
    return fmt::format("pdfcairo noenhanced color size 8in,{}in font 'Sans,11'", height_in);
  }
  if (format_ == "png") {  // Its points are 4/3 of svg's.
    return fmt::format(
        "pngcairo noenhanced size 1600,{} background '#ffffff' font 'Sans,12' fontscale 1.5 "
        "linewidth 2 pointscale 2",
        height_in * 200);
  }
  if (tex()) return fmt::format("tikz size 6in,{}in", height_in * 6 / 8);  // A page of text.
  if (characters()) {
    constexpr double kLinesPerInch = 4.8;  // 24 of them for a single panel.
    return fmt::format("dumb nofeed noenhanced mono size {},{:.0f}", columns_,
                       height_in * kLinesPerInch);
  }
  return fmt::format("svg noenhanced size 800,{} background '#ffffff' font 'Sans,12'",
                     height_in * 100);
}

std::string Medium::Text(std::string_view text) const {
  return tex() ? GnuplotString(LatexText(text)) : GnuplotString(text);
}

std::string Medium::Font(int points) const {
  if (characters()) return "";
  if (!tex()) return fmt::format(" font ',{}'", points);
  return points < 8 ? " font '\\tiny'" : " font '\\footnotesize'";
}

std::string Medium::Caption(const std::vector<Provenance>& sources) const {
  if (sources.empty() || characters()) return "";
  return fmt::format(
      "set bmargin 4.5\n"
      "set label {} at screen 0.99,0.015 right{} textcolor rgb '#666666'\n",
      Text(cli::Caption(sources)), Font(7));
}

void RunGnuplot(const std::string& script_path) {
  try {
    const int code = WaitForProcess(
        StartProcess({"gnuplot", "-d", script_path}));  // -d: no settings of the user.
    if (code != 0) throw Failure(ExitCode::kLocal, "gnuplot failed; what it said stands above");
  } catch (const std::system_error& error) {
    throw Failure(
        ExitCode::kLocal,
        error.code() == std::errc::no_such_file_or_directory
            ? "gnuplot is not installed: apt-get install gnuplot-nox, or use -o gp or -o csv"
            : error.what());
  }
}

}  // namespace contact::cli
