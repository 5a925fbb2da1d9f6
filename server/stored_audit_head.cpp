#include "stored_audit_head.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <array>
#include <condition_variable>
#include <string>
#include <utility>

#include "base/future.h"
#include "base/mutex.h"

namespace contact {
namespace {

using Kept = absl::StatusOr<std::string>;

// Tells the logs of several fronts apart.
std::string NameOf(const std::filesystem::path& file) {
  std::array<char, 256> host = {};
  ::gethostname(host.data(), host.size() - 1);
  return fmt::format("audit-head {} {}", host.data(), std::filesystem::absolute(file).string());
}

class StoredHead : public AuditHead {
 public:
  StoredHead(SharedStore& store, const std::filesystem::path& file)
      : store_(store), name_(NameOf(file)) {}

  ~StoredHead() override {
    const MutexLock lock(mutex_);
    while (busy_) idle_.wait(mutex_);
  }

  std::string Read() override {  // Leaves an empty row where there is none.
    const Kept kept =
        Await<Kept>([this](auto done) { store_.Keep(name_, "", false, std::move(done)); });
    if (!kept.ok()) spdlog::error("{} cannot be read: {}", name_, kept.status().ToString());
    return kept.value_or("");
  }

  void Write(const std::string& digest) override {
    {
      const MutexLock lock(mutex_);
      next_ = digest;
      if (std::exchange(busy_, true)) return;
    }
    KeepNext();
  }

 private:
  // Keeps the newest digest, and then those that have come meanwhile.
  void KeepNext() {
    std::string digest;
    {
      const MutexLock lock(mutex_);
      digest = std::exchange(next_, "");
      if (digest.empty()) {
        busy_ = false;
        idle_.notify_all();
        return;
      }
    }
    store_.Keep(name_, digest, true, [this](const Kept& kept) {
      if (!kept.ok()) spdlog::error("{} cannot be kept: {}", name_, kept.status().ToString());
      KeepNext();
    });
  }

  SharedStore& store_;
  const std::string name_;
  Mutex mutex_;
  std::condition_variable_any idle_;
  // Not kept yet; empty: nothing.
  std::string next_ ABSL_GUARDED_BY(mutex_);
  bool busy_ ABSL_GUARDED_BY(mutex_) = false;
};

}  // namespace

std::unique_ptr<AuditHead> OpenStoredHead(SharedStore& store, const std::filesystem::path& file) {
  return std::make_unique<StoredHead>(store, file);
}

}  // namespace contact
