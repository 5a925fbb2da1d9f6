#include <gtest/gtest.h>

#include "cli/link/client.h"

namespace contact::cli {
namespace {

constexpr char kPackaged[] = "unix:/run/contactd/contactd.sock";

TEST(ServerAdvice, RightToThePackagedSocketComesWithItsGroup) {
  EXPECT_EQ(ServerAdvice(kPackaged, "UNKNOWN: unix:/x: Permission denied"),
            "sudo adduser \"$USER\" contact, then log in again");
}

TEST(ServerAdvice, PackagedServerThatDoesNotRunIsStarted) {
  for (const char* words : {"connection refused", "unix:/x: No such file or directory"}) {
    EXPECT_EQ(ServerAdvice(kPackaged, words), "sudo systemctl start contactd");
  }
}

TEST(ServerAdvice, NameWithoutAddressIsNoServerToStartHere) {
  for (const char* words :
       {"DNS resolution failed for nohost:7070: C-ares status is not ARES_SUCCESS: Domain name not "
        "found",
        "cannot reach contactd at nohost:7070 (nobody knows an address of this name)"}) {
    EXPECT_EQ(ServerAdvice("nohost:7070", words), "look for a misprint; getent hosts nohost");
  }
  EXPECT_EQ(TransportWords("DNS resolution failed"), "nobody knows an address of this name");
}

TEST(ServerAdvice, ServerOfAnotherMachineMayListenThereOnly) {
  for (const char* words : {"connection refused", "no connection in time"}) {
    EXPECT_NE(ServerAdvice("lab.example:7070", words).find("7070:127.0.0.1:7070 lab.example"),
              std::string::npos);
    for (const char* here : {"localhost:7070", "127.0.0.2:1", "[::1]:7070"}) {
      EXPECT_EQ(ServerAdvice(here, words), "");
    }
  }
}

TEST(ServerAdvice, NobodyKnowsWhoStartsAnotherServer) {
  EXPECT_EQ(ServerAdvice("unix:/tmp/x", "No such file or directory"), "");
  EXPECT_NE(ServerAdvice("unix:/tmp/x", "Permission denied"), "");
  EXPECT_EQ(ServerAdvice("127.0.0.1:7070", "Permission denied"), "");
}

}  // namespace
}  // namespace contact::cli
