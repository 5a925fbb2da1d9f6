#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace contact::cli {

/// A part of a terminal in which dots are set: 2 by 4 in a character of Braille, or one as `*`.
class DotCanvas {
 public:
  /// `columns` and `rows` are of characters, at least 1.
  DotCanvas(int columns, int rows, bool braille);

  int width() const { return width_; }    ///< In dots.
  int height() const { return height_; }  ///< In dots.

  /// Dots from one to another, from (0, 0) at the top left. What lies outside is left out.
  void Line(int x0, int y0, int x1, int y1);

  /// The rows of characters, in UTF-8.
  std::vector<std::string> Rows() const;

 private:
  void Set(int x, int y);

  const int columns_;
  const bool braille_;
  const int width_;
  const int height_;
  std::vector<std::uint8_t> cells_;
};

}  // namespace contact::cli
