#include <fmt/format.h>
#include <openssl/sha.h>

#include <array>
#include <bit>
#include <charconv>
#include <functional>
#include <sstream>

#include "jobs/read/frame_values.h"
#include "jobs_fixture.h"

namespace contact {
namespace {

using testing::ElementsAre;

class ArtifactTest : public JobsTest {
 protected:
  struct Read {
    std::string data;
    v1::Artifact artifact;
    std::optional<Error> error;
  };
  Read Get(const std::string& job, const std::string& name, std::int64_t offset = 0) {
    v1::ReadArtifactRequest request;
    request.set_name(job);
    request.set_artifact(name);
    request.set_offset(offset);
    using Opened = Result<Recordings::Artifact>;
    const auto box = std::make_shared<std::promise<Opened>>();
    LogReader waiter;
    manager_->recordings().ReadArtifact(
        LocalPrincipal(), request, waiter.wake(),
        [box](Opened opened) { box->set_value(std::move(opened)); });
    Opened opened = box->get_future().get();
    Read read;
    if (!opened.ok()) {
      read.error = opened.error();
      return read;
    }
    for (;;) {
      v1::ReadArtifactResponse chunk;
      const StreamStep step = opened.value()->Read(&chunk);
      read.data += chunk.data();
      read.artifact = chunk.artifact();
      read.error = step.error;
      if (step.ended || step.error) return read;
      if (!step.has_message) waiter.Wait();
    }
  }
  std::string ReasonOf(const std::string& job, const std::string& name, std::int64_t offset = 0) {
    const Read read = Get(job, name, offset);
    return read.error ? read.error->reason : "";
  }
  std::vector<std::string> Names(const std::string& job) {
    std::vector<std::string> names;
    const v1::Job answer = JobsTest::Get(job).value();
    for (const v1::Artifact& artifact : answer.artifacts()) names.push_back(artifact.name());
    return names;
  }
};

std::string Sha256(const std::string& data) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> hash{};
  SHA256(reinterpret_cast<const unsigned char*>(data.data()), data.size(), hash.data());
  return {hash.begin(), hash.end()};
}

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST_F(ArtifactTest, TrajectoryIsTheLogToTheLastBit) {
  Open();
  const std::string job = Create(BouncingBall(200));
  Ended(job);
  EXPECT_THAT(Names(job), ElementsAre("cycles.csv", "groups.csv", "trajectory.csv"));
  const std::vector<std::string> lines = Lines(Get(job, "trajectory.csv").data);
  ASSERT_EQ(lines.size(), 802U);
  EXPECT_TRUE(lines[0].starts_with("time [s],ball.position [m],ball.velocity [m/s],")) << lines[0];
  std::size_t line = 1;
  for (const v1::Event& event : Log(job, 0, {"frame_chunk"})) {
    for (int row = 0; row < event.frame_chunk().samples(); ++row, ++line) {
      const char* text = lines[line].c_str();
      for (const auto& column : event.frame_chunk().columns()) {
        const double expected = ValueAt(column, row);
        double value = 0;
        text = std::from_chars(text, lines[line].c_str() + lines[line].size(), value).ptr + 1;
        ASSERT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(expected))
            << lines[line];
      }
    }
  }
  EXPECT_EQ(line, lines.size());
}

TEST_F(ArtifactTest, AnyOffsetGivesTheRestOfTheSameBytes) {
  Open();
  const std::string job = Create(BouncingBall(200));
  Ended(job);
  const Read whole = Get(job, "trajectory.csv");
  EXPECT_EQ(whole.artifact.size_bytes(), static_cast<std::int64_t>(whole.data.size()));
  EXPECT_EQ(whole.artifact.sha256(), Sha256(whole.data));
  const std::int64_t size = whole.artifact.size_bytes();
  for (const std::int64_t offset : {std::int64_t{1}, size / 2, size - 1, size}) {
    const Read rest = Get(job, "trajectory.csv", offset);
    EXPECT_TRUE(rest.data == whole.data.substr(static_cast<std::size_t>(offset))) << offset;
    EXPECT_EQ(rest.artifact.sha256(), whole.artifact.sha256());
  }
  const Read past = Get(job, "trajectory.csv", size + 1);
  ASSERT_TRUE(past.error);
  EXPECT_EQ(past.error->reason, "OFFSET_OUT_OF_RANGE");
  EXPECT_EQ(past.error->metadata.at("size_bytes"), std::to_string(size));
}

