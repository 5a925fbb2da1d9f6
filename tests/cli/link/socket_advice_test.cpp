#include <gtest/gtest.h>

#include "cli/link/client.h"

namespace contact::cli {
namespace {

constexpr char kPackaged[] = "unix:/run/contactd/contactd.sock";

TEST(SocketAdvice, RightToThePackagedSocketComesWithItsGroup) {
  EXPECT_EQ(SocketAdvice(kPackaged, "UNKNOWN: unix:/x: Permission denied"),
            "sudo adduser \"$USER\" contact, then log in again");
}

TEST(SocketAdvice, PackagedServerThatDoesNotRunIsStarted) {
  for (const char* words : {"connection refused", "unix:/x: No such file or directory"}) {
    EXPECT_EQ(SocketAdvice(kPackaged, words), "sudo systemctl start contactd");
  }
}

TEST(SocketAdvice, NobodyKnowsWhoStartsAnotherServer) {
  EXPECT_EQ(SocketAdvice("unix:/tmp/x", "No such file or directory"), "");
  EXPECT_NE(SocketAdvice("unix:/tmp/x", "Permission denied"), "");
  EXPECT_EQ(SocketAdvice("127.0.0.1:7070", "Permission denied"), "");
}

}  // namespace
}  // namespace contact::cli
