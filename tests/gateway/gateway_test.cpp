// The gateway on real sockets, before a server that answers what a test wants.
#include "gateway/gateway.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "base/file_descriptor.h"
#include "contact/v1/job_service.grpc.pb.h"
#include "gateway/protocol/frames.h"
#include "rpc/net/listener.h"
#include "testing/await.h"

namespace contact {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using std::chrono::steady_clock;
using testing::HasSubstr;

// Past the last year that JSON has.
constexpr std::int64_t kNoTime = 253'402'300'800;

// Asks for an answer of 18 MB in JSON, more than sockets hold; its bytes are few enough for gRPC.
constexpr char kLarge[] = R"({"name":"large"})";
// Asks for an answer that waits for the test.
constexpr char kSlow[] = R"({"name":"slow"})";

// A call that lasts until it is cancelled or told to end.
class SlowCall {
 public:
  void Run(const grpc::ServerContext& context) {
    begun_.set_value();
    const auto end = end_.get_future();
    while (!context.IsCancelled() && end.wait_for(1ms) != std::future_status::ready) {
    }
    cancelled_.set_value(context.IsCancelled());
  }
  bool Begins() { return begun_.get_future().wait_for(kPatience) == std::future_status::ready; }
  void End() { end_.set_value(); }
  // False also if it does not end.
  bool IsCancelled() {
    auto ended = cancelled_.get_future();
    return ended.wait_for(kPatience) == std::future_status::ready && ended.get();
  }

 private:
  std::promise<void> begun_, end_;
  std::promise<bool> cancelled_;
};

// Answers with a time that JSON does not have, or with what a name asks for.
class TestService final : public v1::JobService::Service {
 public:
  SlowCall& slow() { return slow_; }

 private:
  grpc::Status GetJob(grpc::ServerContext* context, const v1::GetJobRequest* request,
                      v1::Job* job) override {
    AddMetadata(context);
    if (request->name() == "large") {
      job->set_name(std::string(3'000'000, '\x01'));  // Six times as long in JSON.
    } else if (request->name() == "slow") {
      slow_.Run(*context);
      job->set_name("done");
    } else {
      job->mutable_create_time()->set_seconds(kNoTime);
    }
    return grpc::Status::OK;
  }
  grpc::Status WatchJob(grpc::ServerContext* context, const v1::WatchJobRequest* /*request*/,
                        grpc::ServerWriter<v1::WatchJobResponse>* writer) override {
    AddMetadata(context);
    v1::WatchJobResponse response;
    response.mutable_snapshot()->set_name("jobs/a");
    writer->Write(response);
    response.mutable_snapshot()->mutable_create_time()->set_seconds(kNoTime);
    writer->Write(response);
    return grpc::Status::OK;
  }
  static void AddMetadata(grpc::ServerContext* context) {
    context->AddInitialMetadata("x-head", "1");
    context->AddInitialMetadata("x-head-bin", "\xff");
    context->AddTrailingMetadata("x-tail", "2");
    context->AddTrailingMetadata("x-tail-bin", "\xfe");
  }

