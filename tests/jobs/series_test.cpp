#include <cmath>
#include <cstring>
#include <functional>
#include <map>

#include "jobs_fixture.h"

namespace contact {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> Values(const v1::FrameChunk::Column& column) {
  std::vector<double> values(column.values().size() / sizeof(double));
  if (!values.empty()) std::memcpy(values.data(), column.values().data(), column.values().size());
  return values;
}

std::vector<std::string> Names(const v1::Series& series) {
  std::vector<std::string> names;
  for (const auto& column : series.columns()) names.push_back(column.name());
  return names;
}

class SeriesTest : public JobsTest {
 protected:
  Result<v1::Series> Series(const v1::GetSeriesRequest& request) {
    Await<Result<v1::Series>> result;
    manager_->recordings().GetSeries(LocalPrincipal(), request, result.callback());
    return result.Get();
  }
  static v1::GetSeriesRequest Ask(const std::string& name,
                                  const std::vector<std::string>& channels = {}) {
    v1::GetSeriesRequest request;
    request.set_name(name);
    for (const std::string& channel : channels) request.add_channels(channel);
    return request;
  }
  static v1::GetSeriesRequest Raw(const std::string& name,
                                  const std::vector<std::string>& channels = {}) {
    v1::GetSeriesRequest request = Ask(name, channels);
    request.set_decimation(v1::GetSeriesRequest::RAW);
    return request;
  }
  // What the log holds of a column.
  std::vector<double> Logged(const std::string& name, const std::string& channel) {
    std::vector<double> all;
    for (const v1::Event& event : Log(name, 0, {"frame_chunk"})) {
      for (const auto& column : event.frame_chunk().columns()) {
        if (column.name() != channel) continue;
        const std::vector<double> values = Values(column);
        all.insert(all.end(), values.begin(), values.end());
      }
    }
    return all;
  }
};

TEST_F(SeriesTest, RawEqualsTheLog) {
  Open();
  const std::string name = Create(BouncingBall(200));
  Ended(name);
  const v1::Series series = Series(Raw(name)).value();
  EXPECT_EQ(series.name(), name);
  EXPECT_EQ(series.samples(), 801);
  EXPECT_EQ(series.recorded_samples(), 801);
  EXPECT_EQ(series.columns_size(), 7 + 1 + 5);
  EXPECT_EQ(series.columns(0).name(), "time");
  for (const auto& column : series.columns()) {
    EXPECT_EQ(Values(column), Logged(name, column.name())) << column.name();
  }
}

TEST_F(SeriesTest, PlainNumbersAreTheSameValues) {
  Open();
  const std::string name = Create(BouncingBall(200));
  Ended(name);
  v1::GetSeriesRequest request = Raw(name);
  const v1::Series packed = Series(request).value();
  request.set_plain_numbers(true);
  const v1::Series plain = Series(request).value();
  ASSERT_EQ(plain.columns_size(), packed.columns_size());
  for (int i = 0; i < plain.columns_size(); ++i) {
    EXPECT_THAT(plain.columns(i).numbers(), testing::ElementsAreArray(Values(packed.columns(i))));
    EXPECT_EQ(plain.columns(i).values(), "");
  }
}

TEST_F(SeriesTest, ChannelsComeInTheOrderAskedForWithTheirUnits) {
  Open();
  const std::string name = Create(BouncingBall(2));
  Ended(name);
  const v1::Series series =
      Series(Ask(name, {"ball-wall.contact_force", "ball.position", "ball.position"})).value();
  EXPECT_THAT(Names(series), ElementsAre("time", "ball-wall.contact_force", "ball.position"));
  EXPECT_EQ(series.columns(1).quantity(), "contact_force");
  EXPECT_EQ(series.columns(1).unit(), "N");
}

TEST_F(SeriesTest, MinMaxKeepsThePeaksOfTheLog) {
  Open();
  const std::string name = Create(BouncingBall(200));
  Ended(name);
  v1::GetSeriesRequest request = Ask(name, {"ball.velocity", "ball.position"});
  request.set_max_points(30);
  const v1::Series series = Series(request).value();
  EXPECT_LE(series.samples(), 30);
  EXPECT_EQ(series.recorded_samples(), 801);
  for (const auto* channel : {"ball.velocity", "ball.position"}) {
    const std::vector<double> all = Logged(name, channel);
    const std::vector<double> kept = Values(series.columns(channel[5] == 'v' ? 1 : 2));
    EXPECT_EQ(*std::ranges::max_element(kept), *std::ranges::max_element(all));
    EXPECT_EQ(*std::ranges::min_element(kept), *std::ranges::min_element(all));
  }
  const std::vector<double> times = Values(series.columns(0));
  EXPECT_EQ(times.front(), 0);
  EXPECT_EQ(times.back(), 200);
}

TEST_F(SeriesTest, TimeRangeIncludesItsEnds) {
  Open();
  const std::string name = Create(BouncingBall(20));
  Ended(name);
  v1::GetSeriesRequest request = Raw(name, {"ball.position"});
  request.set_start_time_s(1);
  request.set_end_time_s(2);
  const v1::Series series = Series(request).value();
  EXPECT_THAT(Values(series.columns(0)), ElementsAre(1, 1.25, 1.5, 1.75, 2));
}

TEST_F(SeriesTest, NothingIsReadForACallerThatHasLeft) {
  Open();
  const std::string name = Create(BouncingBall(2));
  Ended(name);
  Await<Result<v1::Series>> left;
  manager_->recordings().GetSeries(LocalPrincipal(), Ask(name), left.callback(),
                                   [] { return true; });
  EXPECT_EQ(left.Get().error().reason, "DEADLINE_EXCEEDED");
}

// Any part of the whole, from a log of many chunks with other events between, in two attempts.
TEST_F(SeriesTest, AnyTimeRangeIsThatPartOfTheWhole) {
  constexpr int kChunks = 40;
  constexpr int kRows = 5;
  FakeRun run([](const Scenario&, Observer& observer, const std::stop_token&) {
    for (int chunk = 0; chunk < kChunks; ++chunk) {
      std::vector<double> values(std::size_t{7} * kRows, 0.5);
      for (int row = 0; row < kRows; ++row)
        values[static_cast<std::size_t>(row) * 7] = chunk * kRows + row;
      observer.OnSamples({std::int64_t{kRows} * chunk, 7, std::move(values)});
      for (int i = 0; i < chunk % 3; ++i) observer.OnWarning("between");
    }
    return Outcome{};
  });
  run.Allow();
  Open({.workers = 1, .run = std::ref(run)});
  const std::string name = Create(BouncingBall(1e4));
  Ended(name);
  const std::vector<double> whole = Values(Series(Raw(name, {"ball.position"})).value().columns(0));
  ASSERT_EQ(whole.size(), static_cast<std::size_t>(kChunks * kRows));
  for (double start = -1; start < 203; start += 3.5) {
    for (const double length : {0.0, 0.4, 1.0, 7.0, 60.0, 500.0}) {
      v1::GetSeriesRequest request = Raw(name, {"ball.position"});
      request.set_start_time_s(start);
      request.set_end_time_s(start + length);
      std::vector<double> expected;
      std::ranges::copy_if(whole, std::back_inserter(expected),
                           [&](double time) { return time >= start && time <= start + length; });
      EXPECT_EQ(Values(Series(request).value().columns(0)), expected) << start << " " << length;
    }
    v1::GetSeriesRequest from = Raw(name, {"ball.position"});
    from.set_start_time_s(start);
    EXPECT_EQ(Series(from).value().samples(),
              std::ranges::count_if(whole, [&](double time) { return time >= start; }));
    v1::GetSeriesRequest until = Raw(name, {"ball.position"});
    until.set_end_time_s(start);
    EXPECT_EQ(Series(until).value().samples(),
              std::ranges::count_if(whole, [&](double time) { return time <= start; }));
  }
}

TEST_F(SeriesTest, ReadsWhatARunningJobHasRecorded) {
  FakeRun run([](const Scenario&, Observer& observer, const std::stop_token& stop) {
    observer.OnSamples({0, 7, std::vector<double>(14, 3)});
    while (!stop.stop_requested()) {
      std::this_thread::yield();
      observer.OnProgress({});
    }
    return Ending(Outcome::End::kStopped);
  });
  JobOptions options;
  options.run = std::ref(run);
  Open(options);
  const std::string name = Create();
  EXPECT_EQ(Series(Ask(name)).value().samples(), 0);
  run.Allow();
  LogReader reader;
  const auto watched = Watch(name, reader, 0, {"frame_chunk"});
  for (bool seen = false; !seen;) {
    for (const v1::Event& event : reader.Next(*watched.value().cursor)) {
      seen |= event.has_frame_chunk();
    }
  }
  EXPECT_EQ(Series(Ask(name)).value().samples(), 2);
  Cancel(name);
}

TEST_F(SeriesTest, EarlierAttemptsAreLeftOut) {
  FakeRun run([](const Scenario&, Observer& observer, const std::stop_token& stop) {
    observer.OnSamples({0, 7, std::vector<double>(28, 1)});
    while (!stop.stop_requested()) std::this_thread::yield();
    return Ending(Outcome::End::kStopped);
  });
  run.Allow();
  JobOptions options;
  options.run = std::ref(run);
  Open(options);
  const std::string name = Create();
  run.AwaitStarted(1);
  manager_->Stop();  // The job goes back into the queue.

  FakeRun again([](const Scenario&, Observer& observer, const std::stop_token&) {
    observer.OnSamples({0, 7, std::vector<double>(14, 2)});
    return Outcome{};
  });
  again.Allow();
  options.run = std::ref(again);
  Open(options);
  Ended(name);
  EXPECT_EQ(Logged(name, "time"), (std::vector<double>{1, 1, 1, 1, 2, 2}));
  EXPECT_THAT(Values(Series(Raw(name)).value().columns(0)), ElementsAre(2, 2));
  for (const auto& [start, end] : {std::pair{0, 1}, {1, 2}, {2, 3}, {3, 4}}) {
    v1::GetSeriesRequest request = Raw(name);
    request.set_start_time_s(start);
    EXPECT_EQ(Series(request).value().samples(), start <= 2 ? 2 : 0) << start;
    request.set_end_time_s(end);
    EXPECT_EQ(Series(request).value().samples(), start <= 2 && end >= 2 ? 2 : 0) << start;
  }
}

// Its chunks have the first columns of today's.
TEST_F(SeriesTest, OfAJobOfAnOlderServerThereIsWhatItRecordedAndNoMore) {
  FakeRun run([](const Scenario&, Observer& observer, const std::stop_token&) {
    observer.OnSamples({0, 7, std::vector<double>(14, 2)});
    return Outcome{};
  });
  run.Allow();
  Open({.workers = 1, .run = std::ref(run)});
  const std::string name = Create(BouncingBall(2));
  Ended(name);
  const v1::Series all = Series(Ask(name)).value();
  EXPECT_EQ(all.samples(), 2);
  ASSERT_EQ(all.columns_size(), 7);
  EXPECT_EQ(all.columns(6).name(), "ball-wall.external_force");
  EXPECT_EQ(Series(Raw(name)).value().columns_size(), 7);
  EXPECT_THAT(Names(Series(Ask(name, {"ball.velocity"})).value()),
              ElementsAre("time", "ball.velocity"));
  const auto refused = Series(Ask(name, {"ball.velocity", "ball.acceleration"}));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().reason, "FIELD_INVALID");
  ASSERT_EQ(refused.error().violations.size(), 1U);
  EXPECT_EQ(refused.error().violations[0].description, "'ball.acceleration' is not recorded");
}

