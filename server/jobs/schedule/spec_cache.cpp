#include "jobs/schedule/spec_cache.h"

#include <utility>

namespace contact {
namespace {

constexpr std::size_t kMostBytes = 16 << 20;

std::size_t BytesOf(const StoredJob& stored) {
  return stored.job.ByteSizeLong() + stored.checkpoint.size();
}

}  // namespace

void SpecCache::Keep(StoredJob* stored) {
  if (stored->job.spec_case() == v1::Job::SPEC_NOT_SET) return;
  if (const std::size_t bytes = BytesOf(*stored); bytes_ + bytes <= kMostBytes) {
    bytes_ += bytes;
    specs_[stored->job.name()] = std::make_shared<const StoredJob>(*stored);
  }
  stored->job.clear_spec();
}

std::shared_ptr<const StoredJob> SpecCache::Take(const std::string& name) {
  const auto node = specs_.extract(name);
  if (!node) return nullptr;
  bytes_ -= BytesOf(*node.mapped());
  return node.mapped();
}

}  // namespace contact
