#include "self_probe.h"

#include <gtest/gtest.h>

#include "gateway/gateway.h"
#include "rpc/net/listener.h"
#include "test_server.h"

namespace contact {
namespace {

using namespace std::chrono_literals;

TEST(SelfProbe, ServerThatServesAnswersUntilItDrains) {
  TestServer server;
  GatewayThreads threads;
  Listener listener = OpenTcpListener("127.0.0.1:0");
  const int port = listener.port;
  const Gateway gateway(threads, std::move(listener), server.grpc().Inside(), {});
  const SelfProbe outside("127.0.0.1:0", port, false), any("0.0.0.0:0", port, false),
      inside(server.grpc().Inside());
  for (const SelfProbe* probe : {&outside, &any, &inside}) EXPECT_TRUE(probe->Answers(10s));
  server.grpc().Drain();
  for (const SelfProbe* probe : {&outside, &any, &inside}) EXPECT_FALSE(probe->Answers(10s));
}

TEST(SelfProbe, ConnectionsThatNobodyTakesAreNoAnswer) {
  const Listener silent = OpenTcpListener("127.0.0.1:0");  // The system's backlog takes them.
  ASSERT_FALSE(silent.sockets.empty());
  EXPECT_FALSE(SelfProbe("127.0.0.1:0", silent.port, false).Answers(50ms));
  EXPECT_FALSE(SelfProbe("127.0.0.1:0", silent.port, true).Answers(50ms));
}

}  // namespace
}  // namespace contact
