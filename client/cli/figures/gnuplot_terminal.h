#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/export/provenance.h"
#include "cli/figures/form/figure_style.h"
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
  /// characters, unless the style has a size; other formats ignore it. tikz and txt ignore fonts.
  explicit GnuplotTerminal(OutputFormat format, int columns = kColumns, FigureStyle style = {})
      : format_(format), columns_(columns), style_(std::move(style)) {}

  /// How the figure is to look.
  const FigureStyle& style() const { return style_; }

  /// True for txt: no fonts, no fills, no upright text.
  bool characters() const { return format_ == OutputFormat::kText; }
  /// True for tikz, whose texts LaTeX sets.
  bool tex() const { return format_ == OutputFormat::kTikz; }

  /// The argument of `set terminal`. The figure has the size of the style. Without one it is 8
  /// inches wide and `height_in` inches high; tikz keeps that shape at 6 inches width, and the
  /// style of papers at 3.4. txt has 10 columns and 4.8 lines an inch.
  std::string Terminal(double height_in) const;

  /// A text as a string literal that the terminal shows as it is: it can contain commands neither
  /// of gnuplot nor of TeX.
  std::string Text(std::string_view text) const;

  /// The option ` font …` for about this size in points, where the style leaves sizes to the
  /// format; empty for txt.
  std::string Font(int points) const;

  /// How many entries of a key, of which the longest has so many characters, fit into a row above
  /// the axes.
  int KeyColumns(std::size_t longest) const;

  /// Commands that write a note and, unless the style leaves them out, the sources of a figure
  /// below its last plot. For txt only the note, for StampProvenance appends the sources.
  std::string CaptionCommands(const std::vector<Provenance>& sources,
                              const std::string& note = "") const;

 private:
  /// Width and height of a figure that has this height by itself [in].
  FigureStyle::Size SizeOf(double height_in) const;
  /// `'family,size'` of the texts of the terminal.
  std::string BaseFont() const;
  /// The part of the usual size of texts that the style asks for.
  double FontScale() const;
  /// How many characters of about this size in points stand beside each other in the figure.
  double Characters(double points) const;

  OutputFormat format_;
  /// Width of a txt figure in characters.
  int columns_;
  FigureStyle style_;
};

}  // namespace contact::cli
