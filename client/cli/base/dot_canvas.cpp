#include "cli/base/dot_canvas.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>

namespace contact::cli {
namespace {

// Bits of a character of Braille, by row and column of its dots.
constexpr std::array<std::array<std::uint8_t, 2>, 4> kDots{
    {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}}};

// U+2800 with these dots.
std::string Braille(std::uint8_t dots) {
  return {'\xE2', static_cast<char>(0xA0 + dots / 64), static_cast<char>(0x80 + dots % 64)};
}

}  // namespace

DotCanvas::DotCanvas(int columns, int rows, bool braille)
    : columns_(std::max(columns, 1)),
      braille_(braille),
      width_(columns_ * (braille ? 2 : 1)),
      height_(std::max(rows, 1) * (braille ? 4 : 1)),
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(std::max(rows, 1))) {}

void DotCanvas::Set(int x, int y) {
  if (x < 0 || x >= width_ || y < 0 || y >= height_) return;
  const int cell = braille_ ? y / 4 * columns_ + x / 2 : y * columns_ + x;
  const std::uint8_t dot =
      braille_ ? kDots.at(static_cast<std::size_t>(y % 4)).at(static_cast<std::size_t>(x % 2)) : 1;
  std::uint8_t& dots = cells_[static_cast<std::size_t>(cell)];
  dots = static_cast<std::uint8_t>(dots | dot);
}

// Bresenham's algorithm.
void DotCanvas::Line(int x0, int y0, int x1, int y1) {
  const int dx = std::abs(x1 - x0);
  const int dy = -std::abs(y1 - y0);
  const int step_x = x0 < x1 ? 1 : -1;
  const int step_y = y0 < y1 ? 1 : -1;
  int error = dx + dy;
  for (;;) {
    Set(x0, y0);
    if (x0 == x1 && y0 == y1) return;
    const int twice = 2 * error;
    if (twice >= dy) {
      error += dy;
      x0 += step_x;
    }
    if (twice <= dx) {
      error += dx;
      y0 += step_y;
    }
  }
}

std::vector<std::string> DotCanvas::Rows() const {
  std::vector<std::string> rows(cells_.size() / static_cast<std::size_t>(columns_));
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    std::string& row = rows[i / static_cast<std::size_t>(columns_)];
    row += braille_ ? Braille(cells_[i]) : cells_[i] != 0 ? "*" : " ";
  }
  return rows;
}

}  // namespace contact::cli
