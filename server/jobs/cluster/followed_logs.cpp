#include "jobs/cluster/followed_logs.h"

#include <utility>

namespace contact {

std::shared_ptr<JobLog> FollowedLogs::Follow(const v1::Job& job) {
  std::shared_ptr<JobLog> log;
  {
    const MutexLock lock(mutex_);
    std::weak_ptr<JobLog>& known = logs_[job.name()];
    log = known.lock();
    if (!log) known = log = std::make_shared<JobLog>(job.last_sequence(), false);
  }
  log->Advance(job.last_sequence(), false);
  return log;
}

std::shared_ptr<JobLog> FollowedLogs::Find(const std::string& name) {
  const MutexLock lock(mutex_);
  const auto found = logs_.find(name);
  return found == logs_.end() ? nullptr : found->second.lock();
}

void FollowedLogs::Advance(const LogPosition& position) {
  if (const auto log = Find(position.name)) log->Advance(position.last_sequence, position.ended);
}

void FollowedLogs::SetProgress(const std::string& name, const v1::Event& progress) {
  if (const auto log = Find(name)) log->SetProgress(progress);
}

std::vector<std::string> FollowedLogs::names() {
  const MutexLock lock(mutex_);
  std::erase_if(logs_, [](const auto& entry) { return entry.second.expired(); });
  std::vector<std::string> names;
  for (const auto& [name, log] : logs_) names.push_back(name);
  return names;
}

}  // namespace contact
