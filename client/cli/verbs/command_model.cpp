#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "cli/base/number.h"
#include "cli/base/table.h"
#include "cli/settings/column_choice.h"
#include "cli/text/print_job.h"
#include "cli/verbs/commands.h"
#include "cli/verbs/law_plot.h"
#include "cli/verbs/law_study.h"

namespace contact::cli {
namespace {

struct CompareArguments {
  std::vector<std::string> laws;
  std::vector<double> restitutions = {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95};
  ColumnChoice columns;
};

std::string Json(const LawEntry& law) {
  return fmt::format(
      R"({{"law": "{}", "formula": "{}", "source": "{}", "range": "{}", "closed_form": {}}})",
      law.name, law.formula, law.source, law.range, law.closed_form());
}

std::string Json(const LawPoint& point) {
  return fmt::format(
      R"({{"law": "{}", "requested": {}, "delivered": {}, "miss": {}, "method": "{}"}})",
      point.law->name, point.requested, point.delivered, point.miss(), point.method);
}

template <class Items>
std::string JsonList(const Items& items) {
  std::string text = "[\n";
  for (std::size_t i = 0; i < items.size(); ++i) {
    text += fmt::format("  {}{}\n", Json(items[i]), i + 1 < items.size() ? "," : "");
  }
  return text + "]\n";
}

std::string Percent(double miss) { return fmt::format("{:+.2f} %", 100 * miss); }

std::vector<Table::Column> ListColumns() { return {{"LAW"}, {"FORMULA"}, {"SOURCE", false, 1}}; }

ExitCode List(const ColumnChoice& columns, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson});
  columns.Check(ListColumns(), settings);
  if (settings.output == OutputFormat::kJson) {
    PrintJson(JsonList(LawCatalogue()), settings);
    return ExitCode::kOk;
  }
  Table table(ListColumns());
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
    PrintJson(Json(law) + "\n", settings);
    return ExitCode::kOk;
  }
  fmt::print("{}\nformula  {}\nsource   {}\nrange    {}\n", law.name, law.formula, law.source,
             law.range);
  if (!law.closed_form()) {
    fmt::print("delivers what a run shows: contactctl model compare {}\n", law.name);
    return ExitCode::kOk;
  }
  fmt::print("\nIn an isolated collision:\n");
  Table table({{"ε ASKED", true}, {"α", true}, {"ε DELIVERED", true}, {"MISS", true}});
  for (const double e : CompareArguments().restitutions) {
    const double delivered = law.Delivered(e);
    const double miss = delivered / e - 1;
    table.Add({Digits(e, 6),
               Digits(law.alpha(e), 8),
               Digits(delivered, 8),
               {Percent(miss), std::abs(miss) > 0.01 ? Tone::kWarning : Tone::kPlain}});
  }
  fmt::print("{}", table.Text(settings.OutputStyle()));
  return ExitCode::kOk;
}

std::vector<LawPoint> Points(const CompareArguments& arguments) {
  std::vector<const LawEntry*> laws;
  for (const std::string& name : arguments.laws) laws.push_back(&FindLaw(name));
  if (laws.empty()) {
    for (const LawEntry& law : LawCatalogue()) laws.push_back(&law);
  }
  std::vector<LawPoint> points;
  for (const LawEntry* law : laws) {
    for (const double e : arguments.restitutions) {
      if (!(e > 0 && e <= 1)) {
        throw Failure(ExitCode::kUsage, fmt::format("--restitution {}: must be in (0, 1]", e));
      }
      points.push_back({.law = law,
                        .requested = e,
                        .delivered = law->closed_form() ? law->Delivered(e) : 0,
                        .method = law->closed_form() ? "closed form" : "simulation"});
    }
  }
  return points;
}

// Of csv a row for each point; else a column for each restitution asked for.
std::vector<Table::Column> CompareColumns(const CompareArguments& arguments, bool csv) {
  if (csv) return {{"law"}, {"requested"}, {"delivered"}, {"miss"}, {"method"}};
  std::vector<Table::Column> header = {{"LAW"}};
  for (const double e : arguments.restitutions) header.push_back({fmt::to_string(e), true});
  return header;
}

std::string CompareCsv(const std::vector<LawPoint>& points, const CompareArguments& arguments) {
  Table table(CompareColumns(arguments, true));
  for (const LawPoint& p : points) {
    table.Add({std::string(p.law->name), fmt::to_string(p.requested), fmt::to_string(p.delivered),
               fmt::to_string(p.miss()), std::string(p.method)});
  }
  return table.Csv(arguments.columns.names());
}

// A row for each law.
std::string CompareTable(const std::vector<LawPoint>& points, const CompareArguments& arguments,
                         const Style& style) {
  const std::size_t columns = arguments.restitutions.size();
  Table table(CompareColumns(arguments, false));
  for (std::size_t first = 0; first < points.size(); first += columns) {
    std::vector<Table::Cell> row = {std::string(points[first].law->name)};
    for (std::size_t i = first; i < first + columns; ++i) {
      const bool misses = std::abs(points[i].miss()) > 0.01;
      row.emplace_back(fmt::format("{:.5f}", points[i].delivered),
                       misses ? Tone::kWarning : Tone::kGood);
    }
    table.Add(std::move(row));
  }
  return table.Text(style);
}

ExitCode Compare(const CompareArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson, OutputFormat::kCsv});
  std::vector<LawPoint> points = Points(arguments);
  arguments.columns.Check(CompareColumns(arguments, settings.output == OutputFormat::kCsv),
                          settings);
  Simulate(&points, settings);
  if (settings.output == OutputFormat::kJson) {
    PrintJson(JsonList(points), settings);
  } else if (settings.output == OutputFormat::kCsv) {
    fmt::print("{}", CompareCsv(points, arguments));
  } else {
    fmt::print("{}", CompareTable(points, arguments, arguments.columns.OutputStyle(settings)));
  }
  return ExitCode::kOk;
}

}  // namespace

void AddModelCommands(CLI::App& app, const Settings& settings, Action* action) {
  CLI::App* model = app.add_subcommand("model", "Show and compare damping laws");
  model->require_subcommand(1);
  CLI::App* list = model->add_subcommand("list", "List the laws with formula and source");
  auto columns = std::make_shared<ColumnChoice>();
  columns->AddTo(*list, ListColumns());
  list->callback([columns, &settings, action] {
    *action = [columns, &settings] { return List(*columns, settings); };
  });

  CLI::App* show = model->add_subcommand("show", "Show one law and what it delivers");
  auto name = std::make_shared<std::string>();
  show->add_option("LAW", *name, "Its name, such as hunt-crossley")->required();
  show->callback(
      [name, &settings, action] { *action = [name, &settings] { return Show(*name, settings); }; });

  CLI::App* compare = model->add_subcommand(
      "compare", "Compare the restitution asked for with the one delivered, law by law");
  auto arguments = std::make_shared<CompareArguments>();
  compare->add_option("LAW", arguments->laws, "Laws to compare. Default: all");
  compare
      ->add_option("--restitution", arguments->restitutions,
                   "Restitutions to ask for, with commas between. Default: 0.05 to 0.95")
      ->type_name("ε,…")
      ->delimiter(',')
      ->take_all()
      ->allow_extra_args(false);
  arguments->columns.AddTo(*compare);
  compare->callback([arguments, &settings, action] {
    *action = [arguments, &settings] { return Compare(*arguments, settings); };
  });
  AddLawPlotCommand(*model, settings, action);
}

}  // namespace contact::cli
