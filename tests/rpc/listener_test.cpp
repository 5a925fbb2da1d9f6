#include "rpc/net/listener.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>
#include <string>

#include "rpc/net/connection_limits.h"
#include "testing/temp_directory.h"

namespace contact {
namespace {

TEST(ListenerTest, PortZeroIsOnePortForAllAddresses) {
  for (const char* address : {"127.0.0.1:0", "[::1]:0", "localhost:0"}) {
    const Listener listener = OpenTcpListener(address);
    EXPECT_FALSE(listener.sockets.empty()) << address;
    EXPECT_GT(listener.port, 0) << address;
  }
}

TEST(ListenerTest, TakenPortAndUnknownHostGiveNothing) {
  const Listener first = OpenTcpListener("127.0.0.1:0");
  const std::string port = std::to_string(first.port);
  EXPECT_TRUE(OpenTcpListener("127.0.0.1:" + port).sockets.empty());
  EXPECT_TRUE(OpenTcpListener("localhost:" + port).sockets.empty());
  EXPECT_TRUE(OpenTcpListener("256.0.0.1:0").sockets.empty());
  EXPECT_TRUE(OpenTcpListener("nowhere").sockets.empty());
}

TEST(ListenerTest, FileIsForOneServerAndTakenOverFromADeadOne) {
  const TempDirectory folder;
  const std::string file = folder.path() / "socket";
  {
    const Listener first = OpenFileListener(file);
    ASSERT_EQ(first.sockets.size(), 1U);
    EXPECT_TRUE(OpenFileListener(file).sockets.empty());
  }
  EXPECT_EQ(OpenFileListener(file).sockets.size(), 1U) << "as a killed server has left it";
  EXPECT_TRUE(OpenFileListener(folder.path() / "none" / "socket").sockets.empty());
  EXPECT_TRUE(OpenFileListener(std::string(200, 'x')).sockets.empty());
  const std::string precious = folder.path() / "precious";
  std::ofstream(precious) << "no socket";
  EXPECT_TRUE(OpenFileListener(precious).sockets.empty());
  EXPECT_TRUE(std::filesystem::exists(precious));
}

TEST(FitToDescriptorsTest, LeavesRoomForOtherFiles) {
  rlimit before = {};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_EQ(FitToDescriptors({.in_all = 50, .per_peer = 40}).in_all, 50);
  const int most = static_cast<int>(before.rlim_max) - 100;
  const ConnectionLimits fitted = FitToDescriptors({.in_all = most + 1, .per_peer = most + 1});
  EXPECT_EQ(fitted.in_all, most);
  EXPECT_EQ(fitted.per_peer, most);
  setrlimit(RLIMIT_NOFILE, &before);
}

}  // namespace
}  // namespace contact
