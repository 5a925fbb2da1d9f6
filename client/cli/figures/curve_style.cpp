#include "cli/figures/curve_style.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>

namespace contact::cli {
namespace {

constexpr std::array<std::string_view, 7> kColours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                   "#E69F00", "#56B4E9", "#000000"};
constexpr std::array kDashes{1, 4, 5};  // Dash types of gnuplot, one for each turn of the palette.

}  // namespace

std::string_view PaletteColour(int colour) {
  return kColours[static_cast<std::size_t>(colour) % kColours.size()];
}

std::string ColouredStyle(const Figure::Curve& curve) {
  const auto turn = static_cast<std::size_t>(curve.colour) / kColours.size();
  const std::string ending = fmt::format(" lc rgb '{}'", PaletteColour(curve.colour));
  switch (curve.mark) {
    case Figure::Mark::kLine:
      return fmt::format("lines lw 1.5 dt {}{}", kDashes[turn % kDashes.size()], ending);
    case Figure::Mark::kDashed:
      return "lines lw 1.5 dt 2" + ending;
    case Figure::Mark::kDotted:
      return "lines lw 1.5 dt 3" + ending;
    case Figure::Mark::kStart:
      return "points pt 6" + ending;
    case Figure::Mark::kEnd:
      return "points pt 2" + ending;
    case Figure::Mark::kLinePoints:
      return "linespoints lw 1.5 pt 6" + ending;
    case Figure::Mark::kPoints:
      return "points pt 7 ps 0.4" + ending;
  }
  return "lines" + ending;
}

std::string CharacterStyle(const Figure::Curve& curve) {
  constexpr int kCharacters = 7;   // * # $ % @ & =
  constexpr int kDashedShift = 3;  // From the character of a solid curve to that of a dashed one.
  const bool dashed = curve.mark == Figure::Mark::kDashed || curve.mark == Figure::Mark::kDotted;
  const int type = (curve.colour + (dashed ? kDashedShift : 0)) % kCharacters + 1;
  if (curve.mark == Figure::Mark::kStart) return fmt::format("points pt 'o' lt {}", type);
  if (curve.mark == Figure::Mark::kEnd) return fmt::format("points pt '×' lt {}", type);
  if (curve.mark == Figure::Mark::kPoints) return fmt::format("points pt '+' lt {}", type);
  if (curve.mark == Figure::Mark::kLinePoints) return fmt::format("linespoints pt 'o' lt {}", type);
  return fmt::format("lines lt {}", type);
}

}  // namespace contact::cli
