#include "cli/link/http_get.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <thread>

#include "base/file_descriptor.h"
#include "cli/base/failure.h"

namespace contact::cli {
namespace {

using namespace std::chrono_literals;

// Accepts one connection and gives one answer; with none it is silent until it ends.
class OneAnswer {
 public:
  explicit OneAnswer(const std::string& answer) : listener_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(bind(listener_.get(), reinterpret_cast<sockaddr*>(&address), size), 0);
    EXPECT_EQ(listen(listener_.get(), 1), 0);
    getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&address), &size);
    address_ = "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
    if (!answer.empty()) thread_ = std::thread([this, answer] { Serve(answer); });
  }
  ~OneAnswer() {
    if (thread_.joinable()) thread_.join();
  }
  OneAnswer(const OneAnswer&) = delete;
  OneAnswer& operator=(const OneAnswer&) = delete;

  const std::string& address() const { return address_; }
  const std::string& request() {  ///< What was asked; after the answer.
    thread_.join();
    return request_;
  }

 private:
  void Serve(const std::string& answer) {
    const FileDescriptor connection(accept(listener_.get(), nullptr, nullptr));
    std::array<char, 4096> block{};
    while (request_.find("\r\n\r\n") == std::string::npos) {
      const ssize_t size = read(connection.get(), block.data(), block.size());
      if (size <= 0) return;
      request_.append(block.data(), static_cast<std::size_t>(size));
    }
    EXPECT_EQ(write(connection.get(), answer.data(), answer.size()),
              static_cast<ssize_t>(answer.size()));
  }

  FileDescriptor listener_;
  std::string address_;
  std::string request_;
  std::thread thread_;
};

Failure Refused(const std::string& address, std::chrono::milliseconds timeout) {
  try {
    HttpGet(address, "/metrics", timeout);
  } catch (const Failure& failure) {
    return failure;
  }
  ADD_FAILURE() << address;
  return {ExitCode::kOk, ""};
}

TEST(HttpGet, GivesThePageOfThePath) {
  OneAnswer server("HTTP/1.1 200 OK\r\nContent-Length: 5\r\n\r\na 1\nb");
  EXPECT_EQ(HttpGet(server.address(), "/metrics", 30s), "a 1\nb");
  EXPECT_THAT(server.request(), testing::StartsWith("GET /metrics HTTP/1.1\r\n"));
}

TEST(HttpGet, AnotherStatusIsUnreachableWithItsNumber) {
  OneAnswer server("HTTP/1.1 404 Not Found\r\nContent-Length: 4\r\n\r\nnone");
  const Failure failure = Refused(server.address(), 30s);
  EXPECT_EQ(failure.code(), ExitCode::kUnreachable);
  EXPECT_EQ(failure.what(), "http://" + server.address() + "/metrics: answers with status 404");
}

TEST(HttpGet, NoServerIsUnreachable) {
  EXPECT_EQ(Refused("127.0.0.1:1", 30s).code(), ExitCode::kUnreachable);
}

TEST(HttpGet, AnAnswerThatIsNoHttpIsUnreachable) {
  OneAnswer server("220 mail\r\n\r\n");
  EXPECT_EQ(Refused(server.address(), 30s).code(), ExitCode::kUnreachable);
}

TEST(HttpGet, ASilentServerIsATimeout) {
  OneAnswer server("");
  EXPECT_EQ(Refused(server.address(), 50ms).code(), ExitCode::kTimeout);
}

}  // namespace
}  // namespace contact::cli
