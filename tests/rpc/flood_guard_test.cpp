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

  // What has come from and gone to a connection by then.
  void Look(std::uint64_t received, std::uint64_t sent, int at) {
    guard_->Look({{kBad, received, sent}}, FloodGuard::Time(milliseconds(at)));
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
  Look(0, 0, 0);
  Look(1 << 20, 0, 100);
  EXPECT_THAT(cut_, IsEmpty());
  Look(2 << 20, 0, 200);
  EXPECT_THAT(cut_, ElementsAre(kBad));
}

TEST_F(FloodGuardTest, WhoseCallsAreAnsweredMaySendOn) {
  for (std::uint64_t second = 0; second < 100; ++second) {
    guard_->Answered(kBad);
    Look(second << 30, 0, 1000 * static_cast<int>(second));
  }
  EXPECT_THAT(cut_, IsEmpty());
}

TEST_F(FloodGuardTest, WindowsForWhatAStreamSentAreNoFlood) {
  Look(0, 0, 0);
  for (std::uint64_t second = 1; second < 100; ++second) {
    Look(second * 8'000'000, second * 600'000'000, 1000 * static_cast<int>(second));
  }
  EXPECT_THAT(cut_, IsEmpty());
}

TEST_F(FloodGuardTest, AMessageMayComeAndIsCountedOnce) {
  auto open = guard_->Enter(kBad);
  Look(0, 0, 0);
  Look(100 << 20, 0, 100);
  EXPECT_THAT(cut_, IsEmpty()) << "too large, and yet to be refused";
  guard_->Asked(kBad);
  Look(101 << 20, 0, 200);
  EXPECT_THAT(cut_, ElementsAre(kBad));
}

TEST_F(FloodGuardTest, AnotherConnectionOfTheSameNameBeginsAnew) {
  guard_->Answered(kBad);
  Look(0, 0, 0);
  guard_->Answered(kBad);
  Look(5 << 20, 5 << 20, 50);
  Look(10, 10, 100);
  Look(1 << 20, 10, 150);
  EXPECT_THAT(cut_, IsEmpty());
  guard_->Look({}, FloodGuard::Time(milliseconds(200)));
  Look(1 << 20, 0, 300);
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
