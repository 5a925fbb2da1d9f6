#include "cli/paper/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "cli/figures/run/presets.h"

namespace contact::cli {
namespace {

// Adds the curves of one run to a panel, in the colour and under the name of the run.
void AddRun(Figure::Panel&& drawn, const std::string& name, int colour, Figure::Panel* panel) {
  for (Figure::Curve& curve : drawn.curves) {
    if (curve.mark == Figure::Mark::kDashed) continue;  // External forces would hide the others.
    if (!curve.label.empty()) curve.label = fmt::format("{}, {}", name, curve.label);
    if (curve.mark == Figure::Mark::kLine && curve.colour == 1) curve.mark = Figure::Mark::kDashed;
    curve.colour = colour;
    panel->curves.push_back(std::move(curve));
  }
}

}  // namespace

Figure DeformationVelocityFigure(const Data& data) {
  Figure::Panel panel{.x_label = "deformation [m]", .y_label = "|deformation velocity| [m/s]"};
  int colour = -1;
  double restitution = kNoNumber;
  for (const std::vector<double>& row : data.rows) {
    if (row[0] != restitution) {
      restitution = row[0];
      ++colour;
      panel.curves.push_back(
          {fmt::format("ε = {:g}", restitution), colour, Figure::Mark::kLine, {}, {}});
      panel.curves.push_back({"", colour, Figure::Mark::kDashed, {}, {}});
    }
    Figure::Curve& curve = *std::prev(panel.curves.end(), row[2] >= 0 ? 2 : 1);
    curve.x.push_back(row[1]);
    curve.y.push_back(std::abs(row[2]));
  }
  return {"Deformation velocity: compression solid, restitution dashed", {std::move(panel)}};
}

Figure ColumnsFigure(const Data& data, const std::string& y_label,
                     const std::vector<std::string>& labels) {
  Figure::Panel panel{.x_label = "pre-restitution coefficient", .y_label = y_label};
  for (std::size_t i = 0; i < labels.size(); ++i) {
    Figure::Curve curve{labels[i], static_cast<int>(i), Figure::Mark::kLine, {}, {}};
    for (const std::vector<double>& row : data.rows) {
      curve.x.push_back(row[0]);
      curve.y.push_back(row[i + 1]);
    }
    panel.curves.push_back(std::move(curve));
  }
  Figure figure{"", {std::move(panel)}};
  figure.most_colours = labels.size();
  return figure;
}

void AddIdeal(Figure* figure) {
  constexpr int kBlack = 6;
  figure->panels.front().curves.push_back({"", kBlack, Figure::Mark::kDotted, {0, 1}, {0, 1}});
}

Figure VelocitiesFigure(const Solved& run) {
  constexpr std::array kMarks{Figure::Mark::kLine, Figure::Mark::kDashed, Figure::Mark::kDotted};
  Figure figure = PresetFigure("velocity", run);
  for (Figure::Curve& curve : figure.panels.front().curves) {
    if (curve.mark == Figure::Mark::kLine) {
      curve.mark = kMarks.at(static_cast<std::size_t>(curve.colour));
    }
  }
  return figure;
}

Figure ModelsFigure(const std::string& preset, const std::vector<const Solved*>& runs,
                    const std::vector<std::string>& names) {
  Figure figure = PresetFigure(preset, *runs.back());
  Figure::Panel& panel = figure.panels.front();
  panel.curves.clear();
  panel.dashed.clear();
  figure.sources.clear();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Figure::Panel drawn = std::move(PresetFigure(preset, *runs[i]).panels.front());
    for (std::size_t l = 0; l < std::min(panel.labels.size(), drawn.labels.size()); ++l) {
      panel.labels[l].y = std::max(panel.labels[l].y, drawn.labels[l].y);  // Above all peaks.
    }
    figure.sources.push_back(SourceOf(runs[i]->job));
    AddRun(std::move(drawn), names[i], static_cast<int>(i), &panel);
  }
  return figure;
}

}  // namespace contact::cli
