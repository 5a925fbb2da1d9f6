#pragma once

#include <string>
#include <string_view>

#include "cli/figures/figure.h"

namespace contact::cli {

/// What a file that is drawn is, by the end of its name: svg unless it is .png, .pdf, .txt, .tex,
/// which is tikz, .gp or .csv.
std::string FormatOf(const std::string& path);

/// How the names of files in a format end: `tex` for tikz, else as the format is called.
std::string EndingOf(const std::string& format);

/// Draws a figure through gnuplot to a file: svg, png, pdf, tikz, or in characters, txt, which are
/// `columns` in a line; or writes the script, gp, or the points, csv. Throws Failure (kLocal) if
/// the file cannot be written, or gnuplot is not installed or fails.
void Draw(const Figure& figure, std::string_view format, const std::string& path,
          int columns = Medium::kColumns);

/// The figure in characters. Throws as Draw does.
std::string DrawText(const Figure& figure, int columns);

/// Runs a script that draws to a file. Throws as Draw does.
void DrawScript(const std::string& script, const std::string& path);

/// The figure as SVG that can stand in an HTML page: no declarations, nothing from elsewhere.
/// Throws as Draw does.
std::string DrawInline(const Figure& figure);

/// The part of an SVG document that can stand in an HTML page.
std::string InlineSvg(std::string_view document);

}  // namespace contact::cli
