#include <gmock/gmock.h>

#include "cli/base/failure.h"
#include "cli/base/scalar.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

TEST(Assignments, TheFirstSignEndsTheNameAndTheLastValueCounts) {
  EXPECT_THAT(ParseAssignments({"a=1", "b=x=y", "c=", "a=2", " d = 3 "}, "--x", ""),
              ElementsAre(Pair(" d ", " 3 "), Pair("a", "2"), Pair("b", "x=y"), Pair("c", "")));
  EXPECT_THAT(ParseAssignments({}, "--x", ""), IsEmpty());
}

TEST(Assignments, OtherTextsAreToldWithTheFlagAndWhatItExpects) {
  for (const std::string text : {"a", "", "=1", "="}) {
    try {
      ParseAssignments({"a=1", text}, "--label", "KEY=VALUE");
      ADD_FAILURE() << text;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::kUsage);
      EXPECT_EQ(failure.what(), "--label " + text + ": expected KEY=VALUE");
    }
  }
}

}  // namespace
}  // namespace contact::cli
