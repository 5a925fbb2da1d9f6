#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/base/number.h"
#include "cli/base/table.h"
#include "cli/settings/column_choice.h"
#include "cli/text/print_job.h"
#include "cli/verbs/law_plot.h"
#include "cli/verbs/law_study.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

using Json = nlohmann::ordered_json;

struct LawArguments {
  std::vector<std::string> laws;
  std::vector<double> restitutions = {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95};
  ColumnChoice columns;
};

Json JsonOf(const LawEntry& law) {
  return {{"law", law.name},
          {"formula", law.formula},
          {"source", law.source},
          {"range", law.range},
          {"closed_form", law.closed_form()}};
}

Json JsonOf(const LawPoint& point) {
  return {{"law", point.law->name},
          {"requested", point.requested},
          {"delivered", point.delivered},
          {"miss", point.miss()},
          {"method", point.method}};
}

template <class Items>
Json JsonList(const Items& items) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(JsonOf(item));
  return list;
}

void Print(const Json& json, const Settings& settings) { PrintJson(json.dump(2) + "\n", settings); }

// A miss of more than 1 % stands out.
Tone ToneOf(double miss, Tone otherwise = Tone::kPlain) {
  return std::abs(miss) > 0.01 ? Tone::kWarning : otherwise;
}

std::string Percent(double miss) { return fmt::format("{:+.2f} %", 100 * miss); }

std::vector<Table::Column> ListColumns() { return {{"LAW"}, {"FORMULA"}, {"SOURCE", false, 1}}; }

ExitCode List(const ColumnChoice& columns, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson});
  columns.Check(ListColumns(), settings);
  if (settings.output == OutputFormat::kJson) {
    Print(JsonList(LawCatalogue()), settings);
    return ExitCode::kOk;
  }
  Table table(ListColumns());
  for (const LawEntry& law : LawCatalogue()) {
    table.Add({std::string(law.name), std::string(law.formula), std::string(law.source)});
  }
  fmt::print("{}", table.Text(columns.OutputStyle(settings)));
  return ExitCode::kOk;
}

// What a law with a closed form delivers, a row for each restitution asked for.
Table Deliveries(const LawEntry& law) {
  Table table({{"ε ASKED", true}, {"α", true}, {"ε DELIVERED", true}, {"MISS", true}});
  for (const double e : LawArguments().restitutions) {
    const double delivered = law.Delivered(e);
    const double miss = delivered / e - 1;
    table.Add({Digits(e, 6),
               Digits(law.alpha(e), 8),
               Digits(delivered, 8),
               {Percent(miss), ToneOf(miss)}});
  }
  return table;
}

ExitCode Show(const std::string& name, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson});
  const LawEntry& law = FindLaw(name);
  if (settings.output == OutputFormat::kJson) {
    Print(JsonOf(law), settings);
    return ExitCode::kOk;
  }
  fmt::print("{}\nformula  {}\nsource   {}\nrange    {}\n", law.name, law.formula, law.source,
             law.range);
  if (law.closed_form()) {
    fmt::print("\nIn an isolated collision:\n{}", Deliveries(law).Text(settings.OutputStyle()));
  } else {
    fmt::print("delivers what a run shows: contactctl model compare {}\n", law.name);
  }
  return ExitCode::kOk;
}

// The laws with these names; all if there are none.
std::vector<const LawEntry*> Laws(const std::vector<std::string>& names) {
  std::vector<const LawEntry*> laws;
  for (const std::string& name : names) laws.push_back(&FindLaw(name));
  if (!laws.empty()) return laws;
  for (const LawEntry& law : LawCatalogue()) laws.push_back(&law);
  return laws;
}

// A point for each law and restitution; without closed form what it delivers is still unknown.
std::vector<LawPoint> Points(const LawArguments& arguments) {
  std::vector<LawPoint> points;
  for (const LawEntry* law : Laws(arguments.laws)) {
    for (const double e : arguments.restitutions) {
      if (!(e > 0 && e <= 1)) {
        throw Failure(ExitCode::kUsage, fmt::format("--restitution {}: must be in (0, 1]", e));
      }
      const bool closed = law->closed_form();
      points.push_back({.law = law,
                        .requested = e,
                        .delivered = closed ? law->Delivered(e) : 0,
                        .method = closed ? "closed form" : "simulation"});
    }
  }
  return points;
}

