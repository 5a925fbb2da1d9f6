#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace contact::cli {

/// A part of a terminal in which dots are set: 2 by 4 dots in a character of Braille, or one dot a
/// character, shown as `*`.
class DotCanvas {
 public:
  /// `columns` and `rows` are of characters, at least 1.
  DotCanvas(int columns, int rows, bool braille);

  /// Width in dots: x runs from 0 to width() - 1.
  int width() const { return width_; }
  /// Height in dots: y runs from 0 to height() - 1.
  int height() const { return height_; }

  /// Sets the dots of a straight line with both its ends. (0, 0) is at the top left, y points down;
  /// dots outside the canvas are ignored.
  void Line(int x0, int y0, int x1, int y1);

  /// The rows of characters in UTF-8, each as wide as the canvas.
  std::vector<std::string> Rows() const;

 private:
  /// Sets one dot, unless it lies outside.
  void Set(int x, int y);

  const int columns_;
  const bool braille_;
  const int width_;
  const int height_;
  /// The dots of each character, row by row: bits of Braille, or 1.
  std::vector<std::uint8_t> cells_;
};

}  // namespace contact::cli
