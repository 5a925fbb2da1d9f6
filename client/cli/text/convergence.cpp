#include "cli/text/convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>

#include "base/spelling.h"

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

}  // namespace contact::cli
