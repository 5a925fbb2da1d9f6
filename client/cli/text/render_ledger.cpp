#include "cli/text/render_ledger.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <utility>

#include "cli/base/number.h"

namespace contact::cli {
namespace {

using GroupNames = std::set<std::pair<std::string, int>>;  // Contact and number.

// The groups of several cycles: none of these has the restitution of its group.
GroupNames LongerGroups(const v1::Job& job) {
  GroupNames names;
  for (const v1::Group& group : job.groups()) {
    if (group.cycles() > 1) names.insert({group.contact(), group.number()});
  }
  return names;
}

std::string ErrorText(const v1::Cycle& cycle, const GroupNames& longer) {
  if (longer.contains({cycle.contact(), cycle.group()})) return "-";
  return RelativeError(RestitutionError(cycle));
}

}  // namespace

std::vector<Table::Column> LedgerColumns() {
  return {{"CONTACT"},
          {"#", true, 0, "number"},
          {"GROUP", true, 5},
          {"KIND"},
          {"END", false, 2},
          {"STATUS"},
          {"n", true, 1, "iterations"},
          {"μ", true, 0, "mu"},
          {"α, or μ/k", true, 4, "alpha"},
          {"ε IN", true, 0, "restitution_in"},
          {"ε OUT", true, 0, "restitution_out"},
          {"ERROR", true},
          {"t START [s]", true, 3, "start_time"},
          {"t END [s]", true, 3, "end_time"},
          {"PEAK FORCE [N]", true, Table::kOnlyWide},
          {"δ MAX [m]", true, Table::kOnlyWide, "delta_max"},
          {"W_c [J]", true, Table::kOnlyWide, "work_compression"},
          {"W_r [J]", true, Table::kOnlyWide, "work_restitution"}};
}

std::string RenderLedger(const v1::Job& job, const Style& style) {
  if (job.cycles().empty()) return "";
  constexpr std::size_t kMostRows = 40;
  const GroupNames longer = LongerGroups(job);
  Table table(LedgerColumns());
  for (const v1::Cycle& cycle : job.cycles()) {
    table.Add({cycle.contact(),
               fmt::to_string(cycle.number()),
               cycle.group() == 0 ? "-" : fmt::to_string(cycle.group()),
               v1::Cycle::Kind_Name(cycle.kind()),
               v1::Cycle::End_Name(cycle.end()),
               {v1::Cycle::Status_Name(cycle.status()), ToneOf(cycle.status())},
               fmt::to_string(cycle.iterations()),
               Digits(cycle.mu(), 7),
               AlphaOrRatio(cycle),
               Digits(cycle.restitution_in(), 6),
               Digits(RestitutionOf(cycle), 8),
               ErrorText(cycle, longer),
               Digits(cycle.start_time_s(), 7),
               Digits(cycle.end_time_s(), 7),
               Digits(cycle.peak_force_n(), 7),
               Digits(cycle.delta_max_m(), 7),
               Digits(cycle.work_compression_j(), 7),
               Digits(cycle.work_restitution_j(), 7)});
  }
  return fmt::format("\n{}", table.Text(style, kMostRows, "… {} more cycles; -o json prints all"));
}

Tone ToneOf(v1::Cycle::Status status) {
  switch (status) {
    case v1::Cycle::CONVERGED:
      return Tone::kGood;
    case v1::Cycle::NOT_CONVERGED:
      return Tone::kBad;
    case v1::Cycle::INFEASIBLE:
    case v1::Cycle::JUMP:
    case v1::Cycle::LIMITED:  // Groups tell what was reached.
      return Tone::kWarning;
    case v1::Cycle::CUT:
    case v1::Cycle::UNFINISHED:  // Much of them is not known.
      return Tone::kFaint;
    default:
      return Tone::kPlain;
  }
}

std::string AlphaOrRatio(const v1::Cycle& cycle) {
  return cycle.kind() == v1::Cycle::COLLISION ? Digits(cycle.alpha(), 7)
                                              : Digits(cycle.mu_over_k_s_per_m(), 5) + " s/m";
}

double RestitutionOf(const v1::Cycle& cycle) {
  const bool says = cycle.status() != v1::Cycle::SETTLED && cycle.status() != v1::Cycle::RELEASED;
  return says ? cycle.restitution_out() : std::numeric_limits<double>::quiet_NaN();
}

double RestitutionError(double restitution_out, double restitution_in) {
  return std::abs(restitution_out - restitution_in) / restitution_in;
}

double RestitutionError(const v1::Cycle& cycle) {
  return RestitutionError(RestitutionOf(cycle), cycle.restitution_in());
}

}  // namespace contact::cli
