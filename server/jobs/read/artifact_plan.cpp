#include "jobs/read/artifact_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "jobs/job/errors.h"
#include "jobs/job/lifecycle.h"

namespace contact {
namespace {

constexpr std::string_view kCycles = "cycles.csv";
constexpr std::string_view kGroups = "groups.csv";
constexpr std::string_view kTrajectory = "trajectory.csv";

std::string CellArtifact(std::int32_t cell) {
  return fmt::format("cells/{}/{}", cell, kTrajectory);
}

void Add(std::string name, v1::Job* job) {
  v1::Artifact& artifact = *job->add_artifacts();
  artifact.set_name(std::move(name));
  artifact.set_media_type("text/csv");
}

}  // namespace

void AddArtifacts(v1::Job* job) {
  if (!IsFinal(job->state())) return;
  if (job->has_scenario()) {
    Add(std::string(kCycles), job);
    Add(std::string(kGroups), job);
  }
  if (job->oldest_sequence() > 1) return;  // Compacted.
  if (job->has_scenario() && !job->scenario().output().ledger_only()) {
    Add(std::string(kTrajectory), job);
  }
  for (const std::int32_t cell : job->sweep().keep_trajectories()) Add(CellArtifact(cell), job);
}

Result<ArtifactPlan> PlanArtifact(StoredJob stored, const v1::ReadArtifactRequest& request) {
  const v1::Job& job = stored.job;
  if (!IsFinal(job.state())) {
    return JobError(Reason::kInvalidState, job.name(), "has not ended");
  }
  ArtifactPlan plan;
  plan.artifact = request.artifact();
  plan.offset = request.offset();
  if (job.has_scenario() && plan.artifact == kCycles) {
    plan.kind = ArtifactPlan::Kind::kCycles;
  } else if (job.has_scenario() && plan.artifact == kGroups) {
    plan.kind = ArtifactPlan::Kind::kGroups;
  } else if (job.has_scenario() && plan.artifact == kTrajectory) {
    plan.kind = ArtifactPlan::Kind::kTrajectory;
  } else {
    const auto& kept = job.sweep().keep_trajectories();
    const auto cell = std::ranges::find_if(
        kept, [&plan](std::int32_t index) { return plan.artifact == CellArtifact(index); });
    if (cell == kept.end()) return NoArtifact(job.name(), plan.artifact);
    plan.kind = ArtifactPlan::Kind::kCellTrajectory;
    plan.cell = *cell;
  }
  if (plan.kind == ArtifactPlan::Kind::kCycles || plan.kind == ArtifactPlan::Kind::kGroups) {
    plan.stored = std::move(stored);
  } else {
    plan.stored.job.set_name(job.name());
    plan.stored.job.set_last_sequence(job.last_sequence());
  }
  return plan;
}

}  // namespace contact
