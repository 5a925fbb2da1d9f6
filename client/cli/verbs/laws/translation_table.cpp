#include "cli/verbs/laws/translation_table.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/base/number.h"

namespace contact::cli {
namespace {

using translate::Rebound;
using translate::SteppedRebound;
using translate::Tool;
using translate::Translation;
using Json = nlohmann::ordered_json;

std::string Ratio(double value) { return std::isnan(value) ? "-" : fmt::format("{:.5f}", value); }

std::string Ratio(const std::optional<double>& value) { return value ? Ratio(*value) : "-"; }

// The rebound's velocity ratio that the tool really delivers: at its step, if that is known.
double Final(const Translation& found) {
  return found.stepped ? found.stepped->mean : found.loaded.velocity_ratio;
}

Json Number(double value) { return std::isnan(value) ? Json(nullptr) : Json(value); }

Json DeliveredJson(const Rebound& alone, const Rebound& loaded) {
  return {{"restitution_alone", Number(alone.restitution)},
          {"restitution", Number(loaded.restitution)},
          {"velocity_ratio", loaded.velocity_ratio},
          {"contact_time_s", loaded.duration},
          {"deformation_m", loaded.deformation},
          {"peak_force_n", loaded.peak_force},
          {"largest_pull_n", loaded.pull}};
}

Json JsonOf(const Translation& found) {
  const Tool& tool = *found.tool;
  Json json = {{"tool", tool.name}, {"title", tool.title}, {"source", tool.source}};
  json["parameters"] = Json::array();
  for (std::size_t i = 0; i < found.values.size(); ++i) {
    json["parameters"].push_back({{"name", tool.parameters[i].name},
                                  {"value", found.values[i]},
                                  {"unit", tool.parameters[i].unit}});
  }
  json["line"] = found.values.empty() ? Json(nullptr) : Json(LineOf(tool, found.values));
  json["delivered"] =
      found.values.empty() ? Json(nullptr) : DeliveredJson(found.alone, found.loaded);
  json["textbook_restitution"] = found.textbook ? Json(*found.textbook) : Json(nullptr);
  json["at_step"] = nullptr;
  if (found.stepped) {
    const SteppedRebound& at = *found.stepped;
    json["at_step"] = {{"least", at.least}, {"mean", at.mean}, {"most", at.most}};
  }
  json["warnings"] = found.warnings;
  return json;
}

Json JsonOf(const std::vector<Translation>& all) {
  Json list = Json::array();
  for (const Translation& found : all) list.push_back(JsonOf(found));
  return list;
}

// A text; of the first row of a tool only.
Table::Cell FirstOnly(std::size_t row, const std::string& text) { return {row == 0 ? text : ""}; }

void AddRows(const Translation& found, Table* table) {
  const Tool& tool = *found.tool;
  const std::string none = "-";
  if (found.values.empty()) {
    table->Add({std::string(tool.name),
                {found.warnings.front(), Tone::kWarning},
                none,
                std::string(),
                none,
                none,
                none});
  }
  for (std::size_t i = 0; i < found.values.size(); ++i) {
    table->Add({FirstOnly(i, std::string(tool.name)), std::string(tool.parameters[i].name),
                Digits(found.values[i], 8), std::string(tool.parameters[i].unit),
                FirstOnly(i, Ratio(found.alone.restitution)), FirstOnly(i, Ratio(Final(found))),
                FirstOnly(i, Ratio(found.textbook))});
  }
}

}  // namespace

Table TranslationTable(const std::vector<Translation>& translations) {
  Table table({{"TOOL"},
               {"PARAMETER"},
               {"VALUE", true},
               {"UNIT"},
               {"ε", true},
               {"REBOUND", true},
               {"TEXTBOOK ε", true, 1}});
  for (const Translation& found : translations) AddRows(found, &table);
  return table;
}

std::string TranslationLines(const std::vector<Translation>& translations) {
  std::string text;
  for (const Translation& found : translations) {
    text += fmt::format("\n{}\n", found.tool->title);
    if (!found.values.empty()) text += fmt::format("  {}\n", LineOf(*found.tool, found.values));
    for (const std::string& warning : found.warnings) text += fmt::format("  - {}\n", warning);
  }
  return text;
}

Table ReboundTable(const std::vector<Translation>& rebounds,
                   const std::vector<double>& velocities) {
  Table table({{"v [m/s]", true},
               {"ε", true},
               {"REBOUND", true},
               {"CONTACT TIME [s]", true},
               {"DEFORMATION [m]", true},
               {"PEAK FORCE [N]", true}});
  for (std::size_t i = 0; i < rebounds.size(); ++i) {
    const Translation& found = rebounds[i];
    table.Add({Digits(velocities[i], 6), Ratio(found.loaded.restitution), Ratio(Final(found)),
               Digits(found.loaded.duration, 5), Digits(found.loaded.deformation, 5),
               Digits(found.loaded.peak_force, 5)});
  }
  return table;
}

std::string TranslationJson(const std::vector<Translation>& rebounds,
                            const std::vector<double>& velocities,
                            const std::vector<Translation>& translations) {
  Json json = Json::object();
  if (!rebounds.empty()) {
    json["rebounds"] = JsonOf(rebounds);
    for (std::size_t i = 0; i < velocities.size(); ++i) {
      json["rebounds"][i]["velocity_m_per_s"] = velocities[i];
    }
  }
  json["translations"] = JsonOf(translations);
  return json.dump(2) + "\n";
}

}  // namespace contact::cli
