// The gateway beside native gRPC, in one run: bytes of a stream, time of a unary call, also beside
// streams in JSON, and what clients that take nothing cost. gateway_benchmark --contactd
// build/release/server/contactd
#include <fmt/format.h>
#include <grpcpp/grpcpp.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <future>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/file_descriptor.h"
#include "benchmark/server_process.h"
#include "contact/v1/job_service.grpc.pb.h"

namespace contact {
namespace {

using std::chrono::steady_clock;
using Stub = v1::JobService::Stub;

struct Sizes {
  std::int64_t samples = 400'000;  // 48 MB.
  int streams = 7;
  int calls = 2000;
  int stalled = 500;
};

double SecondsSince(steady_clock::time_point start) {
  return std::chrono::duration<double>(steady_clock::now() - start).count();
}

double Quantile(std::vector<double> values, double part) {
  std::ranges::sort(values);
  return values.at(static_cast<std::size_t>(part * static_cast<double>(values.size() - 1)));
}

void Check(bool good, const std::string& what) {
  if (!good) throw std::runtime_error(what);
}

// A bare HTTP/1.1 client on one connection.
class HttpClient {
 public:
  HttpClient(int port, int receive_buffer = 0) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    if (receive_buffer > 0) {
      setsockopt(socket_.get(), SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof(receive_buffer));
    }
    const int on = 1;
    setsockopt(socket_.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<in_port_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    Check(connect(socket_.get(), reinterpret_cast<sockaddr*>(&address), sizeof(address)) == 0,
          "cannot connect");
  }

  void Post(const std::string& method, const std::string& type, const std::string& body) {
    const std::string request = fmt::format(
        "POST /contact.v1.JobService/{} HTTP/1.1\r\nhost: localhost\r\ncontent-type: {}\r\n"
        "content-length: {}\r\n\r\n{}",
        method, type, body.size(), body);
    Check(send(socket_.get(), request.data(), request.size(), 0) ==
              static_cast<ssize_t>(request.size()),
          "cannot send");
  }

  /// Reads an answer with a length.
  void ReadAnswer() {
    std::string answer;
    std::size_t end = 0;
    while ((end = answer.find("\r\n\r\n")) == std::string::npos) answer += Receive();
    const std::size_t length = answer.find("content-length: ");
    Check(answer.starts_with("HTTP/1.1 200") && length < end, answer);
    const std::size_t size = end + 4 + std::stoul(answer.substr(length + 16));
    while (answer.size() < size) answer += Receive();
  }

  /// Reads a chunked answer to its end; its bytes, those of HTTP included.
  std::int64_t ReadStream() {
    constexpr std::string_view kEnd = "\r\n0\r\n\r\n";
    std::int64_t bytes = 0;
    std::string tail;
    while (!tail.ends_with(kEnd)) {
      const std::string_view part = Receive();
      bytes += static_cast<std::int64_t>(part.size());
      tail += part.substr(part.size() - std::min(part.size(), kEnd.size()));
      tail.erase(0, tail.size() - std::min(tail.size(), kEnd.size()));
    }
    return bytes;
  }

  /// Reads one byte.
  void ReadLittle() const {
    char byte = 0;
    Check(recv(socket_.get(), &byte, 1, 0) == 1, "the stream ended");
  }

 private:
  std::string_view Receive() {
    const ssize_t size = recv(socket_.get(), buffer_.data(), buffer_.size(), 0);
    Check(size > 0, "the connection ended");
    return {buffer_.data(), static_cast<std::size_t>(size)};
  }

