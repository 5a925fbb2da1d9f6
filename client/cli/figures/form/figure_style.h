#pragma once

#include <optional>
#include <string>
#include <vector>

namespace contact::cli {

/// How a figure is to look; by default as its format does by itself.
struct FigureStyle {
  /// Width and height of the whole figure [in].
  struct Size {
    double width = 0;
    double height = 0;
  };
  /// The font of all texts.
  struct Font {
    std::string family = {};  ///< Empty: that of the format.
    double points = 0;        ///< 1/72 in; 0: that of the format.
  };

  std::optional<Size> size = {};
  Font font = {};
  /// For print: black curves that dashes tell apart, no grid, the width of a column.
  bool paper = false;
  /// False to leave out the title, and
  bool title = true;
  /// the line that says where the figure comes from. The file holds both nevertheless.
  bool provenance = true;
  /// Units that the axes are to have, such as `mm`; other axes have the unit that reads best.
  std::vector<std::string> units = {};
};

/// Reads a size such as `85x60mm`, `8.5x6cm` or, in inches, `3.4x2.5`. Throws Failure (kUsage) if
/// it is none, or not from 1 to 100 inches.
FigureStyle::Size ParseSize(const std::string& text);

/// Reads a font such as `Times,9`, `Times` or `9`. Throws Failure (kUsage) if it is none.
FigureStyle::Font ParseFont(const std::string& text);

}  // namespace contact::cli
