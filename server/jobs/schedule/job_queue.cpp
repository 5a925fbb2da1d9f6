#include "jobs/schedule/job_queue.h"

#include <algorithm>
#include <utility>

namespace contact {

void JobQueue::Push(const Share& share, std::string name, std::int32_t priority,
                    std::uint64_t number, bool last_attempt) {
  Tenant& tenant = tenants_[share.tenant];
  order_.Join(share.tenant);
  tenant.order.Join(share.owner);
  tenant.owners[share.owner].emplace(std::pair(-priority, number),
                                     Job{std::move(name), last_attempt});
  ++size_;
}

std::optional<JobQueue::Candidate> JobQueue::Next(const std::string& tenant,
                                                  const std::string& owner, const Jobs& jobs,
                                                  bool careful) const {
  const FairOrder& owners = tenants_.at(tenant).order;
  if (most_running_ > 0 && owners.running(owner) >= most_running_) return std::nullopt;
  const auto job = std::ranges::find_if(
      jobs, [&](const auto& entry) { return !careful || !entry.second.last_attempt; });
  if (job == jobs.end()) return std::nullopt;
  return Candidate{
      {tenant, owner}, job, order_.Rank(tenant), owners.Rank(owner), job->first.second};
}

std::optional<JobQueue::Candidate> JobQueue::First(bool careful) const {
  std::optional<Candidate> first;
  for (const auto& [tenant, entry] : tenants_) {
    for (const auto& [owner, jobs] : entry.owners) {
      auto next = Next(tenant, owner, jobs, careful);
      if (next && (!first || next->Before(*first))) first = std::move(next);
    }
  }
  return first;
}

std::string JobQueue::Extract(const Share& share, Jobs::const_iterator job) {
  auto& owners = tenants_.at(share.tenant).owners;
  Jobs& jobs = owners.at(share.owner);
  std::string name = std::move(jobs.extract(job).mapped().name);
  if (jobs.empty()) owners.erase(share.owner);
  --size_;
  return name;
}

std::optional<std::string> JobQueue::Pop(bool careful, double now) {
  Pass(now);
  const std::optional<Candidate> first = First(careful);
  if (!first) return std::nullopt;
  Begin(first->share);
  return Extract(first->share, first->job);
}

bool JobQueue::Take(const Share& share, std::int32_t priority, std::uint64_t number, double now) {
  Pass(now);
  const auto job = Find(share, priority, number);
  if (!job) return false;
  Begin(share);
  Extract(share, *job);
  return true;
}

std::optional<double> JobQueue::Ahead(const Share& share, bool careful, double now) {
  Pass(now);
  const std::optional<Candidate> first = First(careful);
  if (!first) return std::nullopt;
  if (first->share.tenant != share.tenant) {
    return order_.Rank(share.tenant) - FairOrder::kAhead - first->tenant_rank;
  }
  if (first->share.owner == share.owner) return std::nullopt;
  return tenants_.at(share.tenant).order.Rank(share.owner) - FairOrder::kAhead - first->owner_rank;
}

void JobQueue::Ended(const Share& share, double now) {
  Pass(now);
  order_.End(share.tenant);
  tenants_.at(share.tenant).order.End(share.owner);
  Leave(share);
}

bool JobQueue::Remove(const Share& share, std::int32_t priority, std::uint64_t number) {
  const auto job = Find(share, priority, number);
  if (!job) return false;
  Extract(share, *job);
  Leave(share);
  return true;
}

std::optional<JobQueue::Jobs::const_iterator> JobQueue::Find(const Share& share,
                                                             std::int32_t priority,
                                                             std::uint64_t number) const {
  const auto tenant = tenants_.find(share.tenant);
  if (tenant == tenants_.end()) return std::nullopt;
  const auto owner = tenant->second.owners.find(share.owner);
  if (owner == tenant->second.owners.end()) return std::nullopt;
  const auto job = owner->second.find({-priority, number});
  if (job == owner->second.end()) return std::nullopt;
  return job;
}

void JobQueue::Begin(const Share& share) {
  order_.Begin(share.tenant);
  tenants_.at(share.tenant).order.Begin(share.owner);
}

void JobQueue::Leave(const Share& share) {
  order_.Leave(share.tenant);
  FairOrder& owners = tenants_.at(share.tenant).order;
  owners.Leave(share.owner);
  if (owners.empty()) tenants_.erase(share.tenant);
}

void JobQueue::Pass(double now) {
  order_.Pass(now - now_);
  for (auto& [name, tenant] : tenants_) tenant.order.Pass(now - now_);
  now_ = now;
}

}  // namespace contact