TEST_F(SeriesTest, UnknownChannelsAreAllNamedWithWhatThereIs) {
  Open();
  const std::string name = Create(BouncingBall(2));
  Ended(name);
  const auto refused = Series(Ask(name, {"ball.velocty", "time", "far.away"}));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().reason, "FIELD_INVALID");
  ASSERT_EQ(refused.error().violations.size(), 2U);
  EXPECT_EQ(refused.error().violations[0].field, "channels[0]");
  EXPECT_EQ(refused.error().violations[0].hint, "did you mean 'ball.velocity'?");
  EXPECT_EQ(refused.error().violations[1].field, "channels[2]");
  EXPECT_THAT(refused.error().violations[1].hint, HasSubstr("time, ball.position"));
}

TEST_F(SeriesTest, ImpossibleRangesAndPointsAreRefused) {
  Open();
  const std::string name = Create(BouncingBall(2));
  Ended(name);
  v1::GetSeriesRequest request = Ask(name);
  request.set_start_time_s(2);
  request.set_end_time_s(1);
  request.set_max_points(25);  // 12 channels need 26.
  const auto refused = Series(request);
  ASSERT_FALSE(refused.ok());
  ASSERT_EQ(refused.error().violations.size(), 2U);
  EXPECT_EQ(refused.error().violations[0].field, "end_time_s");
  EXPECT_EQ(refused.error().violations[1].field, "max_points");
  request.clear_end_time_s();
  request.set_max_points(26);
  EXPECT_TRUE(Series(request).ok());
  request.set_start_time_s(std::nan(""));
  EXPECT_FALSE(Series(request).ok());
}

