#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/executor.h"
#include "base/mutex.h"
#include "jobs/log/job_log.h"
#include "jobs/log/log_cursor.h"
#include "jobs/quota/places.h"
#include "storage/store.h"

namespace contact {

/// Where cursors read what is no longer in memory. Decoding takes too long for the store's thread
/// and for those who read.
struct EventSource {
  Store& store;
  Executor& decoder;
  /// Readers that read large pages, and the next while they hand out one. What stalled readers keep
  /// is bounded by their number; reading a page costs several threads a turn, whatever its size.
  Places ahead{8};
};

/// Reads a log: the newest events from memory, older ones from the store. A reader that falls
/// behind the memory goes on from the store, so nothing is kept for it, but for a few readers two
/// pages.
class TailCursor final : public LogCursor {
 public:
  /// Starts after the event with sequence `position` and reads events of these `kinds`, see
  /// KindBit. `place` is kept until the cursor is destroyed. The source's store and decoder outlive
  /// the cursor.
  TailCursor(EventSource source, std::string name, std::shared_ptr<JobLog> log,
             std::uint64_t position, std::uint32_t kinds, Wake wake, Places::Place place);
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

  /// A decoded page of the stored log.
  struct Page {
    absl::Status status;
    Events events;
    /// All that was asked for up to this sequence is in the page or before it.
    std::uint64_t position = 0;
    /// See EventPage.
    std::uint64_t oldest = 1;
  };
  /// A page on its way from the store; the decoder puts it here.
  struct Fetch {
    Mutex mutex;
    /// Nothing until it is there.
    std::optional<Page> page ABSL_GUARDED_BY(mutex);
  };

  /// Runs on the decoder's thread. Puts a warning in place of each damaged event.
  static Page Decode(const std::string& name, absl::StatusOr<EventPage> stored);
  /// Asks the store for what follows page_: a large page if the reader reads ahead, else about
  /// `max_bytes`.
  void StartFetch(std::size_t max_bytes);
  /// Takes the page that was asked for. Nothing if there is a page to hand out, or one that held no
  /// event that was asked for.
  std::optional<Next> TakeFetched(std::size_t max_bytes);
  /// Moves events of page_ to `out`. False if there are none left.
  bool HandOut(std::size_t max_bytes, Events* out);

  const EventSource source_;
  const std::string name_;
  const std::shared_ptr<JobLog> log_;
  const std::uint32_t kinds_;
  const std::shared_ptr<const Wake> waker_;
  const Places::Place place_;

  std::uint64_t position_;
  std::uint64_t oldest_ = 1;
  /// See JobLog::After.
  std::uint64_t progress_seen_ = 0;
  /// True once the reader has read all there was.
  bool live_ = false;
  /// Bytes read from the store since the reader was last in memory.
  std::size_t lag_ = 0;
  /// The last page from the store.
  Page page_;
  /// Events of page_ that were handed out.
  std::size_t handed_out_ = 0;
  /// The page after page_. Null while none is under way.
  std::shared_ptr<Fetch> fetch_;
  /// Place among those who read ahead. Null if it has none.
  Places::Place ahead_;
};

}  // namespace contact
