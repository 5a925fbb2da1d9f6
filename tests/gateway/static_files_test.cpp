#include "gateway/protocol/static_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "testing/temp_directory.h"

namespace contact::gateway {
namespace {

using testing::Contains;
using testing::Key;
using testing::Not;
using testing::Pair;

class StaticFilesTest : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(web_ / "assets");
    Write(folder_.path() / "secret.txt", "secret");
    Write(web_ / "index.html", "page");
    Write(web_ / "assets/a-1.js", "script");
    Write(web_ / "assets/a-1.js.br", "BR");
    Write(web_ / "assets/a-1.js.gz", "GZ");
    Write(web_ / ".hidden.txt", "hidden");
    std::filesystem::create_symlink("../secret.txt", web_ / "link.txt");
    std::filesystem::create_directory_symlink("..", web_ / "up");
  }

  static void Write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path) << text;
  }
  HttpAnswer Get(const std::string& target, Headers headers = {}) {
    const HttpRequest request{.target = target, .headers = std::move(headers)};
    return StaticFiles(web_, "none").Get(DashboardFile(request.path()), request);
  }

  TempDirectory folder_;
  const std::filesystem::path web_ = folder_.path() / "web";
};

TEST_F(StaticFilesTest, FilesHaveTypeAndTag) {
  const HttpAnswer answer = Get("/assets/a-1.js?x=1");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.body, "script");
  EXPECT_THAT(answer.headers, Contains(Pair("content-type", "text/javascript; charset=utf-8")));
  EXPECT_THAT(answer.headers, Contains(Key("etag")));
  EXPECT_THAT(answer.headers,
              Contains(Pair("cache-control", "public, max-age=31536000, immutable")));
  EXPECT_THAT(Get("/").headers, Contains(Pair("cache-control", "no-cache")));
}

TEST_F(StaticFilesTest, PathsWithoutAPointAreThePage) {
  for (const char* path : {"/", "/runs", "/runs/jobs%2Fabc", "/runs/a?b=c.d"}) {
    EXPECT_EQ(Get(path).body, "page") << path;
  }
  EXPECT_EQ(Get("/missing.js").status, 404);
}

TEST_F(StaticFilesTest, NothingOutsideTheDirectoryIsRead) {
  for (const char* path :
       {"/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "/assets/../../secret.txt",
        "/link.txt", "/up/secret.txt", "/.hidden.txt", "//etc/passwd.x", "/a%00.txt", "/%zz.txt",
        "/..\\secret.txt", "http://localhost/secret.txt", "/assets/.."}) {
    const HttpAnswer answer = Get(path);
    EXPECT_NE(answer.body, "secret") << path;
    EXPECT_EQ(answer.status, 404) << path;
  }
}

TEST_F(StaticFilesTest, CompressedFilesGoToWhoTakesThem) {
  EXPECT_EQ(Get("/assets/a-1.js", {{"accept-encoding", "gzip, deflate, br"}}).body, "BR");
  const HttpAnswer gzip = Get("/assets/a-1.js", {{"accept-encoding", "gzip;q=0.5, br;q=0"}});
  EXPECT_EQ(gzip.body, "GZ");
  EXPECT_THAT(gzip.headers, Contains(Pair("content-encoding", "gzip")));
  EXPECT_THAT(gzip.headers, Contains(Pair("content-type", "text/javascript; charset=utf-8")));
  const HttpAnswer plain = Get("/assets/a-1.js", {{"accept-encoding", "identity"}});
  EXPECT_EQ(plain.body, "script");
  EXPECT_THAT(plain.headers, Not(Contains(Key("content-encoding"))));
}

TEST_F(StaticFilesTest, AFileThatTheClientHasIsNotSentAgain) {
  const HttpAnswer first = Get("/");
  const auto tag = std::ranges::find(first.headers, "etag", &Headers::value_type::first);
  const HttpAnswer second = Get("/", {{"if-none-match", tag->second}});
  EXPECT_EQ(second.status, 304);
  EXPECT_EQ(second.body, "");
  EXPECT_EQ(Get("/", {{"if-none-match", "\"other\""}}).status, 200);
}

TEST_F(StaticFilesTest, AFolderOfTheDocumentationIsItsIndex) {
  EXPECT_EQ(DocsFile("/"), "/index.html");
  EXPECT_EQ(DocsFile("/gallery/"), "/gallery/index.html");
  EXPECT_EQ(DocsFile("/gallery/chain.yaml"), "/gallery/chain.yaml");
  EXPECT_EQ(StaticFiles(web_, "").Get(DocsFile("/assets"), {}).status, 404);
}

TEST_F(StaticFilesTest, WithoutADirectoryAPersonIsToldWhy) {
  const HttpAnswer answer = StaticFiles("", "see --web-dir").Get("/index.html", {});
  EXPECT_EQ(answer.status, 404);
  EXPECT_THAT(answer.body, testing::HasSubstr("--web-dir"));
}

}  // namespace
}  // namespace contact::gateway