TEST_F(ArtifactTest, CyclesAreTheLedger) {
  Open();
  const std::string job = Create(BouncingBall(2));
  const v1::Job ended = Ended(job);
  const std::vector<std::string> lines = Lines(Get(job, "cycles.csv").data);
  ASSERT_EQ(lines.size(), static_cast<std::size_t>(ended.cycles_size()) + 1);
  EXPECT_TRUE(
      lines[0].starts_with("contact,number [1],kind,end,status,iterations [1],episode [1],"
                           "start_time [s],"))
      << lines[0];
  EXPECT_TRUE(lines[1].starts_with("ball-wall,1,COLLISION,SEPARATION,")) << lines[1];
}

TEST_F(ArtifactTest, GroupsAreThoseOfTheJob) {
  Open();
  const std::string job = Create(BouncingBall(2));
  const v1::Job ended = Ended(job);
  const std::vector<std::string> lines = Lines(Get(job, "groups.csv").data);
  ASSERT_GT(ended.groups_size(), 3);
  ASSERT_EQ(lines.size(), static_cast<std::size_t>(ended.groups_size()) + 1);
  EXPECT_TRUE(
      lines[0].starts_with("contact,number [1],first_cycle [1],cycles [1],encounter [1],"
                           "start_time [s],end_time [s],end,mu [N·s/m^(n+1)],"))
      << lines[0];
  for (int i = 0; i < ended.groups_size(); ++i) {
    const v1::Group& group = ended.groups(i);
    const std::string begin = fmt::format("{},{},{},{},{},", group.contact(), group.number(),
                                          group.first_cycle(), group.cycles(), group.encounter());
    EXPECT_TRUE(lines[static_cast<std::size_t>(i) + 1].starts_with(begin)) << begin;
  }
}

TEST_F(ArtifactTest, AListOfNumbersIsOneCell) {
  FakeRun run([](const Scenario&, Observer& observer, const std::stop_token&) {
    observer.OnGroup({.number = 1, .other_roots = {5, 1.5}});
    observer.OnGroup({.number = 2});
    return Outcome{};
  });
  run.Allow();
  Open({.workers = 1, .run = std::ref(run)});
  const std::string job = Create(BouncingBall(2));
  Ended(job);
  const std::vector<std::string> lines = Lines(Get(job, "groups.csv").data);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_TRUE(lines[0].ends_with(",other_roots [N·s/m^(n+1)]")) << lines[0];
  EXPECT_TRUE(lines[1].ends_with(",0,5 1.5")) << lines[1];
  EXPECT_TRUE(lines[2].ends_with(",0,")) << lines[2];
}

TEST_F(ArtifactTest, EarlierAttemptsAreLeftOut) {
  FakeRun run([](const Scenario&, Observer& observer, const std::stop_token& stop) {
    observer.OnSamples({0, 7, std::vector<double>(14, 3)});
    while (!stop.stop_requested()) std::this_thread::yield();
    return Ending(Outcome::End::kStopped);
  });
  run.Allow();
  Open({.workers = 1, .run = std::ref(run)});
  const std::string job = Create(BouncingBall(2));
  run.AwaitStarted(1);
  Open();  // Begins again with the true solver.
  Ended(job);
  const std::vector<std::string> lines = Lines(Get(job, "trajectory.csv").data);
  EXPECT_EQ(lines.size(), 10U);
  EXPECT_TRUE(lines[1].starts_with("0,0.1000000000000000")) << lines[1];
}

