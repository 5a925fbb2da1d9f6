#include "jobs/read/artifact_maker.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include "base/executor.h"
#include "jobs/job/errors.h"
#include "jobs/read/csv_text.h"
#include "jobs/read/frame_values.h"

namespace contact {

ArtifactMaker::ArtifactMaker(Store& store, Executor& executor, FewAtOnce& turns, ArtifactPlan plan,
                             Wake wake, MessageBudget message_bytes)
    : store_(store),
      executor_(executor),
      turns_(turns),
      wake_(std::move(wake)),
      message_bytes_(std::move(message_bytes)),
      plan_(std::move(plan)) {}

StreamStep ArtifactMaker::Take(v1::ReadArtifactResponse* out) {
  {
    const MutexLock lock(mutex_);
    if (!chunks_.empty()) {
      *out = std::move(chunks_.front());
      chunks_.pop_front();
      return {.has_message = true, .ended = out->has_artifact()};
    }
    if (error_) return {.error = error_};
    if (std::exchange(working_, true)) return {};
  }
  turns_.Run([weak = weak_from_this()](FewAtOnce::Place turn) {
    const auto self = weak.lock();
    if (!self) return;
    {
      const MutexLock lock(self->mutex_);
      self->turn_ = std::move(turn);
    }
    self->Continue();
  });
  return {};
}

void ArtifactMaker::Continue() {
  using Kind = ArtifactPlan::Kind;
  if (plan_.kind == Kind::kCycles || plan_.kind == Kind::kGroups) {
    return Post([](ArtifactMaker& self) {
      StoredJob& stored = self.plan_.stored;
      if (!stored.MergeResult()) return self.Fail(Damaged(stored.job.name()));
      const bool cycles = self.plan_.kind == Kind::kCycles;
      self.Emit(cycles ? CyclesCsv(stored.job) : GroupsCsv(stored.job));
      self.Finish();
    });
  }
  if (looked_) return ReadPage(KindBit(v1::Event::kFrameChunk), &ArtifactMaker::Write);
  ReadPage(KindBit(v1::Event::kAttemptStarted) | KindBit(v1::Event::kSweepCell),
           &ArtifactMaker::Look);
}

void ArtifactMaker::Post(std::function<void(ArtifactMaker&)> work) {
  const bool posted = executor_.Post([weak = weak_from_this(), work = std::move(work)] {
    if (const auto self = weak.lock()) work(*self);
  });
  if (!posted) Fail(MakeError(Reason::kServerDraining));
}

void ArtifactMaker::ReadPage(std::uint32_t kinds, void (ArtifactMaker::*take)(const Page&)) {
  store_.ReadEvents(
      {.name = plan_.stored.job.name(),
       .after = position_,
       .kinds = kinds,
       .max_bytes = message_bytes_(),
       .abandoned = [weak = weak_from_this()] { return weak.expired(); }},
      [weak = weak_from_this(), take](Page page) {
        const auto self = weak.lock();
        if (!self) return;
        self->Post([take, page = std::move(page)](ArtifactMaker& maker) { (maker.*take)(page); });
      });
}

void ArtifactMaker::Look(const Page& page) {
  if (!page.ok()) return Fail(ToError(page.status(), plan_.stored.job.name()));
  for (const StoredEvent& event : page->events) {
    v1::Event content;
    if (!event.Parse(&content)) return Fail(Damaged(plan_.stored.job.name()));
    Note(event, content);
  }
  position_ = page->position;
  if (position_ < plan_.stored.job.last_sequence()) return Continue();
  if (plan_.kind == ArtifactPlan::Kind::kTrajectory) {
    begin_ = boundary_;
    end_ = plan_.stored.job.last_sequence();
  }
  position_ = begin_;
  looked_ = true;
  Continue();
}

void ArtifactMaker::Note(const StoredEvent& event, const v1::Event& content) {
  if (content.has_sweep_cell() && content.sweep_cell().index() == plan_.cell) {
    begin_ = boundary_;
    end_ = event.sequence;
  }
  boundary_ = event.sequence;
}

void ArtifactMaker::Write(const Page& page) {
  if (!page.ok()) return Fail(ToError(page.status(), plan_.stored.job.name()));
  if (page->oldest > 1) return Fail(EventsCompacted(plan_.stored.job.name(), page->oldest));
  for (const StoredEvent& event : page->events) {
    if (event.sequence > end_) break;
    if (!Write(event)) return Fail(Damaged(plan_.stored.job.name()));
  }
  position_ = page->position;
  if (position_ >= end_) return Finish();
  bool nothing = true;
  {
    const MutexLock lock(mutex_);
    nothing = chunks_.empty();
  }
  if (nothing) return Continue();
  Pause();
}

bool ArtifactMaker::Write(const StoredEvent& stored) {
  v1::Event event;
  if (!stored.Parse(&event)) return false;
  const v1::FrameChunk& chunk = event.frame_chunk();
  if (!IsWhole(chunk)) return false;
  const v1::FrameChunk* const whole = joiner_.Add(chunk);
  if (whole == nullptr) return true;
  if (size_ == 0) Emit(CsvHeader(*whole));
  Emit(CsvRows(*whole));
  return true;
}

void ArtifactMaker::Emit(const std::string& text) {
  digest_.Add(text);
  std::int64_t place = size_;
  size_ += static_cast<std::int64_t>(text.size());
  std::string_view rest = text;
  if (place < plan_.offset) {
    const std::int64_t skipped = std::min(plan_.offset, size_) - place;
    rest.remove_prefix(static_cast<std::size_t>(skipped));
    place += skipped;
  }
  const std::size_t most = message_bytes_();
  while (!rest.empty()) {
    const std::string_view data = rest.substr(0, most);
    v1::ReadArtifactResponse chunk;
    chunk.set_offset(place);
    chunk.set_data(data.data(), data.size());
    chunk.set_crc32c(Crc32c(data));
    Add(std::move(chunk));
    place += static_cast<std::int64_t>(data.size());
    rest.remove_prefix(data.size());
  }
}

void ArtifactMaker::Finish() {
  if (size_ == 0) return Fail(NoArtifact(plan_.stored.job.name(), plan_.artifact));
  if (plan_.offset > size_) return Fail(OffsetOutOfRange(plan_.offset, size_));
  v1::ReadArtifactResponse last;
  last.set_offset(size_);
  v1::Artifact& artifact = *last.mutable_artifact();
  artifact.set_name(plan_.artifact);
  artifact.set_media_type("text/csv");
  artifact.set_size_bytes(size_);
  artifact.set_sha256(digest_.Finish());
  Add(std::move(last));
  Pause();
}

void ArtifactMaker::Add(v1::ReadArtifactResponse chunk) {
  const MutexLock lock(mutex_);
  chunks_.push_back(std::move(chunk));
}

void ArtifactMaker::Fail(Error error) {
  {
    const MutexLock lock(mutex_);
    error_ = std::move(error);
  }
  Pause();
}

void ArtifactMaker::Pause() {
  FewAtOnce::Place turn;  // Goes after the lock: the next maker begins then.
  {
    const MutexLock lock(mutex_);
    working_ = false;
    turn = std::move(turn_);
  }
  turn = nullptr;
  wake_();
}

}  // namespace contact
