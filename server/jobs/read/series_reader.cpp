#include "jobs/read/series_reader.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/executor.h"
#include "jobs/job/errors.h"
#include "wire/result_codec.h"
#include "wire/scenario/scenario_codec.h"

namespace contact {
namespace {

constexpr std::size_t kPageBytes = 1 << 18;

double ValueAt(const v1::FrameChunk::Column& column, int row) {
  double value;
  std::memcpy(&value, &column.values()[static_cast<std::size_t>(row) * sizeof(double)],
              sizeof(double));
  return value;
}

}  // namespace

SeriesBuilder::SeriesBuilder(SeriesSelection selection,
                             std::vector<v1::FrameChunk::Column> channels)
    : selection_(std::move(selection)), channels_(std::move(channels)) {
  Restart();
}

void SeriesBuilder::Restart() {
  decimator_.reset();
  if (!selection_.raw) decimator_.emplace(selection_.columns.size(), selection_.max_rows);
  rows_.clear();
  recorded_ = 0;
}

bool SeriesBuilder::Fits(const v1::FrameChunk& chunk) const {
  const std::size_t bytes = static_cast<std::size_t>(chunk.samples()) * sizeof(double);
  const auto whole = [bytes](const auto& column) { return column.values().size() == bytes; };
  return chunk.columns_size() == static_cast<int>(channels_.size()) &&
         std::ranges::all_of(chunk.columns(), whole);
}

bool SeriesBuilder::IsPast(const v1::FrameChunk& chunk) const {
  return chunk.samples() > 0 && ValueAt(chunk.columns(0), 0) > selection_.end_time;
}

bool SeriesBuilder::Add(const v1::FrameChunk& chunk) {
  if (!Fits(chunk)) return false;
  for (int row = 0; row < chunk.samples(); ++row) {
    const double time = ValueAt(chunk.columns(0), row);
    if (time < selection_.start_time || time > selection_.end_time) continue;
    AddRow(chunk, row);
  }
  return true;
}

void SeriesBuilder::AddRow(const v1::FrameChunk& chunk, int row) {
  ++recorded_;
  if (selection_.raw && recorded_ > static_cast<std::int64_t>(selection_.max_rows)) return;
  const std::size_t begin = rows_.size();
  for (const int column : selection_.columns) rows_.push_back(ValueAt(chunk.columns(column), row));
  if (!decimator_) return;
  decimator_->Add(std::span(rows_).subspan(begin));
  rows_.clear();
}

Result<v1::Series> SeriesBuilder::Finish() const {
  if (selection_.raw && recorded_ > static_cast<std::int64_t>(selection_.max_rows)) {
    return SeriesTooLarge(selection_.max_rows);
  }
  const std::vector<double> rows = decimator_ ? decimator_->Rows() : rows_;
  const std::size_t width = selection_.columns.size();
  v1::Series series;
  series.set_samples(static_cast<std::int32_t>(rows.size() / width));
  series.set_recorded_samples(recorded_);
  for (std::size_t i = 0; i < width; ++i) {
    v1::FrameChunk::Column& column = *series.add_columns();
    column = channels_[static_cast<std::size_t>(selection_.columns[i])];
    std::string& bytes = *column.mutable_values();
    bytes.resize(rows.size() / width * sizeof(double));
    for (std::size_t row = 0; row * width < rows.size(); ++row) {
      std::memcpy(&bytes[row * sizeof(double)], &rows[row * width + i], sizeof(double));
    }
  }
  return series;
}

SeriesReader::SeriesReader(Store& store, Executor& executor, const ScenarioLimits& limits,
                           v1::GetSeriesRequest request, Caller caller)
    : store_(store),
      executor_(executor),
      limits_(limits),
      request_(std::move(request)),
      caller_(std::move(caller)) {}

void SeriesReader::Read(Store& store, Executor& executor, const ScenarioLimits& limits,
                        const v1::GetSeriesRequest& request, Caller caller) {
  const std::shared_ptr<SeriesReader> self(
      new SeriesReader(store, executor, limits, request, std::move(caller)));
  store.Read(request.name(), JobPart::kSpec, [self](absl::StatusOr<StoredJob> stored) {
    const auto shared = std::make_shared<absl::StatusOr<StoredJob>>(std::move(stored));
    if (!self->executor_.Post([self, shared] { self->Open(*shared); }))
      self->caller_.done(MakeError(Reason::kServerDraining));
  });
}

void SeriesReader::Open(const absl::StatusOr<StoredJob>& stored) {
  if (!stored.ok()) return caller_.done(ToError(stored.status(), request_.name()));
  const v1::Job& job = stored->job;
  if (job.oldest_sequence() > 1) {
    return caller_.done(EventsCompacted(job.name(), job.oldest_sequence()));
  }
  if (!job.has_scenario()) return caller_.done(NoTrajectory(job.name()));
  const DecodedScenario decoded = DecodeScenario(job.scenario(), limits_);
  if (!decoded.violations.empty() || decoded.scenario.sample_interval == 0) {
    return caller_.done(NoTrajectory(job.name()));
  }
  std::vector<v1::FrameChunk::Column> channels = Channels(decoded.scenario);
  Result<SeriesSelection> selection = ToSelection(request_, channels);
  if (!selection.ok()) return caller_.done(selection.error());
  start_time_ = selection.value().start_time;
  builder_.emplace(std::move(selection.value()), std::move(channels));
  last_ = job.last_sequence();
  if (request_.has_start_time_s() || request_.has_end_time_s()) return FindAttempt();
  ReadPage();
}

// Goes on with a page once it is read, on the executor.
void SeriesReader::ReadEvents(EventQuery query, void (SeriesReader::*take)(const Page&)) {
  store_.ReadEvents(std::move(query), [self = shared_from_this(), take](Page page) {
    const auto shared = std::make_shared<const Page>(std::move(page));
    const bool posted = self->executor_.Post([self, take, shared] { ((*self).*take)(*shared); });
    if (!posted) self->caller_.done(MakeError(Reason::kServerDraining));
  });
}

// The last attempt begins the log that counts.
void SeriesReader::FindAttempt() {
  ReadEvents({request_.name(), position_, KindBit(v1::Event::kAttemptStarted), kPageBytes},
             &SeriesReader::TakeAttempts);
}

void SeriesReader::TakeAttempts(const Page& page) {
  if (!page.ok()) return caller_.done(ToError(page.status(), request_.name()));
  if (!page->events.empty()) low_ = page->events.back().sequence;
  position_ = page->position;
  if (position_ < last_) return FindAttempt();
  high_ = request_.has_start_time_s() ? last_ : low_;
  Halve();
}

void SeriesReader::Halve() {
  if (high_ <= low_ + 1) {
    position_ = low_;
    return ReadPage();
  }
  probe_ = position_ = low_ + (high_ - low_) / 2;
  ReadEvents({request_.name(), position_, KindBit(v1::Event::kFrameChunk), 1},
             &SeriesReader::TakeProbe);
}

void SeriesReader::TakeProbe(const Page& page) {
  if (!page.ok()) return caller_.done(ToError(page.status(), request_.name()));
  position_ = page->position;
  if (page->events.empty() && position_ < high_) {
    return ReadEvents({request_.name(), position_, KindBit(v1::Event::kFrameChunk), 1},
                      &SeriesReader::TakeProbe);
  }
  if (page->events.empty() || page->events.front().sequence > high_) {
    high_ = probe_;
    return Halve();
  }
  const StoredEvent& stored = page->events.front();
  v1::Event event;
  if (!stored.Parse(&event) || !builder_->Fits(event.frame_chunk())) {
    return caller_.done(Damaged(request_.name()));
  }
  const v1::FrameChunk& chunk = event.frame_chunk();
  if (chunk.samples() > 0 && ValueAt(chunk.columns(0), chunk.samples() - 1) < start_time_) {
    low_ = stored.sequence;
  } else {
    high_ = probe_;
  }
  Halve();
}

void SeriesReader::ReadPage() {
  constexpr std::uint32_t kKinds =
      (1U << v1::Event::kAttemptStarted) | (1U << v1::Event::kFrameChunk);
  ReadEvents({request_.name(), position_, kKinds, kPageBytes}, &SeriesReader::Take);
}

void SeriesReader::Take(const Page& page) {
  if (caller_.abandoned && caller_.abandoned())
    return caller_.done(MakeError(Reason::kDeadlineExceeded));
  if (!page.ok()) return caller_.done(ToError(page.status(), request_.name()));
  if (page->oldest > 1) return caller_.done(EventsCompacted(request_.name(), page->oldest));
  for (const StoredEvent& event : page->events) {
    if (!Take(event)) return caller_.done(Damaged(request_.name()));
    if (past_end_) break;
  }
  position_ = page->position;
  if (position_ < last_ && !past_end_) return ReadPage();
  Result<v1::Series> series = builder_->Finish();
  if (series.ok()) series.value().set_name(request_.name());
  caller_.done(std::move(series));
}

bool SeriesReader::Take(const StoredEvent& stored) {
  v1::Event event;
  if (!stored.Parse(&event)) return false;
  if (event.has_attempt_started()) builder_->Restart();
  if (!event.has_frame_chunk()) return true;
  if (!builder_->Add(event.frame_chunk())) return false;
  // Without a time range a later attempt may follow, whose times begin anew.
  past_end_ = low_ > 0 && builder_->IsPast(event.frame_chunk());
  return true;
}

}  // namespace contact
