#include "rpc/net/connection_acceptor.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <list>
#include <memory>
#include <vector>

#include "client_socket.h"
#include "rpc/net/listener.h"
#include "rpc/net/open_connections.h"
#include "test_server.h"
#include "testing/temp_directory.h"

namespace contact {
namespace {

using namespace std::chrono_literals;

// What a connection is kept for to see that it is not refused.
constexpr auto kAWhile = 50ms;

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

// A connection through a file, without a server.
class StalledConnectionTest : public testing::Test {
 protected:
  StalledConnectionTest() {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends.data()) != 0) {
      throw std::runtime_error("no sockets");
    }
    ours_ = FileDescriptor(ends[0]);
    theirs_ = FileDescriptor(ends[1]);
    connections_.Add(ours_.get(), "unix");
  }

  // Sends as much as there is room for.
  void Fill() {
    while (send(ours_.get(), block_.data(), block_.size(), MSG_NOSIGNAL) > 0) {
    }
  }
  void Take() { EXPECT_GT(recv(theirs_.get(), block_.data(), block_.size(), 0), 0); }
  void Look(std::chrono::milliseconds at) { connections_.CutStalled(begin_ + at, 100ms); }
  bool IsCut() { return recv(ours_.get(), block_.data(), 1, 0) == 0; }

  std::vector<char> block_ = std::vector<char>(4096);
  FileDescriptor ours_;
  FileDescriptor theirs_;
  OpenConnections connections_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

TEST_F(StalledConnectionTest, WhoTakesNothingIsCut) {
  Fill();
  Look(0ms);
  Look(99ms);
  EXPECT_FALSE(IsCut());
  Look(100ms);
  EXPECT_TRUE(IsCut());
}

TEST_F(StalledConnectionTest, WhoTakesALittleOrIsSentNothingIsKept) {
  for (int i = 0; i < 10; ++i) Look(i * 90ms);
  Fill();
  for (int i = 10; i < 50; ++i) {
    Look(i * 90ms);
    Take();
  }
  EXPECT_FALSE(IsCut());
}

// Keeps the connections instead of gRPC.
class ConnectionAcceptorTest : public testing::Test {
 protected:
  void Open(ConnectionLimits limits) {
    Listener listener = OpenTcpListener("127.0.0.1:0");
    port_ = listener.port;
    acceptor_ =
        std::make_unique<ConnectionAcceptor>(std::move(listener), limits, [this](int, int fd) {
          const MutexLock lock(mutex_);
          taken_.emplace_back(fd);
        });
  }
  ClientSocket& Connect(const char* from = "127.0.0.1") {
    clients_.emplace_back().Connect(port_, from);
    return clients_.back();
  }
  // Ends a connection as gRPC would; returns the number of its descriptor.
  int Leave() {
    const MutexLock lock(mutex_);
    const int fd = taken_.back().get();
    taken_.pop_back();
    return fd;
  }
  bool IsTaken(const ClientSocket& client) const { return !client.IsClosedByPeer(kAWhile); }

  int port_ = 0;
  std::list<ClientSocket> clients_;
  Mutex mutex_;
  std::vector<FileDescriptor> taken_ ABSL_GUARDED_BY(mutex_);
  std::unique_ptr<ConnectionAcceptor> acceptor_;
};

TEST_F(ConnectionAcceptorTest, LimitInAllHoldsAndWhoLeavesMakesRoom) {
  Open({.in_all = 3, .per_peer = 3});
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(IsTaken(Connect()));
  EXPECT_EQ(acceptor_->open(), 3U);
  EXPECT_EQ(acceptor_->refused(), 0);
  EXPECT_TRUE(Connect().IsClosedByPeer());
  EXPECT_TRUE(Connect("127.0.0.2").IsClosedByPeer());
  EXPECT_EQ(acceptor_->refused(), 2);
  Leave();
  EXPECT_EQ(acceptor_->open(), 2U);
  EXPECT_TRUE(IsTaken(Connect()));
}

TEST_F(ConnectionAcceptorTest, OnePeerCannotTakeAll) {
  Open({.in_all = 3, .per_peer = 2});
  EXPECT_TRUE(IsTaken(Connect()));
  EXPECT_TRUE(IsTaken(Connect()));
  EXPECT_TRUE(Connect().IsClosedByPeer());
  EXPECT_TRUE(IsTaken(Connect("127.0.0.2")));
}

TEST_F(ConnectionAcceptorTest, CutEndsAllConnectionsAndKeepsTheirDescriptors) {
  Open({});
  EXPECT_TRUE(IsTaken(Connect()));
  EXPECT_TRUE(IsTaken(Connect("127.0.0.2")));
  ASSERT_TRUE(Eventually([this] { return acceptor_->open() == 2; }));
  acceptor_->Cut();
  for (const ClientSocket& client : clients_) EXPECT_TRUE(client.IsClosedByPeer());
  EXPECT_EQ(acceptor_->open(), 2U) << "gRPC closes them";
}

TEST_F(ConnectionAcceptorTest, ClosedOneListensNoMore) {
  Open({});
  acceptor_->Close();
  EXPECT_THROW(Connect(), std::runtime_error);
}

TEST_F(ConnectionAcceptorTest, DescriptorNumberUsedAgainIsAnotherConnection) {
  Open({.in_all = 1, .per_peer = 1});
  EXPECT_TRUE(IsTaken(Connect()));
  ASSERT_TRUE(Eventually([this] { return acceptor_->open() == 1; }));
  const FileDescriptor other(dup2(STDERR_FILENO, Leave()));
  EXPECT_EQ(acceptor_->open(), 0U);
}

TEST_F(ConnectionAcceptorTest, AcceptsAgainAfterDescriptorsHadRunOut) {
  Open({});
  std::vector<ClientSocket> clients(5);
  rlimit before = {};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
  rlimit none = before;
  none.rlim_cur = static_cast<rlim_t>(FileDescriptor(dup(STDERR_FILENO)).get());
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
  for (ClientSocket& client : clients) client.Connect(port_);
  EXPECT_TRUE(IsTaken(clients.front())) << "it waits in the system's queue";
  EXPECT_EQ(acceptor_->open(), 0U);
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_TRUE(Eventually([this] { return acceptor_->open() == 5; }));
  EXPECT_EQ(acceptor_->refused(), 0);
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
