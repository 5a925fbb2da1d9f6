#include "rpc/net/flood_guard.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace contact {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr char kHonest[] = "ipv4:127.0.0.1:1", kBad[] = "ipv4:127.0.0.1:2";

class FloodGuardTest : public testing::Test {
 protected:
  FloodGuardTest() {
    guard_->SetCut([this](const std::string& uri) { cut_.push_back(uri); });
  }

  void TakeBack(const std::string& uri, int calls, milliseconds at) {
    for (int i = 0; i < calls; ++i) guard_->TakenBack(uri, FloodGuard::Time(at));
  }

  // What has come from and gone to a connection by now.
  void Look(std::uint64_t received, std::uint64_t sent) {
    guard_->Look({{kBad, received, sent}}, {});
  }

  const std::shared_ptr<FloodGuard> guard_ = std::make_shared<FloodGuard>();
  std::vector<std::string> cut_;
};

TEST_F(FloodGuardTest, CutsWhoHasMoreCallsOpenThanSettingsAllow) {
  std::vector<FloodGuard::Lease> open;
  for (int i = 0; i < 2000; ++i) open.push_back(guard_->Enter(kBad));
  for (int i = 0; i < 5000; ++i) guard_->Enter(kHonest);
  EXPECT_THAT(cut_, IsEmpty());
  for (int i = 0; i < 100; ++i) open.push_back(guard_->Enter(kBad));
  EXPECT_THAT(cut_, ElementsAre(kBad)) << "once";
}

TEST_F(FloodGuardTest, CutsWhoTakesBackMoreThanAThousandCallsASecond) {
  for (int second = 1; second < 10; ++second) {
    TakeBack(kHonest, 1000, milliseconds(1001 * second));
  }
  EXPECT_THAT(cut_, IsEmpty());
  TakeBack(kBad, 600, milliseconds(5000));
  TakeBack(kBad, 401, milliseconds(5900));
  EXPECT_THAT(cut_, ElementsAre(kBad));
}

TEST_F(FloodGuardTest, CutsWhoSendsFarMoreThanItsCallsNeed) {
  Look(0, 0);
  Look(60 << 20, 0);
  EXPECT_THAT(cut_, IsEmpty()) << "a message that is too large, and yet to be refused";
  Look(65 << 20, 0);
  EXPECT_THAT(cut_, ElementsAre(kBad));
}

TEST_F(FloodGuardTest, WhoseCallsAreAnsweredMaySendOn) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    guard_->Answered(kBad);
    Look(i << 30, 0);
  }
  EXPECT_THAT(cut_, IsEmpty());
}

TEST_F(FloodGuardTest, WindowsForWhatAStreamSentAreNoFlood) {
  for (std::uint64_t i = 0; i < 1000; ++i) Look(i * 8'000'000, i * 600'000'000);
  EXPECT_THAT(cut_, IsEmpty());
}

TEST_F(FloodGuardTest, AnotherConnectionOfTheSameNameBeginsAnew) {
  guard_->Answered(kBad);
  Look(500 << 20, 500 << 20);
  Look(10, 10);
  Look(60 << 20, 10);
  guard_->Look({}, {});  // It is closed.
  Look(60 << 20, 0);
  EXPECT_THAT(cut_, IsEmpty());
}

TEST_F(FloodGuardTest, LeavesSocketFilesAloneAndCutsNothingOnceItIsStopped) {
  TakeBack("unix:", 5000, milliseconds(5000));
  guard_->SetCut(nullptr);
  TakeBack(kBad, 5000, milliseconds(5000));
  EXPECT_THAT(cut_, IsEmpty());
}

}  // namespace
}  // namespace contact
