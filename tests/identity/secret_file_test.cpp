#include "identity/secret_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "testing/temp_directory.h"

namespace contact {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A file in a folder of its own, and a link to it in another.
class SecretFileTest : public testing::Test {
 protected:
  SecretFileTest() {
    for (const char* name : {"real", "links"}) fs::create_directory(Folder(name));
    std::ofstream(file_) << "text";
    fs::create_symlink(file_, link_);
    Set(file_, 0600);
    Set(Folder("real"), 0700);
    Set(Folder("links"), 0700);
  }
  fs::path Folder(const char* name) const { return directory_.path() / name; }
  static void Set(const fs::path& path, mode_t mode) { ASSERT_EQ(::chmod(path.c_str(), mode), 0); }
  // Why the file is not read through the link; empty: it is read.
  std::string Mistake(bool (*read)(const fs::path&, std::string*, std::string*)) const {
    std::string text, mistake;
    const bool done = read(link_, &text, &mistake);
    EXPECT_EQ(done, mistake.empty());
    return mistake;
  }

  const TempDirectory directory_;
  const fs::path file_ = Folder("real") / "file", link_ = Folder("links") / "link";
};

TEST_F(SecretFileTest, AFileThatOthersMayWriteIsNotTrusted) {
  for (const mode_t mode : {0620U, 0602U, 0666U}) {
    Set(file_, mode);
    EXPECT_THAT(Mistake(ReadTrustedFile), HasSubstr("chmod go-w")) << mode;
    EXPECT_THAT(Mistake(ReadSecretFile), HasSubstr("chmod 600")) << mode;
    EXPECT_EQ(Mistake(ReadTextFile), "") << mode;
  }
}

TEST_F(SecretFileTest, AFileThatOthersMayReplaceIsNotTrusted) {
  for (const char* folder : {"real", "links"}) {
    for (const mode_t mode : {0720U, 0702U}) {
      Set(Folder(folder), mode);
      EXPECT_THAT(Mistake(ReadTrustedFile), HasSubstr("chmod go-w " + Folder(folder).string()));
      EXPECT_THAT(Mistake(ReadSecretFile), HasSubstr("can be replaced by others"));
    }
    Set(Folder(folder), 0700);
  }
}

TEST_F(SecretFileTest, NobodyReplacesTheFilesOfOthersInAStickyFolder) {
  Set(Folder("real"), 01777);
  Set(Folder("links"), 01777);
  EXPECT_EQ(Mistake(ReadSecretFile), "");
}

TEST_F(SecretFileTest, OnlyASecretMustNotBeReadByOthers) {
  Set(file_, 0644);
  EXPECT_EQ(Mistake(ReadTrustedFile), "");
  EXPECT_THAT(Mistake(ReadSecretFile), HasSubstr("chmod 600"));
}

}  // namespace
}  // namespace contact
