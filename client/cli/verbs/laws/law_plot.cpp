#include <fmt/format.h>

#include <memory>
#include <utility>

#include "cli/base/csv.h"
#include "cli/settings/options.h"
#include "cli/verbs/job/contactsim.h"
#include "cli/verbs/laws/law_commands.h"
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
std::string Curves(const std::vector<const LawEntry*>& laws, bool alpha, const Settings& settings) {
  std::vector<std::string> header = {"pre-restitution coefficient"};
  std::vector<std::vector<double>> columns = {Restitutions()};
  for (const LawEntry* law : laws) {
    header.emplace_back(law->name);
    columns.push_back(alpha ? Coefficients(*law) : Delivered(*law, settings));
  }
  std::string text;
  CsvWriter csv(&text);
  csv.Row(header);
  for (std::size_t i = 0; i < columns.front().size(); ++i) {
    for (const std::vector<double>& column : columns) csv.Add(column[i]);
    csv.EndRow();
  }
  return text;
}

ExitCode Plot(const ModelPlotArguments& arguments, const Settings& settings) {
  const bool alpha = arguments.what == "alpha";
  std::vector<std::string> words = {
      "curves",
      alpha ? "--title=Coefficient α of the damping factor"
            : "--title=Restitution that each law delivers; ideal dotted",
      alpha ? "--y-label=hysteresis damping factor coefficient α"
            : "--y-label=post-restitution coefficient"};
  if (!alpha) words.emplace_back("--ideal");
  // A wrong format is refused before anything is run.
  for (std::string& word : FigureWords(arguments.file, arguments.what, settings)) {
    words.push_back(std::move(word));
  }
  RunContactsim(words, settings, Curves(ChooseLaws(arguments.laws, true), alpha, settings));
  return ExitCode::kOk;
}

}  // namespace

void AddLawPlot(CommandLine& line, CLI::App& model) {
  CLI::App* plot = model.add_subcommand(
      "plot",
      "Draw damping laws over the restitution asked for: -o svg, png, pdf, eps, pgf, txt or csv");
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
