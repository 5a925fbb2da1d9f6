#include "storage/sqlite/data_directory.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "testing/temp_directory.h"

namespace contact {
namespace {

namespace fs = std::filesystem;

class DataDirectoryTest : public testing::Test {
 protected:
  fs::path path() const { return folder_.path() / "data"; }

  std::set<std::string> Files() const {
    std::set<std::string> files;
    for (const auto& entry : fs::directory_iterator(path())) files.insert(entry.path().filename());
    return files;
  }

  TempDirectory folder_;
};

TEST_F(DataDirectoryTest, NewFolderIsItsOwnersAlone) {
  ASSERT_TRUE(DataDirectory::Open(path()).ok());
  EXPECT_EQ(fs::status(path()).permissions(), fs::perms::owner_all);
}

TEST_F(DataDirectoryTest, FolderThatOthersMayWriteIsRefused) {
  fs::create_directory(path());
  for (const auto others : {fs::perms::group_write, fs::perms::others_write}) {
    fs::permissions(path(), fs::perms::owner_all | others);
    const absl::Status refused = DataDirectory::Open(path()).status();
    EXPECT_TRUE(absl::IsFailedPrecondition(refused)) << refused;
    EXPECT_NE(refused.message().find("chmod go-w"), std::string::npos) << refused;
  }
}

TEST_F(DataDirectoryTest, LinksAreNotFollowed) {
  const fs::path victim = folder_.path() / "victim";
  std::ofstream(victim) << "mine";
  ASSERT_TRUE(DataDirectory::Open(path()).ok());
  for (const char* file : {"lock", "initialised.new"}) {
    fs::remove(path() / file);
    fs::create_symlink(victim, path() / file);
    const auto directory = DataDirectory::Open(path());
    if (directory.ok()) {
      EXPECT_TRUE(directory->MarkInitialised().ok());
    }
    EXPECT_EQ(directory.ok(), std::string(file) != "lock");
    std::string content;
    EXPECT_TRUE(std::ifstream(victim) >> content);
    EXPECT_EQ(content, "mine");
    fs::remove(path() / file);
  }
}

TEST_F(DataDirectoryTest, PermissionsOfAFolderThatWasThereStay) {
  const auto shared = fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec;
  fs::create_directory(path());
  fs::permissions(path(), shared);
  ASSERT_TRUE(DataDirectory::Open(path()).ok());
  EXPECT_EQ(fs::status(path()).permissions(), shared);
}

TEST_F(DataDirectoryTest, WriterKeepsEverybodyOutUntilItEnds) {
  {
    const auto writer = DataDirectory::Open(path());
    ASSERT_TRUE(writer.ok()) << writer.status();
    EXPECT_TRUE(absl::IsUnavailable(DataDirectory::Open(path()).status()));
    EXPECT_TRUE(absl::IsUnavailable(DataDirectory::OpenToRead(path()).status()));
  }
  EXPECT_TRUE(DataDirectory::OpenToRead(path()).ok());
  EXPECT_TRUE(DataDirectory::Open(path()).ok());
}

TEST_F(DataDirectoryTest, ReadersShareAndKeepWritersOut) {
  ASSERT_TRUE(DataDirectory::Open(path()).ok());
  {
    const auto first = DataDirectory::OpenToRead(path());
    const auto second = DataDirectory::OpenToRead(path());
    ASSERT_TRUE(first.ok() && second.ok()) << first.status() << second.status();
    EXPECT_TRUE(absl::IsUnavailable(DataDirectory::Open(path()).status()));
  }
  EXPECT_TRUE(DataDirectory::Open(path()).ok());
}

TEST_F(DataDirectoryTest, ReaderMakesNothing) {
  EXPECT_TRUE(absl::IsNotFound(DataDirectory::OpenToRead(path()).status()));
  EXPECT_FALSE(fs::exists(path()));
  fs::create_directory(path());
  std::ofstream(path() / "contactd.db") << "a restored backup";
  EXPECT_TRUE(DataDirectory::OpenToRead(path()).ok());
  EXPECT_EQ(Files(), (std::set<std::string>{"contactd.db"}));
}

TEST_F(DataDirectoryTest, MarkSurvivesAndLeavesNoDraft) {
  {
    const auto directory = DataDirectory::Open(path());
    ASSERT_TRUE(directory.ok());
    EXPECT_FALSE(directory->initialised());
    ASSERT_TRUE(directory->MarkInitialised().ok());
    EXPECT_TRUE(directory->initialised());
  }
  EXPECT_TRUE(DataDirectory::Open(path())->initialised());
  EXPECT_EQ(Files(), (std::set<std::string>{"initialised", "lock"}));
}

TEST_F(DataDirectoryTest, FolderThatCannotBeMadeIsToldWithTheNextStep) {
  std::ofstream(folder_.path() / "file") << "in the way";
  const absl::Status status = DataDirectory::Open(folder_.path() / "file" / "data").status();
  EXPECT_TRUE(absl::IsFailedPrecondition(status)) << status;
  EXPECT_NE(status.message().find("--data-dir"), std::string::npos) << status;
}

}  // namespace
}  // namespace contact
