#include "cli/figures/curve_style.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>

namespace contact::cli {
namespace {

constexpr std::array<std::string_view, 7> kColours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                   "#E69F00", "#56B4E9", "#000000"};
constexpr std::array kDashes{1, 4, 5};  // Dash types of gnuplot, one for each turn of the palette.
constexpr std::array kPaperDashes{1, 2, 3, 4, 5};  // For curves without colours, and
constexpr std::array<std::string_view, 2> kPaperInks{"#000000", "#888888"};  // inks in turn.

constexpr std::string_view kFaint = "#c4c4c4";

// Dashes, ink and width of the curves of one place in the palette.
struct Pen {
  int dash;
  std::string_view ink;
  double width;
};

Pen ColouredPen(int colour) {
  const auto turn = static_cast<std::size_t>(colour) / kColours.size();
  return {kDashes[turn % kDashes.size()], PaletteColour(colour), 1.5};
}

Pen PaperPen(int colour) {
  const auto place = static_cast<std::size_t>(colour);
  return {kPaperDashes[place % kPaperDashes.size()],
          kPaperInks[place / kPaperDashes.size() % kPaperInks.size()], 1};
}

std::string PenStyle(const Figure::Curve& curve, const Pen& pen) {
  const std::string ink = fmt::format(" lc rgb '{}'", pen.ink);
  const auto line = [&](int dash) {
    return fmt::format("lines lw {} dt {}{}", pen.width, dash, ink);
  };
  switch (curve.mark) {
    case Figure::Mark::kLine:
      return line(pen.dash);
    case Figure::Mark::kDashed:
      return line(2);
    case Figure::Mark::kDotted:
      return line(3);
    case Figure::Mark::kStart:
      return "points pt 6" + ink;
    case Figure::Mark::kEnd:
      return "points pt 2" + ink;
    case Figure::Mark::kLinePoints:
      return fmt::format("linespoints lw {} dt {} pt 6{}", pen.width, pen.dash, ink);
    case Figure::Mark::kPoints:
      return "points pt 7 ps 0.4" + ink;
    case Figure::Mark::kFaint:
      return fmt::format("lines lw 0.5 lc rgb '{}'", kFaint);
    case Figure::Mark::kFaintDots:
      return fmt::format("points pt 7 ps 0.3 lc rgb '{}'", kFaint);
  }
  return "lines" + ink;
}

}  // namespace

std::string_view PaletteColour(int colour) {
  return kColours[static_cast<std::size_t>(colour) % kColours.size()];
}

std::string ColouredStyle(const Figure::Curve& curve) {
  return PenStyle(curve, ColouredPen(curve.colour));
}

std::string PaperStyle(const Figure::Curve& curve) {
  Pen pen = PaperPen(curve.colour);
  // What is dashed beside a curve must not look like another one.
  if (curve.mark == Figure::Mark::kDashed) pen.ink = kPaperInks.back();
  return PenStyle(curve, pen);
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
