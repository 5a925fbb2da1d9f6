#include "jobs/schedule/run_supervisor.h"

#include <gmock/gmock.h>

#include <memory>
#include <string>
#include <vector>

#include "testing/await.h"
#include "testing/fake_sources.h"

namespace contact {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

class RunSupervisorTest : public testing::Test {
 protected:
  static std::shared_ptr<RunControl> Stopping() {
    auto run = std::make_shared<RunControl>();
    run->Stop(StopCause::kUser);
    return run;
  }

  // Each look moves the clock on.
  FakeClock clock_{100ms};
  JobOptions options_{.step_timeout = 0ms, .stop_timeout = 1s, .look_interval = 1ms};
  EndingRuns endings_;
  std::vector<std::string> lost_;
  Await<std::string> last_;
  RunSupervisor supervisor_{clock_, options_, endings_,
                            [this](const std::string& job, const RunControl&) {
                              lost_.push_back(job);
                              if (job == "jobs/last") last_.callback()(job);
                            }};
};

TEST_F(RunSupervisorTest, OnlyRunsThatDoNotReactAreLostAndEachOnce) {
  const auto held = Stopping();
  const RunControl::Hold hold(*held);
  const auto deaf = Stopping();
  const auto running = std::make_shared<RunControl>();
  supervisor_.Add("jobs/held", held);
  supervisor_.Add("jobs/running", running);
  supervisor_.Add("jobs/deaf", deaf);
  clock_.AwaitReadings(100);
  supervisor_.Add("jobs/last", Stopping());
  last_.Get();
  supervisor_.Stop();
  EXPECT_THAT(lost_, ElementsAre("jobs/deaf", "jobs/last"));
  EXPECT_FALSE(RunControl::Hold(*deaf));
  EXPECT_TRUE(RunControl::Hold(*running));
}

TEST_F(RunSupervisorTest, RunThatHasEndedIsNotGivenUp) {
  const auto ended = Stopping();
  supervisor_.Add("jobs/ended", ended);
  supervisor_.Remove("jobs/ended");
  supervisor_.Add("jobs/last", Stopping());
  last_.Get();
  supervisor_.Stop();
  EXPECT_THAT(lost_, ElementsAre("jobs/last"));
  EXPECT_TRUE(RunControl::Hold(*ended));
}

}  // namespace
}  // namespace contact
