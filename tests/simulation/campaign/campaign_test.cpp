// The lines of a campaign, its table, and the comparison with an earlier one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "simulation/campaign/result.h"
#include "simulation/campaign/table.h"
#include "simulation/kinds/catalogue.h"

namespace contact::campaign {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Result Line(unsigned seed, Result::Status status, std::int64_t steps = 5000) {
  Result r;
  r.kind = "valve", r.seed = seed, r.status = status, r.steps = steps;
  return r;
}

std::string Against(const Result& before, const Result& after) {
  std::ostringstream out;
  WriteAgainst({before}, {after}, out);
  return out.str();
}

TEST(Campaign, TellsHowARunEnded) {
  const Result r = RunOne(0, 3, {.certify = true, .metamorphic = true});
  EXPECT_EQ(r.kind, "row");
  EXPECT_EQ(r.status, Result::Status::kFull);
  EXPECT_EQ(r.certificate.verdict, Check::Verdict::kAgrees) << r.certificate.what;
  EXPECT_EQ(r.metamorphic.verdict, Check::Verdict::kAgrees) << r.metamorphic.what;
  EXPECT_THAT(r.broken, ::testing::IsEmpty());
}

TEST(Campaign, ReadsTheLinesThatItWrites) {
  Result r = RunOne(0, 3, {.certify = true});
  r.identity = kNaN;
  r.broken = {"identity nan"};
  EXPECT_EQ(ToJson(FromJson(ToJson(r))), ToJson(r));
}

TEST(Campaign, EndsARunByItsBudget) {
  const Result r = RunOne(0, 3, {.max_steps = 10});
  EXPECT_EQ(r.status, Result::Status::kBudget);
  EXPECT_THAT(r.message, HasSubstr("step"));
}

TEST(Campaign, CountsByKind) {
  std::ostringstream out;
  WriteTable({Line(0, Result::Status::kFull), Line(1, Result::Status::kFailed)}, out);
  EXPECT_THAT(out.str(), HasSubstr("valve          2     1       0      0      1"));
  EXPECT_THAT(out.str(), HasSubstr("all            2"));
}

TEST(Campaign, TellsWhatGotBetterAndWorse) {
  const Result full = Line(0, Result::Status::kFull), partial = Line(0, Result::Status::kPartial);
  EXPECT_THAT(Against(partial, full), HasSubstr("better valve 0: PARTIAL -> FULL"));
  EXPECT_THAT(Against(full, partial), HasSubstr("WORSE valve 0: FULL -> PARTIAL"));
  EXPECT_THAT(Against(full, full), Not(HasSubstr("->")));
  EXPECT_THAT(Against(full, Line(0, Result::Status::kFull, 20'000)), HasSubstr("WORSE"));
  EXPECT_THAT(Against(full, Line(1, Result::Status::kFailed)), Not(HasSubstr("->")));
  Result broken = full;
  broken.broken = {"glued"};
  EXPECT_THAT(Against(full, broken), HasSubstr("FULL, glued"));
}

}  // namespace
}  // namespace contact::campaign
