#include "cli/text/comparison/comparison_data.h"

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/base/csv.h"
#include "cli/text/comparison/comparison_cells.h"

namespace contact::cli {
namespace {

using Json = nlohmann::ordered_json;
using Result = JobComparison::Result;
using Value = JobComparison::Value;

void Add(const Value& value, CsvWriter* csv) {
  if (const auto* number = std::get_if<double>(&value)) {
    csv->Add(*number);
  } else {
    const auto* word = std::get_if<std::string>(&value);
    csv->Add(word == nullptr ? "-" : *word);
  }
}

Json JsonOf(const Value& value) {
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  const auto* number = std::get_if<double>(&value);
  return number == nullptr || !std::isfinite(*number) ? Json() : Json(*number);
}

}  // namespace

std::string ComparisonJson(const JobComparison& comparison) {
  Json json;
  json["jobs"] = comparison.names;
  json["tolerance"] = {{"absolute", comparison.tolerance.absolute},
                       {"relative", comparison.tolerance.relative}};
  json["equal"] = comparison.Holds();
  json["parameters"] = Json::array();
  for (const auto& [path, values] : comparison.parameters) {
    json["parameters"].push_back({{"path", path}, {"values", values}});
  }
  json["results"] = Json::array();
  for (const Result& result : comparison.results) {
    Json values = Json::array();
    for (const Value& value : result.values) values.push_back(JsonOf(value));
    json["results"].push_back({{"name", result.name},
                               {"unit", result.unit},
                               {"values", std::move(values)},
                               {"judged", result.judged},
                               {"holds", comparison.Holds(result)}});
  }
  return json.dump(2) + "\n";
}

std::string ComparisonCsv(const JobComparison& comparison) {
  const std::size_t jobs = comparison.names.size();
  std::string text;
  CsvWriter csv(&text);
  csv.Add("kind").Add("name").Add("unit");
  for (const std::string& name : comparison.names) csv.Add(name);
  for (std::size_t job = 1; job < jobs; ++job) csv.Add("deviation of " + comparison.names[job]);
  csv.Add("verdict").EndRow();
  for (const auto& parameter : comparison.parameters) {
    csv.Add("parameter").Add(parameter.path).Add("");
    for (const std::string& value : parameter.values) csv.Add(value);
    for (std::size_t job = 0; job < jobs; ++job) csv.Add("");  // No deviations and no verdict.
    csv.EndRow();
  }
  for (const Result& result : comparison.results) {
    csv.Add("result").Add(result.name).Add(result.unit);
    for (const Value& value : result.values) Add(value, &csv);
    for (std::size_t job = 1; job < jobs; ++job) {
      const double deviation = result.Deviation(job);
      std::isnan(deviation) ? csv.Add("") : csv.Add(deviation);
    }
    csv.Add(VerdictOf(comparison, result)).EndRow();
  }
  return text;
}

}  // namespace contact::cli
