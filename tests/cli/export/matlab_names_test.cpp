#include "cli/export/matlab_names.h"

#include <gmock/gmock.h>

namespace contact::cli {
namespace {

using testing::ElementsAre;

TEST(MatlabNames, AreValidAndStayApart) {
  EXPECT_THAT(MatlabNames({"time", "B1-B2.mu", "B1_B2.mu", "1.velocity", "_a"}),
              ElementsAre("time", "B1_B2_mu", "B1_B2_mu_2", "x1_velocity", "x_a"));
  const std::string longest(63, 'a');
  EXPECT_THAT(MatlabNames({longest, longest + "b"}),
              ElementsAre(longest, std::string(61, 'a') + "_2"));
}

}  // namespace
}  // namespace contact::cli
