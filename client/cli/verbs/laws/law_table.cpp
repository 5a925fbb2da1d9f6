#include "cli/verbs/laws/law_table.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/base/number.h"

namespace contact::cli {
namespace {

using Json = nlohmann::ordered_json;

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
          {"method", point.method()}};
}

template <class Items>
std::string JsonList(const Items& items) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(JsonOf(item));
  return list.dump(2) + "\n";
}

Tone ToneOf(const LawPoint& point, Tone otherwise) {
  return std::abs(point.miss()) > 0.01 ? Tone::kWarning : otherwise;
}

}  // namespace

std::string LawJson(const LawEntry& law) { return JsonOf(law).dump(2) + "\n"; }

std::string LawsJson(const std::vector<LawEntry>& laws) { return JsonList(laws); }

std::string PointsJson(const std::vector<LawPoint>& points) { return JsonList(points); }

Table DeliveryTable(const LawEntry& law, const std::vector<double>& restitutions) {
  Table table({{"ε ASKED", true}, {"α", true}, {"ε DELIVERED", true}, {"MISS", true}});
  for (const double e : restitutions) {
    const LawPoint point = PointOf(law, e);
    table.Add({Digits(e, 6),
               Digits(law.alpha(e), 8),
               Digits(point.delivered, 8),
               {fmt::format("{:+.2f} %", 100 * point.miss()), ToneOf(point, Tone::kPlain)}});
  }
  return table;
}

std::vector<Table::Column> PointColumns() {
  return {{"law"}, {"requested"}, {"delivered"}, {"miss"}, {"method"}};
}

Table PointTable(const std::vector<LawPoint>& points) {
  Table table(PointColumns());
  for (const LawPoint& p : points) {
    table.Add({std::string(p.law->name), fmt::to_string(p.requested), fmt::to_string(p.delivered),
               fmt::to_string(p.miss()), std::string(p.method())});
  }
  return table;
}

std::vector<Table::Column> ComparisonColumns(const std::vector<double>& restitutions) {
  std::vector<Table::Column> columns = {{"LAW"}};
  for (const double e : restitutions) columns.push_back({fmt::to_string(e), true});
  return columns;
}

Table ComparisonTable(const std::vector<LawPoint>& points,
                      const std::vector<double>& restitutions) {
  Table table(ComparisonColumns(restitutions));
  for (auto point = points.begin(); point != points.end();) {
    std::vector<Table::Cell> row = {std::string(point->law->name)};
    for (std::size_t i = 0; i < restitutions.size(); ++i, ++point) {
      row.emplace_back(fmt::format("{:.5f}", point->delivered), ToneOf(*point, Tone::kGood));
    }
    table.Add(std::move(row));
  }
  return table;
}

}  // namespace contact::cli
