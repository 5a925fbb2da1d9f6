#include "cli/figures/gnuplot_terminal.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/spelling.h"
#include "cli/base/escape.h"

namespace contact::cli {
namespace {

constexpr double kWidth = 8;         // Of a figure [in].
constexpr double kSvgPerInch = 100;  // Pixels, also the unit of its fonts.
constexpr double kPoints = 12;       // Of texts in svg and png, and
constexpr double kPdfPoints = 11;    // in pdf.
constexpr double kColumnsPerInch = 10;
constexpr double kLinesPerInch = 4.8;  // 24 lines for a single panel.

}  // namespace

// Between single quotes, gnuplot gives a meaning to the quote alone; and a doubled one is one only
// after another character, so that others become apostrophes.
std::string GnuplotString(std::string_view text) {
  std::string quoted = "'";
  char before = '\'';
  for (const char c : Printable(text, ' ')) {
    if (c != '\'') {
      quoted += c;
    } else {
      quoted += before == '\'' ? "’" : "''";
    }
    before = c;
  }
  return quoted + "'";
}

std::string GnuplotTerminal::Terminal(double height_in) const {
  const auto [width, height] = SizeOf(height_in);
  if (format_ == OutputFormat::kPdf) {
    return fmt::format("pdfcairo noenhanced color size {:.5g}in,{:.5g}in font {}", width, height,
                       BaseFont());
  }
  if (format_ == OutputFormat::kPng) {  // A point of pngcairo is 4/3 of a point of svg.
    return fmt::format(
        "pngcairo noenhanced size {:.0f},{:.0f} background '#ffffff' font {} fontscale 1.5 "
        "linewidth 2 pointscale 2",
        width * 200, height * 200, BaseFont());
  }
  if (tex()) return fmt::format("tikz size {:.5g}in,{:.5g}in", width, height);
  if (characters()) {
    return fmt::format("dumb nofeed noenhanced mono size {:.0f},{:.0f}",
                       style_.size ? width * kColumnsPerInch : columns_, height * kLinesPerInch);
  }
  return fmt::format("svg noenhanced size {:.0f},{:.0f} background '#ffffff' font {}",
                     width * kSvgPerInch, height * kSvgPerInch, BaseFont());
}

FigureStyle::Size GnuplotTerminal::SizeOf(double height_in) const {
  constexpr double kTextWidth = 6;  // Of an article in LaTeX.
  constexpr double kColumn = 3.4;   // Of a journal with two columns, whose figures are
  constexpr double kSteeper = 1.2;  // higher for their width, so that there is space for texts.
  if (style_.size) return *style_.size;
  if (style_.paper && !characters()) {
    return {kColumn, height_in * kColumn / kWidth * kSteeper};
  }
  const double width = tex() ? kTextWidth : kWidth;
  return {width, height_in * width / kWidth};
}

double GnuplotTerminal::FontScale() const {
  constexpr double kPaperPoints = 8;
  const bool pdf = format_ == OutputFormat::kPdf;
  const double points = style_.font.points > 0 ? style_.font.points
                        : style_.paper         ? kPaperPoints
                                               : 0;
  if (points == 0) return 1;
  // A point of svg and png is 1/100 in.
  return pdf ? points / kPdfPoints : points * kSvgPerInch / 72 / kPoints;
}

std::string GnuplotTerminal::BaseFont() const {
  const std::string family = !style_.font.family.empty() ? style_.font.family
                             : style_.paper              ? "Times"
                                                         : "Sans";
  const double usual = format_ == OutputFormat::kPdf ? kPdfPoints : kPoints;
  return GnuplotString(fmt::format("{},{:.3g}", family, usual * FontScale()));
}

std::string GnuplotTerminal::Text(std::string_view text) const {
  return tex() ? GnuplotString(LatexText(text)) : GnuplotString(text);
}

std::string GnuplotTerminal::Font(int points) const {
  if (characters()) return "";
  if (!tex()) return fmt::format(" font ',{:.3g}'", points * FontScale());
  return points < 8 ? " font '\\tiny'" : " font '\\footnotesize'";
}

double GnuplotTerminal::Characters(double points) const {
  constexpr double kShape = 0.6;  // Width of a character over its height, as gnuplot takes it.
  constexpr double kFootnotes = 8;
  if (characters()) return style_.size ? style_.size->width * kColumnsPerInch : columns_;
  const double width = SizeOf(1).width;
  if (tex()) return width * 72 / (kShape * kFootnotes);
  const double per_inch = format_ == OutputFormat::kPdf ? 72 : kSvgPerInch;
  return width * per_inch / (kShape * points * FontScale());
}

int GnuplotTerminal::KeyColumns(std::size_t longest) const {
  constexpr double kKeyPoints = 10;
  constexpr double kFrame = 0.85;               // The axes' part of the width.
  const double sample = characters() ? 8 : 11;  // Characters beside the text of an entry.
  const double entry = static_cast<double>(longest) + sample;
  return std::max(1, static_cast<int>(kFrame * Characters(kKeyPoints) / entry));
}

std::string GnuplotTerminal::CaptionCommands(const std::vector<Provenance>& sources,
                                             const std::string& note) const {
  constexpr int kSmall = 7;
  const bool told = !sources.empty() && style_.provenance && !style_.paper && !characters();
  const std::string caption = told ? Caption(sources) : "";
  // Of two that have no room beside each other the note stands above.
  const bool two = !note.empty() && told &&
                   static_cast<double>(note.size() + caption.size()) > Characters(kSmall);
  std::string text;
  if (told || (!note.empty() && !characters())) {
    text += fmt::format("set bmargin {}\n", two ? 5.5 : 4.5);
  }
  const auto write = [&](const std::string& line, const char* where) {
    text += fmt::format("set label {} at screen {}{} textcolor rgb '#666666'\n", Text(line), where,
                        Font(kSmall));
  };
  if (told) write(caption, "0.99,0.015 right");
  if (!note.empty()) write(note, two ? "0.01,0.05 left" : "0.01,0.015 left");
  return text;
}

}  // namespace contact::cli
