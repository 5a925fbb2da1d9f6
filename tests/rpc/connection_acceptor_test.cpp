#include "rpc/connection_acceptor.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <list>
#include <memory>
#include <vector>

#include "client_socket.h"
#include "rpc/tcp_listener.h"
#include "test_server.h"

namespace contact {
namespace {

using namespace std::chrono_literals;

// What a connection is kept for to see that it is not refused.
constexpr auto kAWhile = 50ms;

TEST(TcpListenerTest, PortZeroIsOnePortForAllAddresses) {
  for (const char* address : {"127.0.0.1:0", "[::1]:0", "localhost:0"}) {
    const TcpListener listener = OpenTcpListener(address);
    EXPECT_FALSE(listener.sockets.empty()) << address;
    EXPECT_GT(listener.port, 0) << address;
  }
}

TEST(TcpListenerTest, TakenPortAndUnknownHostGiveNothing) {
  const TcpListener first = OpenTcpListener("127.0.0.1:0");
  const std::string port = std::to_string(first.port);
  EXPECT_TRUE(OpenTcpListener("127.0.0.1:" + port).sockets.empty());
  EXPECT_TRUE(OpenTcpListener("localhost:" + port).sockets.empty());
  EXPECT_TRUE(OpenTcpListener("256.0.0.1:0").sockets.empty());
  EXPECT_TRUE(OpenTcpListener("nowhere").sockets.empty());
}

// Keeps the connections instead of gRPC.
class ConnectionAcceptorTest : public testing::Test {
 protected:
  void Open(ConnectionLimits limits) {
    TcpListener listener = OpenTcpListener("127.0.0.1:0");
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
