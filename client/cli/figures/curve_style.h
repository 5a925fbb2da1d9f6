#pragma once

#include <string>
#include <string_view>

#include "cli/figures/figure.h"

namespace contact::cli {

/// The colour of a place in the palette of Okabe and Ito, as `#rrggbb`; the palette repeats.
/// Colour-blind readers can tell its seven colours apart.
std::string_view PaletteColour(int colour);

/// The words after `with` of gnuplot for a curve in colours: points or lines, dashes, colour.
/// Curves whose colour repeats have other dashes.
std::string ColouredStyle(const Figure::Curve& curve);

/// The same in black and grey, for print: dashes tell curves apart.
std::string PaperStyle(const Figure::Curve& curve);

/// True for curves that are only shown beside others.
inline bool IsFaint(const Figure::Curve& curve) {
  return curve.mark == Figure::Mark::kFaint || curve.mark == Figure::Mark::kFaintDots;
}

/// The words after `with` of gnuplot for a curve in characters, where the line type chooses the
/// character.
std::string CharacterStyle(const Figure::Curve& curve);

}  // namespace contact::cli