// CSV has a row for each point, a table a column for each restitution asked for.
std::vector<Table::Column> CompareColumns(const LawArguments& arguments, bool csv) {
  if (csv) return {{"law"}, {"requested"}, {"delivered"}, {"miss"}, {"method"}};
  std::vector<Table::Column> header = {{"LAW"}};
  for (const double e : arguments.restitutions) header.push_back({fmt::to_string(e), true});
  return header;
}

std::string CompareCsv(const std::vector<LawPoint>& points, const LawArguments& arguments) {
  Table table(CompareColumns(arguments, true));
  for (const LawPoint& p : points) {
    table.Add({std::string(p.law->name), fmt::to_string(p.requested), fmt::to_string(p.delivered),
               fmt::to_string(p.miss()), std::string(p.method)});
  }
  return table.Csv(arguments.columns.names());
}

// A row for each law.
std::string CompareTable(const std::vector<LawPoint>& points, const LawArguments& arguments,
                         const Style& style) {
  const std::size_t columns = arguments.restitutions.size();
  Table table(CompareColumns(arguments, false));
  for (std::size_t first = 0; first < points.size(); first += columns) {
    std::vector<Table::Cell> row = {std::string(points[first].law->name)};
    for (std::size_t i = first; i < first + columns; ++i) {
      row.emplace_back(fmt::format("{:.5f}", points[i].delivered),
                       ToneOf(points[i].miss(), Tone::kGood));
    }
    table.Add(std::move(row));
  }
  return table.Text(style);
}

ExitCode Compare(const LawArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson, OutputFormat::kCsv});
  std::vector<LawPoint> points = Points(arguments);
  arguments.columns.Check(CompareColumns(arguments, settings.output == OutputFormat::kCsv),
                          settings);
  Simulate(&points, settings);
  if (settings.output == OutputFormat::kJson) {
    Print(JsonList(points), settings);
  } else if (settings.output == OutputFormat::kCsv) {
    fmt::print("{}", CompareCsv(points, arguments));
  } else {
    fmt::print("{}", CompareTable(points, arguments, arguments.columns.OutputStyle(settings)));
  }
  return ExitCode::kOk;
}

void AddCompareLaws(CommandLine& line, CLI::App& compare) {
  auto arguments = std::make_shared<LawArguments>();
  line.SetKind(compare.add_option("LAW", arguments->laws, "Laws to compare. Default: all"),
               ValueKind::kLaw);
  compare
      .add_option("--restitution", arguments->restitutions,
                  "Restitutions to ask for, with commas between. Default: 0.05 to 0.95")
      ->type_name("ε,…")
      ->delimiter(',')
      ->take_all()
      ->allow_extra_args(false);
  arguments->columns.AddTo(line, compare);
  line.SetAction(compare, arguments, Compare);
}

}  // namespace

void AddModel(CommandLine& line, CLI::App& model) {
  model.require_subcommand(1);
  CLI::App* list = model.add_subcommand("list", "List the laws with formula and source");
  auto columns = std::make_shared<ColumnChoice>();
  columns->AddTo(line, *list, ListColumns());
  line.SetAction(*list, columns, List);

  CLI::App* show = model.add_subcommand("show", "Show one law and what it delivers");
  auto name = std::make_shared<std::string>();
  line.SetKind(show->add_option("LAW", *name, "Its name, such as hunt-crossley"), ValueKind::kLaw)
      ->required();
  line.SetAction(*show, name, Show);

  AddCompareLaws(line, *model.add_subcommand("compare",
                                             "Compare the restitution asked for with the one "
                                             "delivered, law by law"));
  AddLawPlot(line, model);
}

}  // namespace contact::cli
