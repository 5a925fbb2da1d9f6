#include "cli/text/render_groups.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "cli/base/number.h"
#include "cli/base/table.h"
#include "cli/text/render_ledger.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostGroupRows = 40;

Table MakeTable() {
  return Table({{"CONTACT"},
                {"GROUP", true},
                {"CYCLES"},
                {"END", false, 2},
                {"STATUS"},
                {"GREW", false, 3},
                {"μ", true},
                {"ε IN", true},
                {"ε OUT", true},
                {"ERROR", true},
                {"t START [s]", true, 1},
                {"t END [s]", true, 1},
                {"W_c [J]", true, Table::kOnlyWide},
                {"W_r [J]", true, Table::kOnlyWide},
                {"RESIDUAL", true, Table::kOnlyWide}});
}

std::vector<Table::Cell> Row(const v1::Group& group) {
  const bool grown = group.growth() != v1::Group::NOT_GROWN;
  return {group.contact(),
          fmt::to_string(group.number()),
          CyclesOf(group),
          v1::Cycle::End_Name(group.end()),
          {v1::Cycle::Status_Name(group.status()), ToneOf(group.status())},
          grown ? v1::Group::Growth_Name(group.growth()) : "-",
          Digits(group.mu(), 7),
          Digits(group.restitution_in(), 6),
          Digits(group.restitution_out(), 8),
          RelativeError(RestitutionError(group.restitution_out(), group.restitution_in())),
          Digits(group.start_time_s(), 7),
          Digits(group.end_time_s(), 7),
          Digits(group.work_compression_j(), 7),
          Digits(group.work_restitution_j(), 7),
          RelativeError(group.residual())};
}

// `0.71 at μ = 2.1e8`.
std::string At(double restitution, double mu) {
  return fmt::format("{} at μ = {}", Digits(restitution, 6), Digits(mu, 6));
}

// A line for a group of which no μ gives the ε asked for, else empty.
std::string NoSolution(const v1::Group& group) {
  const std::string certificate = Certificate(group);
  if (certificate.empty()) return "";
  const bool asked = group.status() != v1::Cycle::RELEASED;
  return fmt::format(
      "{} group {}: {}{}\n", group.contact(), group.number(),
      asked ? fmt::format("no μ gives a restitution of {}: ", Digits(group.restitution_in(), 6))
            : "",
      certificate);
}

// A line for a group that larger μ solve, too, else empty.
std::string OtherRoots(const v1::Group& group) {
  if (group.other_roots().empty()) return "";
  std::vector<std::string> roots;
  for (const double mu : group.other_roots()) roots.push_back(Digits(mu, 6));
  return fmt::format("{} group {}: the smallest μ with a restitution of {}; so has {}\n",
                     group.contact(), group.number(), Digits(group.restitution_in(), 6),
                     fmt::join(roots, ", "));
}

std::string Released(const v1::Group& group) {
  const double given = -group.work_restitution_j();
  return fmt::format("it gives back {} was stored before",
                     std::isnan(given) ? "what" : Digits(given, 6) + " J that");
}

// What the search reached of a group that no μ solves.
std::string Reached(const v1::Group& group) {
  const std::string much = At(group.too_much_restitution(), group.too_much_mu());
  const std::string little = At(group.too_little_restitution(), group.too_little_mu());
  if (!group.has_too_much_mu()) return "too little comes back at every μ: ε is " + little;
  if (!group.has_too_little_mu()) return "too much comes back at every μ: ε is " + much;
  if (group.too_little_restitution() > 0)
    return fmt::format("it jumps from {} to {}", much, little);
  return fmt::format("it is {}, and with μ = {} the contact stays closed", much,
                     Digits(group.too_little_mu(), 6));
}

std::string WhyInWords(v1::Group::Growth why) {
  switch (why) {
    case v1::Group::TOO_LITTLE:
      return "too little comes back even at μ = 0";
    case v1::Group::TOO_MUCH:
      return "too much comes back at every μ";
    case v1::Group::JUMP:
      return "ε jumps over what was asked for";
    default:
      return "the search made no progress";
  }
}

}  // namespace

bool IsNotable(const v1::Group& group) {
  return group.cycles() > 1 || group.status() == v1::Cycle::UNFINISHED ||
         !group.other_roots().empty() || !Certificate(group).empty();
}

std::string CyclesOf(const v1::Group& group) {
  const int first = group.first_cycle();
  return group.cycles() <= 1 ? fmt::to_string(first)
                             : fmt::format("{} to {}", first, first + group.cycles() - 1);
}

std::string Certificate(const v1::Group& group) {
  switch (group.status()) {
    case v1::Cycle::JUMP:
    case v1::Cycle::INFEASIBLE:
      return Reached(group);
    case v1::Cycle::LIMITED:
      return Reached(group) + ", for loads drive or hold the contact";
    case v1::Cycle::RELEASED:
      return Released(group);
    default:
      return "";
  }
}

std::string GrowthLine(const v1::GroupGrowth& growth) {
  const int first = growth.first_cycle(), last = first + growth.cycles() - 1;
  return fmt::format(
      "{} {} and the next share one μ: {}", growth.contact(),
      first >= last ? fmt::format("cycle {}", first) : fmt::format("cycles {} to {}", first, last),
      WhyInWords(growth.growth()));
}

std::string RenderGroups(const v1::Job& job, const Style& style) {
  Table table = MakeTable();
  std::vector<std::string> lines;
  int groups = 0;
  for (const v1::Group& group : job.groups()) {
    if (!IsNotable(group)) continue;
    ++groups;
    table.Add(Row(group));
    for (std::string line : {NoSolution(group), OtherRoots(group)}) {
      if (!line.empty()) lines.push_back(std::move(line));
    }
  }
  if (groups == 0) return "";
  if (lines.size() > kMostGroupRows)
    lines.resize(kMostGroupRows);  // The table says that there are more.
  Style all = style;
  all.columns.clear();
  return fmt::format("\n{}{}",
                     table.Text(all, kMostGroupRows, "… {} more groups; -o json prints all"),
                     Wrap(fmt::to_string(fmt::join(lines, "")), style));
}

}  // namespace contact::cli
