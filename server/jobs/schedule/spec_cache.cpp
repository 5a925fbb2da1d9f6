#include "jobs/schedule/spec_cache.h"

#include <utility>

namespace contact {
namespace {

constexpr std::size_t kMostBytes = 16 << 20;

}  // namespace

void SpecCache::Keep(v1::Job* job) {
  if (const std::size_t bytes = job->ByteSizeLong(); bytes_ + bytes <= kMostBytes) {
    bytes_ += bytes;
    specs_[job->name()] = std::make_shared<const StoredJob>(StoredJob{.job = *job});
  }
  job->clear_spec();
}

std::shared_ptr<const StoredJob> SpecCache::Take(const std::string& name) {
  const auto node = specs_.extract(name);
  if (!node) return nullptr;
  bytes_ -= node.mapped()->job.ByteSizeLong();
  return node.mapped();
}

}  // namespace contact
