#include "jobs/read/artifact_maker.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include "base/digest.h"
#include "base/executor.h"
#include "jobs/job/errors.h"
#include "jobs/read/csv_text.h"

namespace contact {
namespace {

constexpr std::size_t kChunkBytes = 1 << 18;
constexpr std::size_t kPageBytes = 1 << 18;

bool IsWhole(const v1::FrameChunk& chunk) {
  const std::size_t bytes = static_cast<std::size_t>(chunk.samples()) * sizeof(double);
  return std::ranges::all_of(
      chunk.columns(), [bytes](const auto& column) { return column.values().size() == bytes; });
}

}  // namespace

ArtifactMaker::ArtifactMaker(Store& store, Executor& executor, ArtifactPlan plan,
                             std::function<void()> wake)
    : store_(store), executor_(executor), plan_(std::move(plan)), wake_(std::move(wake)) {}

void ArtifactMaker::Continue() {
  if (plan_.kind == ArtifactPlan::Kind::kCycles) {
    return Post([](ArtifactMaker& self) {
      StoredJob& stored = self.plan_.stored;
      if (!stored.MergeResult()) return self.Fail(Damaged(stored.job.name()));
      self.Emit(CyclesCsv(stored.job));
      self.Finish();
    });
  }
  if (looked_) return ReadPage(KindBit(v1::Event::kFrameChunk), &ArtifactMaker::Write);
  ReadPage(KindBit(v1::Event::kAttemptStarted) | KindBit(v1::Event::kSweepCell),
           &ArtifactMaker::Look);
}

// Runs it on the executor, unless the reader has left by then.
void ArtifactMaker::Post(std::function<void(ArtifactMaker&)> work) {
  const bool posted = executor_.Post([weak = weak_from_this(), work = std::move(work)] {
    if (const auto self = weak.lock()) work(*self);
  });
  if (!posted) Fail(MakeError(Reason::kServerDraining));
}

void ArtifactMaker::ReadPage(std::uint32_t kinds, void (ArtifactMaker::*take)(const Page&)) {
  store_.ReadEvents({plan_.stored.job.name(), position_, kinds, kPageBytes},
                    [weak = weak_from_this(), take](Page page) {
                      const auto self = weak.lock();
                      if (!self) return;
                      const auto shared = std::make_shared<const Page>(std::move(page));
                      self->Post([shared, take](ArtifactMaker& maker) { (maker.*take)(*shared); });
                    });
}

// Looks for the samples of the last attempt, or for those that stand before the cell.
void ArtifactMaker::Look(const Page& page) {
  if (!page.ok()) return Fail(ToError(page.status(), plan_.stored.job.name()));
  for (const StoredEvent& event : page->events) {
    v1::Event content;
    if (!event.Parse(&content)) {
      return Fail(Damaged(plan_.stored.job.name()));
    }
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
  Do([&nothing](const Made& made) { nothing = made.chunks.empty(); });
  if (nothing) return Continue();
  Pause();
}

bool ArtifactMaker::Write(const StoredEvent& stored) {
  v1::Event event;
  if (!stored.Parse(&event)) return false;
  const v1::FrameChunk& chunk = event.frame_chunk();
  if (!IsWhole(chunk)) return false;
  if (size_ == 0) Emit(CsvHeader(chunk));
  Emit(CsvRows(chunk));
  return true;
}

// Adds text: all of it counts, what lies behind the offset is sent.
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
  while (!rest.empty()) {
    const std::string_view data = rest.substr(0, kChunkBytes);
    v1::ReadArtifactResponse chunk;
    chunk.set_offset(place);
    chunk.set_data(data.data(), data.size());
    chunk.set_crc32c(Crc32c(data));
    Do([&chunk](Made& made) { made.chunks.push_back(std::move(chunk)); });
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
  Do([&last](Made& made) { made.chunks.push_back(std::move(last)); });
  Pause();
}

void ArtifactMaker::Fail(Error error) {
  Do([&error](Made& made) { made.error = std::move(error); });
  Pause();
}

void ArtifactMaker::Pause() {
  Do([](Made& made) { made.working = false; });
  wake_();
}

}  // namespace contact
