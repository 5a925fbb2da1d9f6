#include "cli/text/comparison/render_verification.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/spelling.h"
#include "cli/base/number.h"
#include "cli/base/table.h"

namespace contact::cli {
namespace {

using Json = nlohmann::ordered_json;
using Number = Verification::Number;

constexpr std::size_t kMostNumbers = 60;

Json Finite(double value) { return std::isfinite(value) ? Json(value) : Json(); }

std::string Resolution(double resolution) { return Digits(resolution, 6); }

std::string RunTable(const Verification& verification, bool kept, const Style& style) {
  const RefinementPlan& plan = verification.plan;
  Table table({{plan.adaptive ? "TOLERANCE" : "STEP [s]", true},
               {"CYCLES", true},
               {"STEPS", true},
               {"WALL TIME", true},
               {"JOB"}});
  const auto add = [&table](double resolution, const v1::Job& job, bool named) {
    table.Add({Resolution(resolution), fmt::to_string(job.cycles_size()),
               fmt::to_string(job.summary().steps()), Seconds(job.summary().wall_time_s()),
               named ? job.name() : "-"});
  };
  add(plan.own, verification.job, true);
  for (std::size_t i = 0; i < verification.runs.size(); ++i) {
    add(plan.resolutions[i], verification.runs[i], kept);
  }
  return table.Text(style);
}

std::vector<Table::Column> NumberColumns(const RefinementPlan& plan) {
  std::vector<Table::Column> columns{{"NUMBER"}, {"JOB", true}};
  for (const double resolution : plan.resolutions) {
    columns.push_back({"AT " + Resolution(resolution), true, 1});
  }
  columns.insert(columns.end(),
                 {{"ORDER", true}, {"RICHARDSON", true, 2}, {"JOB IS OFF", true}, {""}});
  return columns;
}

Table::Cell OrderCell(const Verification& verification, const Number& number) {
  const double order = number.refinement.order;
  return {std::isnan(order) ? "-" : fmt::format("{:.2f}", order),
          verification.ShowsOrder(number) ? Tone::kGood : Tone::kPlain};
}

std::string NumberTable(const Verification& verification, const Style& style) {
  constexpr int kDigits = 11;
  Table table(NumberColumns(verification.plan));
  for (const Number& number : verification.numbers) {
    const Refinement& refinement = number.refinement;
    std::vector<Table::Cell> row{fmt::format("{} [{}]", number.name, number.unit),
                                 Digits(number.own, kDigits)};
    for (const double value : number.values) row.emplace_back(Digits(value, kDigits));
    row.push_back(OrderCell(verification, number));
    row.emplace_back(refinement.settles ? Digits(refinement.limit, kDigits) : "-");
    row.emplace_back(RelativeError(number.distance));
    row.emplace_back(number.Holds() ? "ok" : "FAR", number.Holds() ? Tone::kGood : Tone::kBad);
    table.Add(std::move(row));
  }
  return table.Text(style, kMostNumbers, "… {} more numbers; -o json prints all");
}

std::string Differences(const Verification& verification, const Style& style) {
  constexpr std::size_t kMost = 5;
  const auto& all = verification.differences;
  std::string text;
  for (std::size_t i = 0; i < std::min(all.size(), kMost); ++i) {
    text += Paint("the runs differ: ", Tone::kWarning, style) + all[i] + "\n";
  }
  if (all.size() <= kMost) return text;
  return text + fmt::format("… {} more differences; -o json prints all\n", all.size() - kMost);
}

// What the orders say of the method.
std::string OrderText(const Verification& verification) {
  const RefinementPlan& plan = verification.plan;
  const auto& numbers = verification.numbers;
  if (plan.adaptive) {
    double moved = 0;
    for (const Number& number : numbers) {
      moved = std::max(moved, std::abs(number.values[2] - number.values[1]) / number.scale);
    }
    return fmt::format("from {} to {} no number moves by more than {}\n",
                       Resolution(plan.resolutions[1]), Resolution(plan.resolutions[2]),
                       RelativeError(moved));
  }
  const auto shown = std::ranges::count_if(
      numbers, [&](const Number& number) { return verification.ShowsOrder(number); });
  const auto exact = std::ranges::count_if(numbers, [](const Number& number) {
    return number.refinement.settles && std::isnan(number.refinement.order);
  });
  return fmt::format("order {:g}, that of RK4 here, is shown by {} of {}{}\n", plan.order, shown,
                     Count(std::ssize(numbers), "number", "numbers"),
                     exact == 0 ? "" : fmt::format("; {} at round-off", exact));
}

std::string Verdict(const Verification& verification, const Style& style) {
  const bool holds = verification.Holds();
  return fmt::format("{} {:g} of where finer runs lead\n",
                     Paint(holds ? "verified: all within" : "NOT VERIFIED: not all within",
                           holds ? Tone::kGood : Tone::kBad, style),
                     verification.tolerance);
}

Json JsonOf(const v1::Job& job, double resolution, bool named) {
  return {{"value", resolution},
          {"job", named ? Json(job.name()) : Json()},
          {"cycles", job.cycles_size()},
          {"steps", job.summary().steps()},
          {"wall_time_s", job.summary().wall_time_s()}};
}

Json JsonOf(const Number& number) {
  Json values = Json::array();
  for (const double value : number.values) values.push_back(Finite(value));
  const Refinement& refinement = number.refinement;
  return {{"name", number.name},
          {"unit", number.unit},
          {"own", Finite(number.own)},
          {"values", std::move(values)},
          {"order", Finite(refinement.order)},
          {"richardson", refinement.settles ? Finite(refinement.limit) : Json()},
          {"distance", Finite(number.distance)},
          {"allowed", Finite(number.allowed)},
          {"holds", number.Holds()}};
}

}  // namespace

std::string RenderVerification(const Verification& verification, bool kept, const Style& style) {
  return fmt::format("{}\n{}\n{}{}{}", RunTable(verification, kept, style),
                     NumberTable(verification, style), Differences(verification, style),
                     OrderText(verification), Verdict(verification, style));
}

std::string VerificationJson(const Verification& verification, bool kept) {
  const RefinementPlan& plan = verification.plan;
  Json json;
  json["field"] = plan.Field();
  json["job"] = JsonOf(verification.job, plan.own, true);
  json["runs"] = Json::array();
  for (std::size_t i = 0; i < verification.runs.size(); ++i) {
    json["runs"].push_back(JsonOf(verification.runs[i], plan.resolutions[i], kept));
  }
  json["order"] = plan.order > 0 ? Json(plan.order) : Json();
  json["tolerance"] = verification.tolerance;
  json["holds"] = verification.Holds();
  json["differences"] = verification.differences;
  json["numbers"] = Json::array();
  for (const Number& number : verification.numbers) json["numbers"].push_back(JsonOf(number));
  return json.dump(2) + "\n";
}

}  // namespace contact::cli
