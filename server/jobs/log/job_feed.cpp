#include "jobs/log/job_feed.h"

#include <iterator>
#include <utility>

namespace contact {

std::vector<std::string> JobFeed::Reader::Take(std::size_t most) {
  const MutexLock lock(mutex_);
  std::vector<std::string> taken;
  while (!names_.empty() && taken.size() < most) {
    taken.push_back(std::move(names_.extract(names_.begin()).value()));
  }
  waiting_ = taken.empty();
  return taken;
}

bool JobFeed::Reader::overflown() const {
  const MutexLock lock(mutex_);
  return overflown_;
}

void JobFeed::Reader::Add(const std::string& name) {
  {
    const MutexLock lock(mutex_);
    if (names_.size() >= kMostChanges && !names_.contains(name)) {
      overflown_ = true;
      names_.clear();
    }
    if (!overflown_) names_.insert(name);
    if (!std::exchange(waiting_, false)) return;
  }
  wake_();
}

std::shared_ptr<JobFeed::Reader> JobFeed::Subscribe(std::string tenant,
                                                    std::function<void()> wake) {
  auto reader = std::make_shared<Reader>(std::move(tenant), std::move(wake));
  const MutexLock lock(mutex_);
  readers_.push_back(reader);
  return reader;
}

bool JobFeed::watched() {
  const MutexLock lock(mutex_);
  std::erase_if(readers_, [](const auto& weak) { return weak.expired(); });
  return !readers_.empty();
}

void JobFeed::Changed(const std::string& tenant, const std::string& name) {
  std::vector<std::shared_ptr<Reader>> readers;
  {
    const MutexLock lock(mutex_);
    std::erase_if(readers_, [&](const auto& weak) {
      auto reader = weak.lock();
      if (reader && reader->tenant_ == tenant) readers.push_back(std::move(reader));
      return weak.expired();
    });
  }
  for (const auto& reader : readers) reader->Add(name);
}

}  // namespace contact
