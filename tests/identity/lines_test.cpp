#include "identity/lines.h"

#include <gmock/gmock.h>

#include <vector>

namespace contact {
namespace {

using testing::ElementsAre;

TEST(Lines, HaveNeitherCommentsNorEmptyOnes) {
  std::vector<std::string> read;
  EXPECT_EQ(ReadLines("# about\n\n a b # c\n \t\r\nd",
                      [&](const std::string& line) {
                        read.push_back(line);
                        return "";
                      }),
            "");
  EXPECT_THAT(read, ElementsAre(" a b ", "d"));
}

TEST(Lines, TheFirstMistakeIsToldWithItsLineAndEndsTheReading) {
  int read = 0;
  EXPECT_EQ(ReadLines("# about\na\nb\nc\n",
                      [&](const std::string& line) -> std::string {
                        ++read;
                        return line == "b" ? "is a b" : "";
                      }),
            "line 3: is a b");
  EXPECT_EQ(read, 2);
}

}  // namespace
}  // namespace contact
