#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/export/provenance.h"
#include "cli/settings/format.h"

namespace contact::cli {

/// A text as a string literal of gnuplot. Control characters become spaces, and nothing in the
/// text can end the literal.
std::string GnuplotString(std::string_view text);

/// The output format of a gnuplot script and what its commands need for that format. All formats
/// show the same figure: svg, png with twice the pixels of svg, pdf, tikz, and txt, which is made
/// of characters.
class GnuplotTerminal {
 public:
  /// Width of a txt figure in characters where nobody asks for another.
  static constexpr int kColumns = 80;

  /// `format` is kSvg, kPng, kPdf, kTikz or kText. `columns` is the width of a txt figure in
  /// characters; other formats ignore it.
  explicit GnuplotTerminal(OutputFormat format, int columns = kColumns)
      : format_(format), columns_(columns) {}

  /// True for txt: no fonts, no fills, no upright text.
  bool characters() const { return format_ == OutputFormat::kText; }
  /// True for tikz, whose texts LaTeX sets.
  bool tex() const { return format_ == OutputFormat::kTikz; }

  /// The argument of `set terminal`. The figure is 8 inches wide and `height_in` inches high; tikz
  /// keeps that shape at 6 inches width, txt has 4.8 lines an inch of height.
  std::string Terminal(double height_in) const;

  /// A text as a string literal that the terminal shows as it is: it can contain commands neither
  /// of gnuplot nor of TeX.
  std::string Text(std::string_view text) const;

  /// The option ` font …` for about this size in points; empty for txt.
  std::string Font(int points) const;

  /// Commands that write the sources of a figure below its last plot. Empty without sources, and
  /// for txt, to which StampProvenance appends them.
  std::string CaptionCommands(const std::vector<Provenance>& sources) const;

 private:
  OutputFormat format_;
  /// Width of a txt figure in characters.
  int columns_;
};

}  // namespace contact::cli
