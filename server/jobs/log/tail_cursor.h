#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/executor.h"
#include "jobs/log/job_log.h"
#include "jobs/log/log_cursor.h"
#include "storage/store.h"

namespace contact {

/// Where cursors read what is no longer in memory. Decoding takes too long for the store's thread
/// and for those who read.
struct EventSource {
  Store& store;
  Executor& decoder;
  /// Readers that read ahead, in large pages.
  std::shared_ptr<std::atomic<int>> ahead = std::make_shared<std::atomic<int>>(0);
};

/// The cursor of JobManager: reads the newest events from memory, older ones from the store. A
/// reader that falls behind the memory goes on from the store, so nothing is kept for it, but for
/// a few readers two pages.
class TailCursor final : public LogCursor {
 public:
  /// `watchers` counts the cursors alive; the caller has counted this one already.
  TailCursor(EventSource source, std::string name, std::shared_ptr<JobLog> log,
             std::uint64_t position, std::uint32_t kinds, JobLog::Waker wake,
             std::shared_ptr<std::atomic<int>> watchers);
  ~TailCursor() override;
  TailCursor(const TailCursor&) = delete;
  TailCursor& operator=(const TailCursor&) = delete;

  Next Read(std::size_t max_bytes, std::vector<LogRecord>* out) override;
  std::uint64_t position() const override { return position_; }
  std::uint64_t oldest() const override { return oldest_; }

  /// True if the reader once had read all there was, lost what follows from memory, and has not
  /// caught up within the next few MiB.
  bool behind() const { return live_ && lag_ > kMostLag; }

 private:
  using Events = std::vector<LogRecord>;
  static constexpr std::size_t kMostLag = 4 << 20;

  struct Page {
    absl::Status status;
    Events events;
    std::uint64_t position = 0;
    std::uint64_t oldest = 1;
  };
  /// A page on its way from the store; the decoder puts it here.
  struct Fetch {
    Mutex mutex;
    std::optional<Page> page ABSL_GUARDED_BY(mutex);
  };

  static Page Decode(const std::string& name, absl::StatusOr<EventPage> stored);
  void EnterAhead();
  void StartFetch(std::size_t max_bytes);
  std::optional<Next> TakeFetched(std::size_t max_bytes);
  bool HandOut(std::size_t max_bytes, Events* out);

  const EventSource source_;
  const std::string name_;
  const std::shared_ptr<JobLog> log_;
  const std::uint32_t kinds_;
  const std::shared_ptr<const JobLog::Waker> waker_;
  const std::shared_ptr<std::atomic<int>> watchers_;

  std::uint64_t position_;
  std::uint64_t oldest_ = 1;
  std::uint64_t progress_seen_ = 0;
  bool live_ = false;                  ///< Has once read all there was.
  std::size_t lag_ = 0;                ///< Bytes read from the store since it was last in memory.
  Page page_;                          ///< The last one from the store.
  std::size_t handed_out_ = 0;         ///< Events of it.
  std::shared_ptr<Fetch> fetch_;       ///< The one after it; none while none is under way.
  std::shared_ptr<const void> ahead_;  ///< A place among those who read ahead, if it has one.
};

}  // namespace contact