v1::CreateJobRequest Study() {
  v1::CreateJobRequest request;
  v1::Sweep& sweep = *request.mutable_job()->mutable_sweep();
  *sweep.mutable_base() = BouncingBall(20);
  v1::Sweep::Axis& axis = *sweep.add_axes();
  axis.set_field("bodies[0].position_m");
  for (int i = 1; i <= 12; ++i) axis.add_values(0.1 * i);
  sweep.add_axes()->set_field("contacts[0].stiffness");
  for (const double stiffness : {1e6, 2e6, -1.0}) sweep.mutable_axes(1)->add_values(stiffness);
  return request;
}

TEST_F(ArtifactTest, KeptCellIsTheTrajectoryOfItsScenario) {
  Open({.workers = 3});
  v1::CreateJobRequest request = Study();
  for (const int cell : {7, 0, 34, 2})
    request.mutable_job()->mutable_sweep()->add_keep_trajectories(cell);
  const std::string job = Create(request).value().name();
  EXPECT_EQ(Ended(job).state(), v1::Job::SUCCEEDED);
  EXPECT_THAT(Names(job), ElementsAre("cells/7/trajectory.csv", "cells/0/trajectory.csv",
                                      "cells/34/trajectory.csv", "cells/2/trajectory.csv"));
  v1::Scenario alone = BouncingBall(20);
  alone.mutable_bodies(0)->set_position_m(0.1 * 12);
  alone.mutable_contacts(0)->set_stiffness(2e6);
  const std::string same = Create(alone);
  Ended(same);
  EXPECT_TRUE(Get(job, "cells/34/trajectory.csv").data == Get(same, "trajectory.csv").data);
  EXPECT_EQ(ReasonOf(job, "cells/2/trajectory.csv"), "ARTIFACT_NOT_FOUND") << "an invalid cell";
  EXPECT_EQ(ReasonOf(job, "cells/3/trajectory.csv"), "ARTIFACT_NOT_FOUND") << "was not kept";
  EXPECT_EQ(ReasonOf(job, "trajectory.csv"), "ARTIFACT_NOT_FOUND");
}

TEST_F(ArtifactTest, WatchersOfASweepGetKeptSamplesOnlyIfTheyAsk) {
  Open();
  v1::CreateJobRequest request = Study();
  request.mutable_job()->mutable_sweep()->add_keep_trajectories(4);
  const std::string job = Create(request).value().name();
  Ended(job);
  const auto frames = [&](const std::vector<std::string>& kinds) {
    return std::ranges::count_if(Log(job, 0, kinds),
                                 [](const v1::Event& event) { return event.has_frame_chunk(); });
  };
  EXPECT_EQ(frames({}), 0);
  EXPECT_EQ(frames({"frame_chunk"}), 1);
}

TEST_F(ArtifactTest, OnlyEndedJobsHaveThem) {
  OpenWithFakeRun();
  const std::string job = Create();
  EXPECT_THAT(Names(job), testing::IsEmpty());
  EXPECT_EQ(ReasonOf(job, "cycles.csv"), "INVALID_STATE");
  Cancel(job);
  Ended(job);
  EXPECT_EQ(ReasonOf(job, "trajectory.csv"), "ARTIFACT_NOT_FOUND") << "nothing was recorded";
  EXPECT_EQ(ReasonOf(job, "cycle.csv"), "ARTIFACT_NOT_FOUND");
  EXPECT_EQ(ReasonOf("jobs/none", "cycles.csv"), "JOB_NOT_FOUND");
}

TEST_F(ArtifactTest, CellsToKeepAreChecked) {
  OpenWithFakeRun();
  for (const std::vector<int>& cells : {std::vector{-1}, {36}, {1, 1}, std::vector<int>(101)}) {
    v1::CreateJobRequest request = Study();
    request.mutable_job()->mutable_sweep()->mutable_keep_trajectories()->Add(cells.begin(),
                                                                             cells.end());
    const auto result = Create(request);
    ASSERT_FALSE(result.ok());
    EXPECT_TRUE(result.error().violations.front().field.starts_with("sweep.keep_trajectories"));
  }
}

}  // namespace
}  // namespace contact
