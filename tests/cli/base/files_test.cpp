#include "cli/base/files.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "cli/base/failure.h"
#include "testing/temp_directory.h"

namespace contact::cli {
namespace {

namespace fs = std::filesystem;

// The message of the local failure of a call.
template <class Call>
std::string LocalFailure(Call call) {
  try {
    call();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kLocal);
    return failure.what();
  }
  return "no failure";
}

TEST(TextFile, AnyBytesAreReadBackAsTheyWereWritten) {
  const TempDirectory folder;
  const std::string path = folder.path() / "text";
  for (const std::string& text :
       {std::string(), std::string("\0\r\n\xFF", 4), std::string(200'000, 'x')}) {
    WriteText(text, path);
    EXPECT_EQ(ReadText(path), text);
  }
}

TEST(TextFile, WhatCannotBeReadIsALocalFailureWithThePath) {
  EXPECT_EQ(LocalFailure([] { ReadText("/no/such/file"); }),
            "cannot read /no/such/file: No such file or directory");
  EXPECT_THAT(LocalFailure([] { ReadText("/tmp"); }), testing::HasSubstr("Is a directory"));
}

TEST(LinesOf, EachLineHasNoEndAndTheLastNeedsNone) {
  EXPECT_THAT(LinesOf(""), testing::IsEmpty());
  EXPECT_THAT(LinesOf("a\n\n b\r\n"), testing::ElementsAre("a", "", " b\r"));
  EXPECT_EQ(LinesOf("a\nb"), LinesOf("a\nb\n"));
}

TEST(OutputFile, RowsWrittenOneByOneAreAllThere) {
  const TempDirectory folder;
  const std::string path = folder.path() / "rows";
  std::string all;
  OutputFile file(path);
  for (int row = 0; row < 20'000; ++row) {
    const std::string text = std::to_string(row) + "\n";
    std::fwrite(text.data(), 1, text.size(), file.get());
    all += text;
  }
  file.Close();
  EXPECT_EQ(ReadText(path), all);
}

TEST(OutputFile, AFileThatCannotBeMadeIsALocalFailureWithThePath) {
  EXPECT_EQ(LocalFailure([] { OutputFile("/no/such/file"); }),
            "/no/such/file: No such file or directory");
}

TEST(OutputFile, AFullDiskIsNoticed) {
  EXPECT_EQ(LocalFailure([] { WriteText("x", "/dev/full"); }),
            "/dev/full: No space left on device");
}

TEST(ScratchFolder, IsItsOwnAndLeavesNothing) {
  fs::path path;
  {
    const ScratchFolder scratch;
    const ScratchFolder other;
    path = scratch.path();
    EXPECT_NE(path, other.path());
    fs::create_directory(path / "deep");
    std::ofstream(path / "deep" / "file") << "x";
    EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_all);
  }
  EXPECT_FALSE(fs::exists(path));
}

}  // namespace
}  // namespace contact::cli