  FileDescriptor socket_;
  std::vector<char> buffer_ = std::vector<char>(256 << 10);
};

std::string Frame(const std::string& message) {
  Check(message.size() < 256, "long message");
  return std::string("\0\0\0\0", 4) + static_cast<char>(message.size()) + message;
}

// Bodies that fly apart, `samples` rows of 120 bytes; its name once it has ended.
std::string RunFlight(Stub& stub, std::int64_t samples) {
  v1::CreateJobRequest request;
  v1::Scenario& scenario = *request.mutable_job()->mutable_scenario();
  scenario.set_end_time_s(1);
  for (int i = 0; i < 3; ++i) {
    v1::Body& body = *scenario.add_bodies();
    body.set_name(fmt::format("B{}", i));
    body.set_mass_kg(1);
    body.set_radius_m(0.05);
    body.set_position_m(i);
    body.set_velocity_m_per_s(i);
  }
  scenario.mutable_output()->set_sample_interval_s(1.0 / static_cast<double>(samples));
  v1::Job job;
  grpc::ClientContext context;
  const grpc::Status status = stub.CreateJob(&context, request, &job);
  Check(status.ok(), status.error_message());
  grpc::ClientContext watching;
  v1::WatchJobRequest watch;
  watch.set_name(job.name());
  watch.add_kinds("state_changed");
  const auto reader = stub.WatchJob(&watching, watch);
  v1::WatchJobResponse response;
  while (reader->Read(&response)) {
  }
  Check(reader->Finish().ok(), "the watch failed");
  return job.name();
}

v1::WatchJobRequest WatchOf(const std::string& name) {
  v1::WatchJobRequest request;
  request.set_name(name);
  return request;
}

// MB/s of a stream of gRPC.
double NativeStream(Stub& stub, const std::string& name) {
  const auto start = steady_clock::now();
  grpc::ClientContext context;
  const auto reader = stub.WatchJob(&context, WatchOf(name));
  v1::WatchJobResponse response;
  std::size_t bytes = 0;
  while (reader->Read(&response)) bytes += response.ByteSizeLong();
  Check(reader->Finish().ok(), "the watch failed");
  return static_cast<double>(bytes) / 1e6 / SecondsSince(start);
}

// MB/s of the same stream by HTTP.
double HttpStream(int port, const std::string& name, const std::string& type) {
  HttpClient client(port);
  const auto start = steady_clock::now();
  const bool json = type.ends_with("json");
  client.Post("WatchJob", type,
              Frame(json ? "{\"name\":\"" + name + "\"}" : WatchOf(name).SerializeAsString()));
  const std::int64_t bytes = client.ReadStream();
  return static_cast<double>(bytes) / 1e6 / SecondsSince(start);
}

void Streams(Stub& stub, int port, const std::string& name, const Sizes& sizes) {
  std::vector<double> native, binary, web, json;
  for (int i = 0; i < sizes.streams; ++i) {
    native.push_back(NativeStream(stub, name));
    binary.push_back(HttpStream(port, name, "application/connect+proto"));
    web.push_back(HttpStream(port, name, "application/grpc-web+proto"));
    json.push_back(HttpStream(port, name, "application/connect+json"));
  }
  const double beside = Quantile(native, 0.5);
  fmt::print(
      "stream, median MB/s: gRPC {:.0f}, Connect bytes {:.0f} ({:.0f} %), gRPC-Web {:.0f}, "
      "Connect JSON {:.1f}\n",
      beside, Quantile(binary, 0.5), 100 * Quantile(binary, 0.5) / beside, Quantile(web, 0.5),
      Quantile(json, 0.5));
}

// A unary call, as each client makes it.
struct UnaryCall {
  std::string method;
  std::string bytes;
  std::string json;
  std::function<grpc::Status(Stub&, grpc::ClientContext&)> native;
};

UnaryCall GetJob(const std::string& name) {
  v1::GetJobRequest request;
  request.set_name(name);
  return {"GetJob", request.SerializeAsString(), "{\"name\":\"" + name + "\"}",
          [request](Stub& stub, grpc::ClientContext& context) {
            v1::Job job;
            return stub.GetJob(&context, request, &job);
          }};
}

UnaryCall GetServerInfo() {
  return {"GetServerInfo", "", "{}", [](Stub& stub, grpc::ClientContext& context) {
            v1::ServerInfo info;
            return stub.GetServerInfo(&context, {}, &info);
          }};
}

// Adds the times of so many calls, in ms.
void NativeCalls(Stub& stub, const UnaryCall& call, int calls, std::vector<double>* times) {
  for (int i = 0; i < calls; ++i) {
    const auto start = steady_clock::now();
    grpc::ClientContext context;
    Check(call.native(stub, context).ok(), call.method + " failed");
    times->push_back(1e3 * SecondsSince(start));
  }
}

void HttpCalls(int port, const UnaryCall& call, bool json, int calls, std::vector<double>* times) {
  HttpClient client(port);
  for (int i = 0; i < calls; ++i) {
    const auto start = steady_clock::now();
    client.Post(call.method, json ? "application/json" : "application/proto",
                json ? call.json : call.bytes);
    client.ReadAnswer();
    times->push_back(1e3 * SecondsSince(start));
  }
}

void Calls(Stub& stub, int port, const UnaryCall& call, const Sizes& sizes) {
  std::vector<double> native, json, bytes;
  constexpr int kRounds = 10;  // So that all meet the same machine.
  for (int i = 0; i < kRounds; ++i) {
    NativeCalls(stub, call, sizes.calls / kRounds, &native);
    HttpCalls(port, call, true, sizes.calls / kRounds, &json);
    HttpCalls(port, call, false, sizes.calls / kRounds, &bytes);
  }
  fmt::print(
      "{}, p50 / p99 ms: gRPC {:.3f} / {:.3f}, Connect JSON {:.3f} / {:.3f} ({:.2f} x), Connect "
      "bytes {:.3f} / {:.3f}\n",
      call.method, Quantile(native, 0.5), Quantile(native, 0.99), Quantile(json, 0.5),
      Quantile(json, 0.99), Quantile(json, 0.5) / Quantile(native, 0.5), Quantile(bytes, 0.5),
      Quantile(bytes, 0.99));
}

// Calls beside two clients that read the stream in JSON again and again.
void BesideJson(int port, const std::string& name, const Sizes& sizes) {
  std::atomic<bool> stop = false;
  const auto read = [&] {
    while (!stop) HttpStream(port, name, "application/connect+json");
  };
  auto one = std::async(std::launch::async, read);
  auto other = std::async(std::launch::async, read);
  std::vector<double> times;
  constexpr int kRounds = 10;  // On connections of their own, so that all threads are met.
  for (int i = 0; i < kRounds; ++i) {
    HttpCalls(port, GetJob(name), true, sizes.calls / kRounds, &times);
  }
  stop = true;
  one.get();
  other.get();
  fmt::print("GetJob beside two streams in JSON, p50 / p99 ms: {:.3f} / {:.3f}\n",
             Quantile(times, 0.5), Quantile(times, 0.99));
}

void Stalled(const ServerProcess& server, int port, const std::string& name, const Sizes& sizes) {
  const double before = server.ResidentMegabytes();
  std::vector<HttpClient> clients;
  for (int i = 0; i < sizes.stalled; ++i) {
    clients.emplace_back(port, 4096);
    clients.back().Post("WatchJob", "application/connect+proto",
                        Frame(WatchOf(name).SerializeAsString()));
  }
  for (const HttpClient& client : clients) client.ReadLittle();
  std::vector<double> times;
  HttpCalls(port, GetJob(name), true, sizes.calls, &times);
  fmt::print(
      "{} clients that take nothing: {:.0f} MB; GetJob beside them, p50 / p99 ms: {:.3f} / "
      "{:.3f}\n",
      sizes.stalled, server.ResidentMegabytes() - before, Quantile(times, 0.5),
      Quantile(times, 0.99));
}

int RunAll(const std::string& contactd, const Sizes& sizes) {
  const ServerProcess server({contactd, "--log-level=off", "--http-listen=127.0.0.1:0",
                              "--max-watchers=2000", "--max-watchers-per-peer=2000"});
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);
  const auto stub = v1::JobService::NewStub(
      grpc::CreateCustomChannel(server.address(), grpc::InsecureChannelCredentials(), arguments));
  v1::ServerInfo info;
  grpc::ClientContext context;
  Check(stub->GetServerInfo(&context, {}, &info).ok(), "GetServerInfo failed");
  const std::string& http = info.http_address();
  const int port = std::stoi(http.substr(http.rfind(':') + 1));
  const std::string name = RunFlight(*stub, sizes.samples);
  Streams(*stub, port, name, sizes);
  Calls(*stub, port, GetServerInfo(), sizes);
  Calls(*stub, port, GetJob(name), sizes);
  BesideJson(port, name, sizes);
  Stalled(server, port, name, sizes);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace contact

int main(int argc, char** argv) {
  CLI::App app("Measures the gateway beside native gRPC.");
  std::string contactd;
  bool tiny = false;
  app.add_option("--contactd", contactd, "The server's binary")->required();
  app.add_flag("--tiny", tiny, "Only show that it runs");
  CLI11_PARSE(app, argc, argv);
  try {
    const contact::Sizes few{.samples = 2000, .streams = 1, .calls = 10, .stalled = 5};
    return contact::RunAll(contactd, tiny ? few : contact::Sizes());
  } catch (const std::exception& error) {
    fmt::print(stderr, "gateway_benchmark: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
