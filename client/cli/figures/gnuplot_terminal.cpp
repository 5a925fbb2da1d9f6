#include "cli/figures/gnuplot_terminal.h"

#include <fmt/format.h>

#include "cli/base/escape.h"

namespace contact::cli {

// Between single quotes, gnuplot gives a meaning to the quote alone.
std::string GnuplotString(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') quoted += '\'';
    quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return quoted + "'";
}

std::string GnuplotTerminal::Terminal(double height_in) const {
  if (format_ == OutputFormat::kPdf) {
    return fmt::format("pdfcairo noenhanced color size 8in,{}in font 'Sans,11'", height_in);
  }
  if (format_ == OutputFormat::kPng) {  // A point of pngcairo is 4/3 of a point of svg.
    return fmt::format(
        "pngcairo noenhanced size 1600,{} background '#ffffff' font 'Sans,12' fontscale 1.5 "
        "linewidth 2 pointscale 2",
        height_in * 200);
  }
  if (tex())
    return fmt::format("tikz size 6in,{}in", height_in * 6 / 8);  // The text width of an article.
  if (characters()) {
    constexpr double kLinesPerInch = 4.8;  // 24 lines for a single panel.
    return fmt::format("dumb nofeed noenhanced mono size {},{:.0f}", columns_,
                       height_in * kLinesPerInch);
  }
  return fmt::format("svg noenhanced size 800,{} background '#ffffff' font 'Sans,12'",
                     height_in * 100);
}

std::string GnuplotTerminal::Text(std::string_view text) const {
  return tex() ? GnuplotString(LatexText(text)) : GnuplotString(text);
}

std::string GnuplotTerminal::Font(int points) const {
  if (characters()) return "";
  if (!tex()) return fmt::format(" font ',{}'", points);
  return points < 8 ? " font '\\tiny'" : " font '\\footnotesize'";
}

std::string GnuplotTerminal::CaptionCommands(const std::vector<Provenance>& sources) const {
  if (sources.empty() || characters()) return "";
  return fmt::format(
      "set bmargin 4.5\n"
      "set label {} at screen 0.99,0.015 right{} textcolor rgb '#666666'\n",
      Text(Caption(sources)), Font(7));
}

}  // namespace contact::cli
