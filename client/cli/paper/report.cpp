#include "cli/paper/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/base/csv.h"
#include "cli/base/number.h"
#include "cli/base/table.h"
#include "cli/base/text_file.h"

namespace contact::cli {
namespace {

std::string Csv(const Data& data) {
  std::string text;
  CsvWriter csv(&text);
  csv.Row(data.columns);
  for (const std::vector<double>& row : data.rows) {
    for (const double value : row) csv.Add(value);
    csv.EndRow();
  }
  return text;
}

// NaN, which JSON lacks, is null.
std::string Json(const PaperItem& item) {
  nlohmann::ordered_json json;
  json["id"] = item.id;
  json["title"] = item.title;
  json["holds"] = item.holds();
  if (!item.note.empty()) json["note"] = item.note;
  json["numbers"] = nlohmann::ordered_json::array();
  for (const Comparison& n : item.numbers) {
    json["numbers"].push_back({{"what", n.what},
                               {"published", n.published},
                               {"process", n.process},
                               {"deviation", n.deviation()},
                               {"documented_deviation", n.limit},
                               {"converged", n.converged},
                               {"holds", n.holds()},
                               {"why", n.why}});
  }
  return json.dump(2) + "\n";
}

Table::Cell Verdict(const Comparison& n) {
  if (std::isnan(n.limit)) return {""};
  return n.holds() ? Table::Cell("ok", Tone::kGood) : Table::Cell("DIFFERS", Tone::kBad);
}

void AddRows(const PaperItem& item, Table* table) {
  for (const Comparison& n : item.numbers) {
    table->Add({item.id, n.what, Short(n.published), Short(n.process), DeviationText(n),
                LimitText(n), Verdict(n), Short(n.converged), n.why});
  }
}

Table NumberTable() {
  return Table({{"ITEM"},
                {"NUMBER"},
                {"PUBLISHED", true},
                {"PROCESS", true},
                {"DEVIATION", true},
                {"LIMIT", true, 2},
                {""},
                {"CONVERGED", true},
                {"WHY", false, 1}});
}

std::string Note(const PaperItem& item, const std::string& before, const Style& style) {
  return item.note.empty() ? "" : Wrap("\n" + before + item.note + "\n", style);
}

}  // namespace

bool Comparison::holds() const {
  return std::isnan(limit) || std::abs(deviation()) <= limit * (1 + 1e-12);
}

bool PaperItem::holds() const { return std::ranges::all_of(numbers, &Comparison::holds); }

std::string Short(double value) { return std::isnan(value) ? "" : fmt::format("{:.5g}", value); }

std::string DeviationText(const Comparison& number) {
  return std::isnan(number.limit) ? "" : fmt::format("{:+.1e}", number.deviation());
}

std::string LimitText(const Comparison& number) {
  return std::isnan(number.limit) ? "" : fmt::format("{:.1g}", number.limit);
}

void Write(const PaperItem& item, const std::filesystem::path& directory) {
  for (const Data& data : item.data) WriteText(Csv(data), directory / (data.name + ".csv"));
  if (item.numbers.empty()) return;
  Table table = NumberTable();
  AddRows(item, &table);
  WriteText(item.title + "\n\n" + table.Text(Style{}) + Note(item, "", Style{}),
            directory / (item.id + ".txt"));
  WriteText(Json(item), directory / (item.id + ".json"));
}

std::string Summary(const std::vector<PaperItem>& items, const Style& style) {
  if (std::ranges::all_of(items, [](const PaperItem& item) { return item.numbers.empty(); })) {
    return "";
  }
  Table table = NumberTable();
  for (const PaperItem& item : items) AddRows(item, &table);
  std::string text = table.Text(style);
  for (const PaperItem& item : items) text += Note(item, item.id + ": ", style);
  return text;
}

}  // namespace contact::cli
