#include "base/memory_limit.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "testing/temp_directory.h"

namespace contact {
namespace {

namespace fs = std::filesystem;

class MemoryLimitTest : public testing::Test {
 protected:
  void Write(const fs::path& file, const std::string& text) const {
    const fs::path path = directory_.path() / file;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text << '\n';
  }
  std::int64_t Limit(const std::string& groups) const {
    Write("groups", groups);
    return MemoryLimit(directory_.path() / "groups", directory_.path() / "root");
  }

  const TempDirectory directory_;
};

TEST_F(MemoryLimitTest, WithoutGroupsItIsThatOfTheMachine) {
  const std::int64_t machine = MemoryLimit("/nonexistent", "/nonexistent");
  EXPECT_GT(machine, 64 << 20);
  EXPECT_LE(MemoryLimit(), machine);
}

TEST_F(MemoryLimitTest, TheLeastOfAGroupAndThoseAboveItCounts) {
  Write("root/a/memory.max", "70000000");
  Write("root/a/b/memory.max", "max");
  EXPECT_EQ(Limit("0::/a/b"), 70'000'000);
  Write("root/a/b/memory.max", "60000000");
  EXPECT_EQ(Limit("0::/a/b"), 60'000'000);
}

TEST_F(MemoryLimitTest, TheFirstVersionOfGroupsHasAFolderForEachController) {
  Write("root/memory/a/memory.limit_in_bytes", "50000000");
  EXPECT_EQ(Limit("5:cpu,memory:/a\n1:name=systemd:/x"), 50'000'000);
}

TEST_F(MemoryLimitTest, InAContainerTheRootHasTheLimit) {
  Write("root/memory.max", "40000000");
  EXPECT_EQ(Limit("0::/what/the/host/calls/it"), 40'000'000);
}

}  // namespace
}  // namespace contact
