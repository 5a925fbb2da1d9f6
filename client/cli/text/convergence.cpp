#include "cli/text/convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>

#include "base/spelling.h"
#include "cli/base/number.h"
#include "cli/text/render_ledger.h"
#include "wire/rules/field_rule.h"

namespace contact::cli {
namespace {

// Parts of a result, and how many of them miss the restitution that was asked for.
struct Parts {
  std::int64_t missed = 0;
  std::int64_t all = 0;  // 0: not known.
  const char* name = "cycles";
};

bool Missed(const v1::Cycle& cycle) { return Misses(cycle.status()); }

bool CutByTheEnd(const v1::Cycle& cycle) {
  return cycle.status() == v1::Cycle::CUT || cycle.status() == v1::Cycle::UNFINISHED;
}

// Earlier servers do not count these; their ledger may be at hand.
std::int64_t CutCount(const v1::Job& job) {
  return std::max<std::int64_t>(job.summary().cycles_cut(),
                                std::ranges::count_if(job.cycles(), CutByTheEnd));
}

// Servers of earlier versions do not count; their ledger may be at hand.
Parts PartsOf(const v1::Job& job) {
  const v1::Progress& progress = job.progress();
  if (progress.cells() > 0) {
    return {progress.cells_failed() + progress.cells_not_converged(), progress.cells(), "cells"};
  }
  const v1::RunSummary& summary = job.summary();
  if (summary.cycles() > 0) {
    return {summary.cycles_not_converged() + summary.cycles_infeasible(), summary.cycles()};
  }
  return {std::ranges::count_if(job.cycles(), Missed), job.cycles_size()};
}

constexpr double kNear = 1e-4;  // A miss that a user may accept.
constexpr int kMostGroups = 3;  // Of which the hints tell what they can reach.

// The NOT_CONVERGED cycles of a ledger by what ended their search.
struct Causes {
  std::int64_t exhausted = 0;  // All corrections were used.
  std::int64_t near = 0;       // They miss by kNear at most.
  std::int64_t stuck = 0;      // Neither: no better μ was found.
  std::int64_t unproved = 0;   // Their energy does not balance, whatever their μ.
  double worst_near = 1e-12;   // The least tolerance that there is.
  double worst_residual = 0;   // Of those unproved.
};

// A number of the solver, or what it is by default.
double ValueOf(int field, const v1::Solver& solver) {
  const NumberField& number = NumberOf<v1::Solver>(field);
  return number.Find(solver).value_or(number.default_value);
}

// The residual that a row that proves itself has at most, see Cycle.identity_residual.
double MostResidual(const v1::Solver& solver) {
  return std::max(1e-7, 10 * ValueOf(v1::Solver::kRestitutionToleranceFieldNumber, solver));
}

int MaxIterations(const v1::Solver& solver) {
  return static_cast<int>(ValueOf(v1::Solver::kMaxIterationsFieldNumber, solver));
}

bool IsPapers(v1::Solver::Update update) {
  return update != v1::Solver::UPDATE_UNSPECIFIED && update != v1::Solver::NEWTON_COUPLED;
}

// The relative miss of each group, by contact and number.
std::map<std::pair<std::string, int>, double> MissesOf(const v1::Job& job) {
  std::map<std::pair<std::string, int>, double> misses;
  for (const v1::Group& group : job.groups()) {
    misses[{group.contact(), group.number()}] =
        RestitutionError(group.restitution_out(), group.restitution_in());
  }
  return misses;
}

// The most corrections that a cycle of each episode tells of.
std::map<int, int> CorrectionsOf(const v1::Job& job) {
  std::map<int, int> corrections;
  for (const v1::Cycle& cycle : job.cycles()) {
    int& most = corrections[cycle.episode()];
    most = std::max(most, cycle.iterations());
  }
  return corrections;
}

Causes CausesOf(const v1::Job& job) {
  const auto misses = MissesOf(job);
  auto corrections = CorrectionsOf(job);
  Causes causes;
  for (const v1::Cycle& cycle : job.cycles()) {
    if (cycle.status() != v1::Cycle::NOT_CONVERGED) continue;
    if (cycle.identity_residual() > MostResidual(job.scenario().solver())) {
      ++causes.unproved;
      causes.worst_residual = std::max(causes.worst_residual, cycle.identity_residual());
      continue;
    }
    const auto group = misses.find({cycle.contact(), cycle.group()});
    const double miss = group != misses.end()
                            ? group->second
                            : RestitutionError(cycle.restitution_out(), cycle.restitution_in());
    const bool exhausted = corrections[cycle.episode()] >= MaxIterations(job.scenario().solver());
    causes.exhausted += exhausted;
    if (miss <= kNear) {
      ++causes.near;
      causes.worst_near = std::max(causes.worst_near, miss);
    } else if (!exhausted) {
      ++causes.stuck;
    }
  }
  return causes;
}

std::string Try(const std::string& setting, const std::string& why) {
  return fmt::format("Try:   --set solver.{}   {}\n", setting, why);
}

std::string AboutSearches(const v1::Job& job) {
  const v1::Solver& solver = job.scenario().solver();
  const Causes causes = CausesOf(job);
  const NumberField& iterations = NumberOf<v1::Solver>(v1::Solver::kMaxIterationsFieldNumber);
  const int most = MaxIterations(solver), allowed = static_cast<int>(iterations.range.high);
  std::string text;
  if (causes.exhausted > 0 && most < allowed) {
    text += Try(fmt::format("max_iterations={}", std::clamp(2 * most, 50, allowed)),
                fmt::format("{} used up the {}", Count(causes.exhausted, "cycle", "cycles"),
                            Count(most, "correction", "corrections")));
  }
  if (causes.near > 0) {
    const double enough = std::pow(10, std::ceil(std::log10(causes.worst_near)));
    text += Try(fmt::format("restitution_tolerance={:.0e}", enough),
                fmt::format("{} by less", Count(causes.near, "cycle misses", "cycles miss")));
  }
  if (causes.unproved > 0) {
    text += fmt::format(
        "       The energy of {} does not balance, by up to {} of its work; a smaller "
        "solver.relative_tolerance may help\n",
        Count(causes.unproved, "cycle", "cycles"), RelativeError(causes.worst_residual));
  }
  if (causes.stuck == 0) return text;
  const std::string stuck = Count(causes.stuck, "cycle", "cycles");
  if (IsPapers(solver.update())) {
    return text + Try("update=NEWTON_COUPLED",
                      fmt::format("the paper's process gave {} up; it corrects each alone", stuck));
  }
  text +=
      fmt::format("       No better μ was found for {}; more corrections would not help\n", stuck);
  const NumberField& tolerance = NumberOf<v1::Solver>(v1::Solver::kRelativeToleranceFieldNumber);
  const double finest = tolerance.range.low;
  const bool adapts = solver.method() != v1::Solver::RK4;
  if (adapts && ValueOf(v1::Solver::kRelativeToleranceFieldNumber, solver) > finest) {
    text += Try(fmt::format("relative_tolerance={:.0e}", finest),
                "a search of finer motions often ends otherwise");
  }
  return text;
}

// What a group without solution can reach: `at most 0.31`; empty if the search does not tell.
std::string Reach(const v1::Group& group) {
  const double much = group.too_much_restitution(), little = group.too_little_restitution();
  if (std::isnan(much) && !std::isnan(little)) return "at most " + Digits(little, 4);
  return std::isnan(little) && !std::isnan(much) ? "at least " + Digits(much, 4) : "";
}

std::string AboutInfeasible(const v1::Job& job) {
  const auto status = [](const auto& part) { return part.status(); };
  if (std::ranges::count(job.cycles(), v1::Cycle::INFEASIBLE, status) == 0) return "";
  const v1::Solver& solver = job.scenario().solver();
  if (IsPapers(solver.update())) {
    return Try("update=NEWTON_COUPLED", "lets INFEASIBLE cycles share one μ with their neighbours");
  }
  if (solver.restitution_scope() == v1::Solver::CYCLE) {
    return Try("restitution_scope=AUTO",
               "lets INFEASIBLE cycles share one μ with their neighbours");
  }
  std::string text = "       An INFEASIBLE group has no μ that would do\n";
  int told = 0;
  for (const v1::Group& group : job.groups()) {
    const std::string reach = group.status() == v1::Cycle::INFEASIBLE ? Reach(group) : "";
    if (reach.empty() || ++told > kMostGroups) continue;
    text += fmt::format("       {} group {} can have a restitution of {}\n", group.contact(),
                        group.number(), reach);
  }
  return text;
}

}  // namespace

bool Misses(v1::Cycle::Status status) {
  return status == v1::Cycle::NOT_CONVERGED || status == v1::Cycle::INFEASIBLE;
}

std::string MissedCount(const v1::Job& job) {
  const Parts parts = PartsOf(job);
  const bool known = parts.all > 0 || (job.has_summary() && job.convergence() == v1::Job::FULL);
  return known ? fmt::to_string(parts.missed) : "-";
}

std::string ConvergenceText(const v1::Job& job) {
  if (job.convergence() == v1::Job::CONVERGENCE_UNSPECIFIED) return "";
  const Parts parts = PartsOf(job);
  std::string text = v1::Job::Convergence_Name(job.convergence());
  if (parts.missed > 0) text += fmt::format(" ({} of {} {})", parts.missed, parts.all, parts.name);
  if (const std::int64_t cut = CutCount(job); cut > 0) {
    text += fmt::format(", {} cut by the end", Count(cut, "cycle", "cycles"));
  }
  return text;
}

void KeepMissed(v1::Job* job) {
  const Parts parts = PartsOf(*job);
  if (job->summary().cycles() == 0) {
    job->mutable_summary()->set_cycles(parts.all);
    job->mutable_summary()->set_cycles_not_converged(parts.missed);
  }
  if (const std::int64_t cut = CutCount(*job); cut > 0) {
    job->mutable_summary()->set_cycles_cut(cut);
  }
  auto& cycles = *job->mutable_cycles();
  cycles.erase(std::remove_if(cycles.begin(), cycles.end(), std::not_fn(Missed)), cycles.end());
  auto& groups = *job->mutable_groups();
  const auto reached = [](const v1::Group& group) { return !Misses(group.status()); };
  groups.erase(std::remove_if(groups.begin(), groups.end(), reached), groups.end());
}

std::string ConvergenceHints(const v1::Job& job) {
  if (job.convergence() != v1::Job::PARTIAL) return "";
  return AboutSearches(job) + AboutInfeasible(job);
}

}  // namespace contact::cli