  SlowCall slow_;
};

// A client that says what it likes.
class Client {
 public:
  explicit Client(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<in_port_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(socket_.get(), reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
  }

  // False: the other side has closed.
  bool Send(const std::string& text) const {
    return send(socket_.get(), text.data(), text.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(text.size());
  }
  // Says that nothing more comes, but goes on to read.
  void CloseHalf() const { shutdown(socket_.get(), SHUT_WR); }
  // Has the other side told when this goes.
  void ResetAtEnd() const {
    const linger none = {1, 0};
    setsockopt(socket_.get(), SOL_SOCKET, SO_LINGER, &none, sizeof(none));
  }
  // True once something comes, or the other side has closed.
  bool Wait(std::chrono::milliseconds most) const {
    pollfd readable = {socket_.get(), POLLIN, 0};
    return poll(&readable, 1, static_cast<int>(most.count())) > 0;
  }
  // What is there, at most so much; empty: the other side has closed.
  std::string Read(std::size_t most) const {
    std::string part(most, 0);
    if (!Wait(kPatience)) ADD_FAILURE() << "nothing comes";
    const ssize_t size = recv(socket_.get(), part.data(), most, MSG_DONTWAIT);
    part.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    return part;
  }
  // What comes until the other side closes.
  std::string ReadAll() const {
    std::string all;
    for (std::string part; !(part = Read(4096)).empty();) all += part;
    return all;
  }

 private:
  FileDescriptor socket_;
};

std::string PostRequest(const std::string& method, const std::string& type,
                        const std::string& body) {
  return "POST /contact.v1.JobService/" + method +
         " HTTP/1.1\r\nhost: localhost\r\nconnection: close\r\ncontent-type: " + type +
         "\r\ncontent-length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

std::string BodyOf(const std::string& answer) { return answer.substr(answer.find("\r\n\r\n") + 4); }

// The bytes of a chunked body.
std::string Unchunked(const std::string& body) {
  std::string whole;
  for (std::size_t at = 0, size = 0; at < body.size(); at += size + 2) {
    size = std::stoul(body.substr(at), nullptr, 16);
    at = body.find("\r\n", at) + 2;
    whole += body.substr(at, size);
  }
  return whole;
}

class GatewayTest : public testing::Test {
 protected:
  GatewayTest() {
    grpc::ServerBuilder builder;
    builder.RegisterService(&service_);
    server_ = builder.BuildAndStart();
  }

  // A client of a gateway with these options, the first of its connections.
  Client Connect(GatewayOptions options) {
    Listener listener = OpenTcpListener("127.0.0.1:0");
    port_ = listener.port;
    gateway_ = std::make_unique<Gateway>(threads_, std::move(listener),
                                         server_->InProcessChannel({}), std::move(options));
    return Client(port_);
  }
  SlowCall& slow() { return service_.slow(); }
  // Finishes on another thread.
  std::future<void> Finish(std::chrono::milliseconds grace) {
    return std::async(std::launch::async, [this, grace] { gateway_->Finish(grace); });
  }
  std::size_t connections() const { return gateway_->connections(); }
  // Whether others are answered.
  bool Answers() const {
    const Client other(port_);
    other.Send("GET /healthz HTTP/1.1\r\nhost: localhost\r\nconnection: close\r\n\r\n");
    return other.ReadAll().ends_with("\r\n\r\nok\n");
  }

 private:
  TestService service_;
  std::unique_ptr<grpc::Server> server_;
  GatewayThreads threads_;
  std::unique_ptr<Gateway> gateway_;
  int port_ = 0;
};

TEST_F(GatewayTest, AnAnswerWithoutJsonIsAnError) {
  const Client client = Connect({});
  client.Send(PostRequest("GetJob", "application/json", "{}"));
  const std::string answer = client.ReadAll();
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 500 ")) << answer;
  EXPECT_EQ(json::parse(BodyOf(answer))["code"], "internal");
}

TEST_F(GatewayTest, AStreamedMessageWithoutJsonEndsTheStreamWithAnError) {
  const Client client = Connect({});
  client.Send(PostRequest("WatchJob", "application/connect+json", gateway::ToBytes({0, "{}"})));
  const auto frames = gateway::ToFrames(Unchunked(BodyOf(client.ReadAll())));
  ASSERT_TRUE(frames);
  ASSERT_EQ(frames->size(), 2U) << "the message before it, and the end";
  EXPECT_EQ(json::parse(frames->front().payload)["snapshot"]["name"], "jobs/a");
  EXPECT_EQ(frames->back().flags, gateway::kEndOfStream);
  EXPECT_EQ(json::parse(frames->back().payload)["error"]["code"], "internal");
}

TEST_F(GatewayTest, MetadataOfTheServerComeBeforeAndBehindAnAnswer) {
  const Client client = Connect({});
  client.Send(PostRequest("GetJob", "application/proto", ""));
  const std::string answer = client.ReadAll();
  for (const char* line :
       {"x-head: 1", "x-head-bin: /w", "trailer-x-tail: 2", "trailer-x-tail-bin: /g"}) {
    EXPECT_THAT(answer, HasSubstr("\r\n" + std::string(line) + "\r\n"));
  }
}

TEST_F(GatewayTest, MetadataOfTheServerComeBeforeAndBehindAStream) {
  const Client client = Connect({});
  client.Send(PostRequest("WatchJob", "application/connect+proto", gateway::ToBytes({0, ""})));
  const std::string answer = client.ReadAll();
  EXPECT_THAT(answer, HasSubstr("\r\nx-head: 1\r\nx-head-bin: /w\r\n"));
  const auto frames = gateway::ToFrames(Unchunked(BodyOf(answer)));
  ASSERT_TRUE(frames && !frames->empty());
  EXPECT_EQ(json::parse(frames->back().payload)["metadata"],
            json({{"x-tail", {"2"}}, {"x-tail-bin", {"/g"}}}));
}

TEST_F(GatewayTest, MetadataOfTheServerAreHeadersAndTrailersOfTheWeb) {
  const Client client = Connect({});
  client.Send(PostRequest("GetJob", "application/grpc-web", gateway::ToBytes({0, ""})));
  const std::string answer = client.ReadAll();
  EXPECT_THAT(answer, HasSubstr("\r\nx-head: 1\r\nx-head-bin: /w\r\n"));
  const auto frames = gateway::ToFrames(BodyOf(answer));
  ASSERT_TRUE(frames && frames->size() == 2);
  EXPECT_THAT(frames->back().payload, HasSubstr("x-tail: 2\r\nx-tail-bin: /g\r\n"));
}

TEST_F(GatewayTest, AnAnswerThatThereIsNoRoomForIsRefusedAsItsProtocolSays) {
  const Client client = Connect({.memory = 1 << 20});
  client.Send(PostRequest("GetJob", "application/json", kLarge));
  const std::string answer = client.ReadAll();
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 429 ")) << answer;
  EXPECT_EQ(json::parse(BodyOf(answer))["code"], "resource_exhausted");
}

TEST_F(GatewayTest, JsonThatThereIsNoRoomForIsRefusedAsItsProtocolSays) {
  const Client client = Connect({.memory = 4 << 20});
  client.Send(PostRequest("GetJob", "application/grpc-web+json", gateway::ToBytes({0, kLarge})));
  const auto frames = gateway::ToFrames(BodyOf(client.ReadAll()));
  ASSERT_TRUE(frames && frames->size() == 1);
  EXPECT_TRUE(frames->front().payload.starts_with("grpc-status: 8\r\n"));
}

TEST_F(GatewayTest, AUnaryCallIsAnsweredToAClientThatHasClosedItsHalf) {
  const Client client = Connect({});
  client.Send(PostRequest("GetJob", "application/json", kSlow));
  ASSERT_TRUE(slow().Begins());
  client.CloseHalf();
  EXPECT_FALSE(client.Wait(50ms)) << "the call is cancelled";
  slow().End();
  EXPECT_TRUE(client.ReadAll().ends_with(R"({"name":"done"})"));
}

TEST_F(GatewayTest, TheEndWaitsForWhatIsAnswered) {
  const Client client = Connect({});
  client.Send(PostRequest("GetJob", "application/json", kSlow));
  ASSERT_TRUE(slow().Begins());
  const auto finished = Finish(kPatience);
  EXPECT_EQ(finished.wait_for(50ms), std::future_status::timeout);
  slow().End();
  EXPECT_TRUE(client.ReadAll().ends_with(R"({"name":"done"})"));
  EXPECT_EQ(finished.wait_for(kPatience), std::future_status::ready);
}

TEST_F(GatewayTest, TheEndWaitsNoLongerThanItMay) {
  const Client client = Connect({});
  client.Send(PostRequest("GetJob", "application/json", kSlow));
  ASSERT_TRUE(slow().Begins());
  EXPECT_EQ(Finish(1ms).wait_for(kPatience), std::future_status::ready);
}

TEST_F(GatewayTest, ARequestThatComesAfterTheEndHasBegunIsRefused) {
  const Client client = Connect({});
  client.Send("GET /healthz HTTP/1.1\r\nhost: localhost\r\n\r\n");
  ASSERT_TRUE(client.Read(4096).ends_with("ok\n"));
  Finish(0ms).get();
  client.Send(PostRequest("GetJob", "application/json", "{}"));
  const std::string answer = client.ReadAll();
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 503 ")) << answer;
  const json error = json::parse(BodyOf(answer));
  EXPECT_EQ(error["code"], "unavailable");
  EXPECT_EQ(error["details"][0]["debug"]["reason"], "SERVER_DRAINING");
}

TEST_F(GatewayTest, AUnaryCallIsCancelledOnceItsClientTakesNothingMore) {
  {
    const Client client = Connect({});
    client.Send(PostRequest("GetJob", "application/json", kSlow));
    ASSERT_TRUE(slow().Begins());
    client.ResetAtEnd();
  }
  EXPECT_TRUE(slow().IsCancelled());
}

TEST_F(GatewayTest, AnAnswerThatIsTakenDropByDropIsCut) {
  const Client client = Connect({.answer = 100ms});
  client.Send(PostRequest("GetJob", "application/json", kLarge));
  const auto start = steady_clock::now();
  while (connections() > 0 && steady_clock::now() - start < kPatience) {
    client.Read(1);
  }
  EXPECT_LT(steady_clock::now() - start, 10s) << "each drop gives it more time";
}

TEST_F(GatewayTest, AConnectionWithoutARequestIsClosed) {
  EXPECT_EQ(Connect({.handshake = 20ms}).ReadAll(), "");
}

TEST_F(GatewayTest, AConnectionThatIsIdleAfterARequestIsClosed) {
  const Client client = Connect({.idle = 20ms});
  client.Send("GET /healthz HTTP/1.1\r\nhost: localhost\r\n\r\n");
  EXPECT_TRUE(client.ReadAll().ends_with("\r\n\r\nok\n"));
}

TEST_F(GatewayTest, AHeadThatComesDropByDropIsCut) {
  const Client client = Connect({.head = 100ms});
  client.Send("GET /healthz HTTP/1.1\r\nhost: localhost\r\n");
  EXPECT_TRUE(Answers());
  int drops = 0;
  while (!client.Wait(5ms) && client.Send("x: y\r\n")) ++drops;
  EXPECT_GT(drops, 1);
  EXPECT_LT(drops, 1000) << "each drop gives it more time";
}

TEST_F(GatewayTest, ABodyThatComesDropByDropIsCut) {
  const Client client = Connect({.body = 100ms});
  const std::string whole = PostRequest("GetJob", "application/json", std::string(10'000, ' '));
  client.Send(whole.substr(0, whole.find("\r\n\r\n") + 4));
  EXPECT_TRUE(Answers());
  int drops = 0;
  while (!client.Wait(5ms) && client.Send(" ")) ++drops;
  EXPECT_GT(drops, 1);
  EXPECT_LT(drops, 1000) << "each drop gives it more time";
}

}  // namespace
}  // namespace contact