TEST_F(SeriesTest, RawRefusesMoreThanItsPoints) {
  Open();
  const std::string name = Create(BouncingBall(25));
  Ended(name);
  v1::GetSeriesRequest request = Raw(name);
  request.set_max_points(101);
  EXPECT_EQ(Series(request).value().samples(), 101);
  request.set_max_points(100);
  EXPECT_EQ(Series(request).error().reason, "SERIES_TOO_LARGE");
  EXPECT_EQ(Series(request).error().code, absl::StatusCode::kOutOfRange);
}

TEST_F(SeriesTest, AnswerStaysBelowWhatAClientTakes) {
  FakeRun run([](const Scenario&, Observer& observer, const std::stop_token&) {
    for (int i = 0; i < 75; ++i)
      observer.OnSamples({std::int64_t{1000} * i, 7, std::vector<double>(7000, i)});
    return Outcome{};
  });
  run.Allow();
  JobOptions options;
  options.run = std::ref(run);
  Open(options);
  const std::string name = Create();
  Ended(name);
  EXPECT_EQ(Series(Raw(name)).error().reason, "SERIES_TOO_LARGE");
  EXPECT_EQ(Series(Raw(name, {"ball.position"})).value().samples(), 75'000);
  v1::GetSeriesRequest request = Ask(name);
  request.set_max_points(1'000'000);
  const v1::Series series = Series(request).value();
  EXPECT_GT(series.samples(), 10'000);
  EXPECT_LT(series.ByteSizeLong(), 4U << 20);
}

TEST_F(SeriesTest, JobsWithoutTrajectorySaySo) {
  OpenWithFakeRun();
  v1::Scenario scenario = BouncingBall(2);
  scenario.mutable_output()->set_ledger_only(true);
  EXPECT_EQ(Series(Ask(Create(scenario))).error().reason, "NO_TRAJECTORY");
  EXPECT_EQ(Series(Ask("jobs/none")).error().reason, "JOB_NOT_FOUND");
  EXPECT_EQ(Series(Ask("jobs/none")).error().code, absl::StatusCode::kNotFound);
}

}  // namespace
}  // namespace contact
