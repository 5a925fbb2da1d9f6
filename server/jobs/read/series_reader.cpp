#include "jobs/read/series_reader.h"

#include <algorithm>
#include <utility>

#include "base/executor.h"
#include "jobs/job/errors.h"
#include "wire/scenario/channels.h"

namespace contact {
namespace {

constexpr std::size_t kPageBytes = 1 << 18;

// Values of a large series, at least [B]: many times what is shown on a screen.
constexpr double kLarge = 1 << 20;

// How many samples there are besides those of sample_interval is not known before they are read.
bool IsLarge(const SeriesSelection& selection, const Scenario& scenario) {
  double most = scenario.end_time / scenario.sample_interval * (1 + 2 * scenario.turning_channels);
  if (scenario.samples_per_contact > 0) most += static_cast<double>(scenario.most_contact_samples);
  const double rows = std::min(static_cast<double>(selection.max_rows), most);
  return rows * static_cast<double>(selection.columns.size() * sizeof(double)) >= kLarge;
}

}  // namespace

SeriesReader::SeriesReader(Store& store, Executor& executor, FewAtOnce& large,
                           const ScenarioLimits& limits, std::string tenant,
                           v1::GetSeriesRequest request, Callback<v1::Series> done,
                           Abandoned abandoned)
    : store_(store),
      executor_(executor),
      large_(large),
      limits_(limits),
      tenant_(std::move(tenant)),
      request_(std::move(request)),
      done_(std::move(done)),
      abandoned_(std::move(abandoned)) {}

void SeriesReader::Start() {
  store_.ReadOf(tenant_, request_.name(), JobPart::kSpec,
                [self = shared_from_this()](absl::StatusOr<StoredJob> stored) {
                  self->Post([self, stored = std::move(stored)] { self->Open(stored); });
                });
}

void SeriesReader::Open(const absl::StatusOr<StoredJob>& stored) {
  if (!stored.ok()) return Answer(ToError(stored.status(), request_.name()));
  const v1::Job& job = stored->job;
  if (job.oldest_sequence() > 1) {
    return Answer(EventsCompacted(job.name(), job.oldest_sequence()));
  }
  const DecodedScenario decoded = DecodeScenario(job.scenario(), limits_);
  if (!job.has_scenario() || !decoded.violations.empty() || decoded.scenario.sample_interval == 0) {
    return Answer(JobError(Reason::kNoTrajectory, job.name(), "records no trajectory"));
  }
  std::vector<v1::FrameChunk::Column> channels = Channels(decoded.scenario);
  Result<SeriesSelection> selection = ToSelection(request_, channels);
  if (!selection.ok()) return Answer(selection.error());
  const bool large = IsLarge(selection.value(), decoded.scenario);
  builder_.emplace(std::move(selection.value()), std::move(channels),
                   FirstChannels(decoded.scenario));
  last_ = job.last_sequence();
  if (!large) return Begin(stored->epoch);
  large_.Run([self = shared_from_this(), attempts = stored->epoch](FewAtOnce::Place place) {
    self->Post([self, attempts, place = std::move(place)] {
      self->place_ = place;
      self->Begin(attempts);
    });
  });
}

void SeriesReader::Begin(std::uint64_t attempts) {
  if (!request_.has_start_time_s() && !request_.has_end_time_s()) return ReadPage();
  // A job that was taken once has one attempt: no need to look through its log.
  if (attempts <= 1) return FindStart();
  FindAttempt();
}

void SeriesReader::ReadEvents(std::uint32_t kinds, std::size_t max_bytes,
                              void (SeriesReader::*take)(const Page&)) {
  store_.ReadEvents({request_.name(), position_, kinds, max_bytes},
                    [self = shared_from_this(), take](Page page) {
                      self->Post([self, take, page = std::move(page)] { ((*self).*take)(page); });
                    });
}

void SeriesReader::Post(std::function<void()> work) {
  if (!executor_.Post(std::move(work))) Answer(MakeError(Reason::kServerDraining));
}

void SeriesReader::FindAttempt() {
  ReadEvents(KindBit(v1::Event::kAttemptStarted), kPageBytes, &SeriesReader::TakeAttempts);
}

void SeriesReader::TakeAttempts(const Page& page) {
  if (!page.ok()) return Answer(ToError(page.status(), request_.name()));
  if (!page->events.empty()) low_ = page->events.back().sequence;
  position_ = page->position;
  if (position_ < last_) return FindAttempt();
  FindStart();
}

void SeriesReader::FindStart() {
  high_ = request_.has_start_time_s() ? last_ : low_;
  Halve();
}

void SeriesReader::Halve() {
  if (high_ <= low_ + 1) {
    position_ = low_;
    return ReadPage();
  }
  probe_ = position_ = low_ + (high_ - low_) / 2;
  Probe();
}

void SeriesReader::Probe() {
  ReadEvents(KindBit(v1::Event::kFrameChunk), 1, &SeriesReader::TakeProbe);
}

void SeriesReader::TakeProbe(const Page& page) {
  if (!page.ok()) return Answer(ToError(page.status(), request_.name()));
  position_ = page->position;
  if (page->events.empty() && position_ < high_) return Probe();
  if (page->events.empty() || page->events.front().sequence > high_) {
    high_ = probe_;
    return Halve();
  }
  const StoredEvent& stored = page->events.front();
  v1::Event event;
  if (!stored.Parse(&event) || !builder_->Fits(event.frame_chunk())) {
    return Answer(Damaged(request_.name()));
  }
  if (builder_->IsBefore(event.frame_chunk())) {
    low_ = stored.sequence;
  } else {
    high_ = probe_;
  }
  Halve();
}

void SeriesReader::ReadPage() {
  ReadEvents(KindBit(v1::Event::kAttemptStarted) | KindBit(v1::Event::kFrameChunk), kPageBytes,
             &SeriesReader::Take);
}

void SeriesReader::Take(const Page& page) {
  if (answered_) return;
  if (abandoned_ && abandoned_()) return Answer(MakeError(Reason::kDeadlineExceeded));
  if (!page.ok()) return Answer(ToError(page.status(), request_.name()));
  if (page->oldest > 1) return Answer(EventsCompacted(request_.name(), page->oldest));
  position_ = page->position;
  const bool more = position_ < last_;
  if (more) ReadPage();  // The store reads it while this one is decoded.
  for (const StoredEvent& event : page->events) {
    if (!Take(event)) return Answer(Damaged(request_.name()));
    if (past_end_) break;
  }
  if (more && !past_end_) return;
  Result<v1::Series> series = builder_->Finish();
  if (series.ok()) series.value().set_name(request_.name());
  Answer(std::move(series));
}

void SeriesReader::Answer(Result<v1::Series> series) {
  if (!answered_.exchange(true)) done_(std::move(series));
  place_ = nullptr;
}

bool SeriesReader::Take(const StoredEvent& stored) {
  v1::Event event;
  if (!stored.Parse(&event)) return false;
  if (event.has_attempt_started()) builder_->Restart();
  if (!event.has_frame_chunk()) return true;
  if (!builder_->Add(event.frame_chunk())) return false;
  past_end_ = builder_->IsPast(event.frame_chunk());
  return true;
}

}  // namespace contact
