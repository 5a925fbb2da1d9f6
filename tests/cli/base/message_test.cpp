#include "cli/base/message.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>

#include "cli/base/files.h"

namespace contact::cli {
namespace {

// Sends standard output and standard error to one file while it lives.
class OneFile {
 public:
  explicit OneFile(const char* path) {
    std::fflush(stdout);
    std::FILE* const file = std::fopen(path, "wb");
    dup2(fileno(file), STDOUT_FILENO);
    dup2(fileno(file), STDERR_FILENO);
    std::fclose(file);
  }
  ~OneFile() {
    std::fflush(stdout);
    dup2(output_, STDOUT_FILENO);
    dup2(errors_, STDERR_FILENO);
    close(output_);
    close(errors_);
  }
  OneFile(const OneFile&) = delete;
  OneFile& operator=(const OneFile&) = delete;

 private:
  const int output_ = dup(STDOUT_FILENO);
  const int errors_ = dup(STDERR_FILENO);
};

TEST(MessageTest, StandsAfterWhatWasPrintedBefore) {
  const ScratchFolder folder;
  const std::string path = folder.path() / "both";
  {
    const OneFile both(path.c_str());
    fmt::print("a row\n");
    Tell("{} {}\n", "a", "hint");
    fmt::print("a row\n");
  }
  EXPECT_EQ(ReadText(path), "a row\na hint\na row\n");
}

}  // namespace
}  // namespace contact::cli
