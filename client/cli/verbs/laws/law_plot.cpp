#include "cli/verbs/laws/law_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/figures/draw.h"
#include "cli/paper/figures.h"
#include "cli/verbs/job/options.h"
#include "cli/verbs/laws/law_study.h"

namespace contact::cli {
namespace {

struct ModelPlotArguments {
  std::string what;
  std::vector<std::string> laws;
  std::string file;
};

std::vector<double> Restitutions() {
  std::vector<double> all;
  for (int i = 5; i <= 100; ++i) all.push_back(i * 0.01);
  return all;
}

std::vector<double> Coefficients(const LawEntry& law) {
  if (!law.closed_form()) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("{} has no α that is a function of ε alone", law.name));
  }
  std::vector<double> all;
  for (const double e : Restitutions()) all.push_back(law.alpha(e));
  return all;
}

std::vector<double> Delivered(const LawEntry& law, const Settings& settings) {
  std::vector<LawPoint> points;
  for (const double e : Restitutions()) points.push_back(PointOf(law, e));
  Simulate(&points, settings);
  std::vector<double> all;
  for (const LawPoint& point : points) all.push_back(point.delivered);
  return all;
}

// A row for each restitution, a column for each law.
Data Curves(const std::vector<const LawEntry*>& laws, bool alpha, const Settings& settings) {
  Data data{"laws", {"restitution_in"}, {}};
  for (const double e : Restitutions()) data.rows.push_back({e});
  for (const LawEntry* law : laws) {
    const std::vector<double> values = alpha ? Coefficients(*law) : Delivered(*law, settings);
    for (std::size_t i = 0; i < values.size(); ++i) data.rows[i].push_back(values[i]);
    data.columns.emplace_back(law->name);
  }
  return data;
}

ExitCode Plot(const ModelPlotArguments& arguments, const Settings& settings) {
  FigureFormat(arguments.file, settings);  // Refuses a wrong format before anything is run.
  const bool alpha = arguments.what == "alpha";
  const Data curves = Curves(ChooseLaws(arguments.laws, true), alpha, settings);
  Figure figure = ColumnsFigure(
      curves, alpha ? "hysteresis damping factor coefficient α" : "post-restitution coefficient",
      {curves.columns.begin() + 1, curves.columns.end()});
  figure.title = alpha ? "Coefficient α of the damping factor"
                       : "Restitution that each law delivers; ideal dotted";
  if (!alpha) AddIdeal(&figure);
  WriteFigure(figure, arguments.what, arguments.file, settings);
  return ExitCode::kOk;
}

}  // namespace

void AddLawPlot(CommandLine& line, CLI::App& model) {
  CLI::App* plot = model.add_subcommand(
      "plot",
      "Draw damping laws over the restitution asked for: -o svg, png, pdf, txt, tikz, gp "
      "or csv");
  auto arguments = std::make_shared<ModelPlotArguments>();
  AddOption(line, *plot, "WHAT", &arguments->what, {"alpha", "restitution"},
            "alpha, the coefficient of each law, or restitution, what it gives back")
      ->type_name("")
      ->required();
  AddOption(line, *plot, "LAW", &arguments->laws, ValueKind::kLaw,
            "Laws to draw, such as hunt-crossley. Default: all with a closed form, for which no "
            "server is needed");
  AddFigureFile(line, *plot, &arguments->file, "Where to. Default: WHAT.svg; txt is printed");
  line.SetAction(*plot, arguments, Plot);
}

}  // namespace contact::cli
