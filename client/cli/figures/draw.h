#pragma once

#include <string>
#include <string_view>

#include "cli/figures/figure.h"
#include "cli/figures/gnuplot_terminal.h"
#include "cli/settings/format.h"
#include "cli/settings/settings.h"

namespace contact::cli {

/// The format of a figure by the ending of its file, svg without ending. Throws Failure (kUsage)
/// for an ending of no figure.
OutputFormat FormatOfFigure(const std::string& path);

/// The format of a figure: the one that `-o` names, else that of the ending of `file`. Throws
/// as FormatOfFigure does, and Failure (kUsage) if `-o` names a format that is none of figures.
OutputFormat FigureFormat(const std::string& file, const Settings& settings);

/// The path of a figure: `file`, or, if that is empty, `name` with the ending of the format.
std::string FigurePath(const std::string& file, const std::string& name, const Settings& settings);

/// Draws a figure to FigurePath and prints that path. A txt figure without a file goes to the
/// standard output, as wide as the terminal. Throws as FigureFormat and Draw do.
void WriteFigure(const Figure& figure, const std::string& name, const std::string& file,
                 const Settings& settings, const FigureStyle& style = {});

/// Draws a figure to a file in a format of figures: gp is the script of an svg, csv the points, for
/// which `style` does not matter, the others are drawn through gnuplot. `columns` is the width of
/// txt in characters. Throws Failure (kLocal) if the file cannot be written, or if gnuplot is not
/// installed or fails.
void Draw(const Figure& figure, OutputFormat format, const std::string& path,
          int columns = GnuplotTerminal::kColumns, const FigureStyle& style = {});

/// Runs a gnuplot script that draws to the file `path`. Throws as Draw does.
void DrawScript(const std::string& script, const std::string& path);

/// The figure as an SVG element for an HTML page; it refers to no other file. Throws as Draw does.
std::string DrawInline(const Figure& figure);

/// The `<svg>` element of an SVG document without its title, which browsers show as a tooltip.
std::string InlineSvg(std::string_view document);

}  // namespace contact::cli
