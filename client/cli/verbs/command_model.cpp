#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "cli/settings/column_choice.h"
#include "cli/settings/options.h"
#include "cli/text/print_job.h"
#include "cli/verbs/laws/law_commands.h"
#include "cli/verbs/laws/law_study.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct LawArguments {
  std::vector<std::string> laws;
  std::vector<double> restitutions = {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95};
  ColumnChoice columns;
};

std::vector<Table::Column> LawColumns() { return {{"LAW"}, {"FORMULA"}, {"SOURCE", false, 1}}; }

ExitCode List(const ColumnChoice& columns, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson});
  columns.Check(LawColumns(), settings);
  if (settings.output == OutputFormat::kJson) {
    PrintJson(LawsJson(LawCatalogue()), settings);
    return ExitCode::kOk;
  }
  Table table(LawColumns());
  for (const LawEntry& law : LawCatalogue()) {
    table.Add({std::string(law.name), std::string(law.formula), std::string(law.source)});
  }
  fmt::print("{}", table.Text(columns.OutputStyle(settings)));
  return ExitCode::kOk;
}

ExitCode Show(const std::string& name, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson});
  const LawEntry& law = FindLaw(name);
  if (settings.output == OutputFormat::kJson) {
    PrintJson(LawJson(law), settings);
    return ExitCode::kOk;
  }
  fmt::print("{}\nformula  {}\nsource   {}\nrange    {}\n", law.name, law.formula, law.source,
             law.range);
  if (law.closed_form()) {
    fmt::print("\nIn an isolated collision:\n{}",
               DeliveryTable(law, LawArguments().restitutions).Text(settings.OutputStyle()));
  } else {
    fmt::print("delivers what a run shows: contactctl model compare {}\n", law.name);
  }
  return ExitCode::kOk;
}

// A point for each law and restitution.
std::vector<LawPoint> Points(const LawArguments& arguments) {
  std::vector<LawPoint> points;
  for (const LawEntry* law : ChooseLaws(arguments.laws, false)) {
    for (const double e : arguments.restitutions) {
      if (!(e > 0 && e <= 1)) {
        throw Failure(ExitCode::kUsage, fmt::format("--restitution {}: must be in (0, 1]", e));
      }
      points.push_back(PointOf(*law, e));
    }
  }
  return points;
}

ExitCode Compare(const LawArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson, OutputFormat::kCsv});
  const bool csv = settings.output == OutputFormat::kCsv;
  std::vector<LawPoint> points = Points(arguments);
  arguments.columns.Check(csv ? PointColumns() : ComparisonColumns(arguments.restitutions),
                          settings);
  Simulate(&points, settings);
  if (settings.output == OutputFormat::kJson) {
    PrintJson(PointsJson(points), settings);
  } else if (csv) {
    fmt::print("{}", PointTable(points).Csv(arguments.columns.names()));
  } else {
    fmt::print("{}", ComparisonTable(points, arguments.restitutions)
                         .Text(arguments.columns.OutputStyle(settings)));
  }
  return ExitCode::kOk;
}

void AddCompareLaws(CommandLine& line, CLI::App& compare) {
  auto arguments = std::make_shared<LawArguments>();
  AddOption(line, compare, "LAW", &arguments->laws, ValueKind::kLaw,
            "Laws to compare. Default: all");
  Repeatable(compare.add_option("--restitution", arguments->restitutions,
                                "Restitutions to ask for, with commas between. Default: 0.05 to "
                                "0.95"))
      ->type_name("ε,…")
      ->delimiter(',');
  arguments->columns.AddTo(line, compare);
  line.SetAction(compare, arguments, Compare);
}

}  // namespace

void AddModel(CommandLine& line, CLI::App& model) {
  model.require_subcommand(1);
  CLI::App* list = model.add_subcommand("list", "List the laws with formula and source");
  auto columns = std::make_shared<ColumnChoice>();
  columns->AddTo(line, *list, LawColumns());
  line.SetAction(*list, columns, List);

  CLI::App* show = model.add_subcommand("show", "Show one law and what it delivers");
  auto name = std::make_shared<std::string>();
  AddOption(line, *show, "LAW", name.get(), ValueKind::kLaw, "Its name, such as hunt-crossley")
      ->required();
  line.SetAction(*show, name, Show);

  AddCompareLaws(line, *model.add_subcommand("compare",
                                             "Compare the restitution asked for with the one "
                                             "delivered, law by law"));
  AddLawPlot(line, model);
  AddTranslate(line, model);
}

}  // namespace contact::cli
