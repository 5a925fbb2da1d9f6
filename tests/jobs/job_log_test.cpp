#include "jobs/log/job_log.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace contact {
namespace {

std::vector<v1::Event> StateChanged(v1::Job::State state) {
  v1::Event event;
  event.mutable_state_changed()->set_state(state);
  return {event};
}

JobLog::Tail::Found FoundIn(JobLog& log, std::uint64_t position) {
  std::uint64_t progress = 0;
  return log.After({position, ~0U, 1 << 20}, &progress, std::make_shared<const Wake>([] {})).found;
}

TEST(JobLogTest, TellsOfTheEndBeforeAnybodySeesIt) {
  std::vector<JobLog::Tail::Found> seen;
  JobLog* told = nullptr;
  JobLog log(0, false, {}, [&] { seen.push_back(FoundIn(*told, 1)); });
  told = &log;
  log.Append(1, StateChanged(v1::Job::RUNNING));
  EXPECT_TRUE(seen.empty()) << "a job that runs has not ended";
  log.Append(2, StateChanged(v1::Job::SUCCEEDED));
  EXPECT_EQ(seen, std::vector{JobLog::Tail::Found::kNothing});
  EXPECT_EQ(FoundIn(log, 1), JobLog::Tail::Found::kEvents);
}

}  // namespace
}  // namespace contact
