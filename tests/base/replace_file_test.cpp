#include "base/replace_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <string>

#include "testing/temp_directory.h"

namespace contact {
namespace {

namespace fs = std::filesystem;

std::string TextOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class ReplaceFileTest : public testing::Test {
 protected:
  fs::path file() const { return directory_.path() / "file"; }
  fs::path draft() const { return directory_.path() / "file.new"; }

  TempDirectory directory_;
};

TEST_F(ReplaceFileTest, NewContentsTakeThePlaceOfTheOld) {
  ASSERT_FALSE(ReplaceFile(file(), "a longer first text"));
  ASSERT_FALSE(ReplaceFile(file(), "second"));
  EXPECT_EQ(TextOf(file()), "second");
  EXPECT_FALSE(fs::exists(draft()));
}

TEST_F(ReplaceFileTest, OpenReaderKeepsTheOldContents) {
  ASSERT_FALSE(ReplaceFile(file(), "old"));
  std::ifstream reader(file());
  ASSERT_FALSE(ReplaceFile(file(), "new"));
  std::string text;
  reader >> text;
  EXPECT_EQ(text, "old");
}

TEST_F(ReplaceFileTest, ModeIsThatOfTheNewFile) {
  ASSERT_FALSE(ReplaceFile(file(), "x", 0600));
  struct stat status = {};
  ASSERT_EQ(::stat(file().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
}

TEST_F(ReplaceFileTest, FailureLeavesTheOldFileAndNoDraft) {
  fs::create_directory(file());
  std::ofstream(file() / "inside") << "kept";
  EXPECT_TRUE(ReplaceFile(file(), "text"));  // A folder with contents cannot be replaced.
  EXPECT_EQ(TextOf(file() / "inside"), "kept");
  EXPECT_FALSE(fs::exists(draft()));
}

TEST_F(ReplaceFileTest, MissingFolderIsAnError) {
  const std::error_code error = ReplaceFile(directory_.path() / "none" / "file", "text");
  EXPECT_EQ(error, std::errc::no_such_file_or_directory);
}

TEST_F(ReplaceFileTest, NameWithoutAFolderIsInTheWorkingDirectory) {
  const fs::path before = fs::current_path();
  fs::current_path(directory_.path());
  const std::error_code error = ReplaceFile("file", "text");
  fs::current_path(before);
  EXPECT_FALSE(error) << error.message();
  EXPECT_EQ(TextOf(file()), "text");
}

TEST_F(ReplaceFileTest, DraftOfAnotherWriterIsMovedAndAMissingOneIsAnError) {
  std::ofstream(draft()) << "made elsewhere";
  ASSERT_FALSE(MoveIntoPlace(draft(), file()));
  EXPECT_EQ(TextOf(file()), "made elsewhere");
  EXPECT_EQ(MoveIntoPlace(draft(), file()), std::errc::no_such_file_or_directory);
  EXPECT_EQ(TextOf(file()), "made elsewhere");
}

}  // namespace
}  // namespace contact
