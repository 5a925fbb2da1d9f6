#include "jobs/schedule/turns.h"

namespace contact {
namespace {

// By so much worker time [s] somebody is ahead before a run of his yields. Short enough for shares
// to be equal over seconds, long enough for a turn to cost nothing.
constexpr double kTurn = 0.5;
// Runs that wait at a time: each keeps a thread and its memory.
constexpr int kMostParked = 64;

}  // namespace

void Turns::Add(const Job& job) {
  queue_.Push(job.share, job.name, job.priority, job.number, job.last_attempt);
  jobs_.emplace(job.name, job);
}

bool Turns::Remove(const Job& job) {
  if (jobs_.erase(job.name) == 0) return false;
  return queue_.Remove(job.share, job.priority, job.number);
}

std::optional<Turns::Next> Turns::Take(bool careful, double now) {
  if (busy_ >= workers_) return std::nullopt;
  std::optional<std::string> name = queue_.Pop(careful, now);
  if (!name) return std::nullopt;
  ++busy_;
  if (const auto run = runs_.find(*name); run != runs_.end()) {
    run->second.parked = false;
    --parked_;
    return Next{*std::move(name), true};
  }
  runs_.emplace(*name, Run{std::move(jobs_.extract(*name).mapped())});
  return Next{*std::move(name), false};
}

bool Turns::End(const std::string& name, double now) {
  const auto run = runs_.extract(name);
  if (!run) return false;
  queue_.Ended(run.mapped().job.share, now);
  --busy_;
  return true;
}

std::optional<std::string> Turns::ToYield(bool careful, double now) {
  if (busy_ < workers_ || parked_ >= kMostParked) return std::nullopt;
  Run* yields = nullptr;
  double most = kTurn;
  for (auto& [name, run] : runs_) {
    if (run.parked || run.told) continue;
    const auto ahead = queue_.Ahead(run.job.share, careful, now);
    if (!ahead || *ahead < most) continue;
    most = *ahead;
    yields = &run;
  }
  if (yields == nullptr) return std::nullopt;
  yields->told = true;
  return yields->job.name;
}

void Turns::Park(const std::string& name, double now) {
  Run& run = runs_.at(name);
  // It has begun, so it cannot be one that is passed over for being on its last attempt.
  queue_.Push(run.job.share, name, run.job.priority, run.job.number, false);
  queue_.Ended(run.job.share, now);
  --busy_;
  run.parked = true;
  run.told = false;
  ++parked_;
}

void Turns::Unpark(const std::string& name, double now) {
  Run& run = runs_.at(name);
  queue_.Take(run.job.share, run.job.priority, run.job.number, now);
  ++busy_;
  run.parked = false;
  --parked_;
}

bool Turns::parked(const std::string& name) const { return runs_.at(name).parked; }

bool Turns::Borrow() {
  if (busy_ >= workers_) return false;
  ++busy_;
  return true;
}

}  // namespace contact
