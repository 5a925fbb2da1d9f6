#include "cli/link/recording.h"

#include <gmock/gmock.h>

#include <cstring>

namespace contact::cli {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

v1::Event Chunk(std::int64_t first, const std::vector<double>& values) {
  v1::Event event;
  v1::FrameChunk& chunk = *event.mutable_frame_chunk();
  chunk.set_first_sample(first);
  chunk.set_samples(static_cast<std::int32_t>(values.size()));
  v1::FrameChunk::Column& column = *chunk.add_columns();
  column.set_name("time");
  column.set_unit("s");
  column.mutable_values()->resize(values.size() * sizeof(double));
  std::memcpy(column.mutable_values()->data(), values.data(), values.size() * sizeof(double));
  return event;
}

// The columns of a sample, of which each but the first has an event of its own.
std::vector<v1::Event> SplitChunk(std::uint64_t sequence, double time, double value) {
  std::vector<v1::Event> events;
  for (const char* name : {"a", "b"}) {
    v1::Event& event = events.emplace_back(Chunk(std::int64_t(time), {time}));
    event.set_sequence(sequence++);
    event.mutable_frame_chunk()->set_columns_follow(events.size() == 1);
    v1::FrameChunk::Column& column = *event.mutable_frame_chunk()->add_columns();
    column.set_name(name);
    column.set_values(Chunk(0, {value++}).frame_chunk().columns(0).values());
  }
  return events;
}

v1::Event Pass(int episode, int number) {
  v1::Event event;
  event.mutable_iteration()->set_episode(episode);
  event.mutable_iteration()->set_number(number);
  return event;
}

TEST(Recorder, JoinsChunksInOrderAndHearsEachOnce) {
  Recorder recorder;
  for (const auto& event : {Chunk(2, {3, 4}), Chunk(0, {1, 2}), Chunk(2, {3, 4})}) {
    recorder.OnEvent(event);
  }
  EXPECT_FALSE(recorder.has_holes());
  ASSERT_EQ(recorder.Columns().size(), 1U);
  EXPECT_EQ(recorder.Columns()[0].unit, "s");
  EXPECT_THAT(recorder.Columns()[0].values, ElementsAre(1, 2, 3, 4));
}

TEST(Recorder, JoinsColumnsThatCameInSeveralEvents) {
  Recorder recorder;
  for (const double time : {1, 0, 2}) {
    const auto sequence = static_cast<std::uint64_t>(2 * time + 1);
    for (const auto& event : SplitChunk(sequence, time, 10 * time)) recorder.OnEvent(event);
  }
  EXPECT_FALSE(recorder.has_holes());
  recorder.OnEvent(SplitChunk(7, 3, 30)[0]);  // The rest is not there yet.
  const auto columns = recorder.Columns();
  ASSERT_EQ(columns.size(), 3U);
  EXPECT_THAT(columns[0].values, ElementsAre(0, 1, 2));
  EXPECT_THAT(columns[1].values, ElementsAre(0, 10, 20));
  EXPECT_THAT(columns[2].values, ElementsAre(1, 11, 21));
  recorder.OnEvent(SplitChunk(8, 3, 30)[1]);  // Another event than the one that has the rest.
  EXPECT_TRUE(recorder.has_holes());
}

TEST(Recorder, NoticesChunksThatDidNotCome) {
  Recorder recorder;
  EXPECT_FALSE(recorder.has_holes());
  recorder.OnEvent(Chunk(0, {1}));
  recorder.OnEvent(Chunk(2, {3}));
  EXPECT_TRUE(recorder.has_holes());
  recorder.OnEvent(Chunk(1, {2}));
  EXPECT_FALSE(recorder.has_holes());
}

TEST(Recorder, HasTheLedgerThatAnAnswerMayHaveNot) {
  Recorder recorder;
  for (const int sequence : {4, 7, 4}) {
    v1::Event event;
    event.set_sequence(static_cast<std::uint64_t>(sequence));
    event.mutable_cycle()->set_number(sequence);
    recorder.OnEvent(event);
    event.set_sequence(static_cast<std::uint64_t>(sequence) + 1);
    event.mutable_group()->set_first_cycle(sequence);
    recorder.OnEvent(event);
  }
  ASSERT_EQ(recorder.Cycles().size(), 2U);
  EXPECT_EQ(recorder.Cycles()[1].number(), 7);
  ASSERT_EQ(recorder.Groups().size(), 2U);
  EXPECT_EQ(recorder.Groups()[1].first_cycle(), 7);
}

TEST(Recorder, ForgetsEarlierAttempts) {
  Recorder recorder;
  recorder.OnEvent(Chunk(0, {1, 2}));
  recorder.OnEvent(Pass(1, 0));
  v1::Event group;
  group.mutable_group()->set_number(1);
  recorder.OnEvent(group);
  v1::Event again;
  again.mutable_attempt_started()->set_attempt(2);
  recorder.OnEvent(again);
  EXPECT_THAT(recorder.Columns(), IsEmpty());
  EXPECT_THAT(recorder.Iterations(), IsEmpty());
  EXPECT_THAT(recorder.Groups(), IsEmpty());
}

TEST(Recorder, OrdersPassesByEpisode) {
  Recorder recorder;
  for (const auto& event : {Pass(2, 0), Pass(1, 1), Pass(1, 0)}) recorder.OnEvent(event);
  std::vector<int> order;
  for (const auto& pass : recorder.Iterations())
    order.push_back(10 * pass.episode() + pass.number());
  EXPECT_THAT(order, ElementsAre(10, 11, 20));
}

}  // namespace
}  // namespace contact::cli
