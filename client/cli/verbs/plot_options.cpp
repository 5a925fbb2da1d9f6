#include "cli/verbs/plot_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/base/failure.h"
#include "cli/figures/form/axis_unit.h"
#include "cli/verbs/job/options.h"

namespace contact::cli {
namespace {

bool HasUnit(const Figure& figure, const std::string& unit) {
  return std::ranges::any_of(figure.panels, [&](const Figure::Panel& panel) {
    return NamedUnit(panel.x_label, unit) || NamedUnit(panel.y_label, unit);
  });
}

bool HasPositive(const Figure::Panel& panel) {
  return std::ranges::any_of(panel.curves, [](const Figure::Curve& curve) {
    return std::ranges::any_of(curve.y, [](double y) { return y > 0; });
  });
}

}  // namespace

void PlotOptions::AddTo(CommandLine& line, CLI::App& command) {
  AddPart(line, command);
  AddLook(line, command);
}

void PlotOptions::AddPart(CommandLine& line, CLI::App& command) {
  Repeatable(AddListOption(line, command, "--contacts", &part_.contacts, ValueKind::kContact,
                           "Only these contacts and their bodies"));
  command
      .add_option("--from", part_.from,
                  "Only from this simulated time on; for hysteresis, restitution and iterations "
                  "the cycles that overlap the time window")
      ->type_name("SECONDS");
  command.add_option("--to", part_.to, "Only up to this simulated time")->type_name("SECONDS");
}

void PlotOptions::AddLook(CommandLine& line, CLI::App& command) {
  line.SetWords(
          command.add_option("--style", style_,
                             "colour, or paper for print: black lines told apart by dashes, a "
                             "column of 3.4 in, no title and no line below"),
          {"colour", "paper"})
      ->type_name("STYLE")
      ->capture_default_str();
  command
      .add_option("--size", size_,
                  "Width and height, such as 85x60mm, 8.5x6cm or, in inches, 3.4x2.5. Default: "
                  "8x5in, and 8x7in for two panels")
      ->type_name("WxH");
  command
      .add_option("--font", font_,
                  "Font and its size in points, such as Times,9; either may be left out. tikz has "
                  "the font of the document")
      ->type_name("FONT");
  CLI::Option* units = Repeatable(
      AddListOption(line, command, "--unit", &units_, ValueKind::kAny,
                    "Units of the axes, such as ms,µm,kN; µ may be written u. Default: those "
                    "that give few digits. csv has SI units without prefix"));
  line.SuggestWords(units, {"s", "ms", "µs", "m", "mm", "µm", "N", "kN", "m/s", "mm/s", "J", "mJ"})
      ->type_name("UNIT,…");
  command.add_flag("--log", log_, "A logarithmic y axis, on which values <= 0 have no place");
  command.add_flag("--no-title", no_title_, "Leave out the title above the figure");
  command.add_flag("--no-provenance", no_provenance_,
                   "Leave out the line below that names job and server; the file holds it "
                   "nevertheless, but for txt");
}

FigureStyle PlotOptions::Look() const {
  FigureStyle style{.paper = style_ == "paper",
                    .title = !no_title_,
                    .provenance = !no_provenance_,
                    .units = units_};
  if (!size_.empty()) style.size = ParseSize(size_);
  if (!font_.empty()) style.font = ParseFont(font_);
  return style;
}

void PlotOptions::Adapt(Figure* figure) const {
  for (const std::string& unit : units_) {
    if (HasUnit(*figure, unit)) continue;
    throw Failure(ExitCode::kUsage,
                  fmt::format("--unit {}: no axis of this figure can have it", unit));
  }
  if (!log_) return;
  for (Figure::Panel& panel : figure->panels) {
    if (!HasPositive(panel)) {
      throw Failure(ExitCode::kUsage, fmt::format("--log: {} has no value above 0", panel.y_label));
    }
    panel.log_y = true;
    panel.lowest_y.reset();
  }
}

}  // namespace contact::cli
