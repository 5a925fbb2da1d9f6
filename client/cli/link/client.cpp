#include "cli/link/client.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <thread>
#include <utility>

#include "cli/link/printable_answers.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace contact::cli {
namespace {

using namespace std::chrono_literals;

constexpr int kTries = 3;
constexpr auto kFirstPause = 100ms;
constexpr int kMaxAnswerBytes = 256 << 20;  // A ledger has no limit but this.

ExitCode Code(grpc::StatusCode code, const std::string& reason) {
  switch (code) {
    case grpc::StatusCode::UNAVAILABLE:
      return ExitCode::kUnreachable;
    case grpc::StatusCode::DEADLINE_EXCEEDED:
      return ExitCode::kTimeout;
    case grpc::StatusCode::NOT_FOUND:
      return ExitCode::kNotFound;
    case grpc::StatusCode::INVALID_ARGUMENT:
      return reason == "SCENARIO_INVALID" ? ExitCode::kInvalidScenario : ExitCode::kUsage;
    case grpc::StatusCode::RESOURCE_EXHAUSTED:
      return ExitCode::kOverload;
    case grpc::StatusCode::UNAUTHENTICATED:
    case grpc::StatusCode::PERMISSION_DENIED:
      return ExitCode::kAuth;
    default:
      return ExitCode::kRunFailed;
  }
}

google::rpc::Status Details(const grpc::Status& status) {
  google::rpc::Status details;
  if (!details.ParseFromString(status.error_details())) details.Clear();
  return details;
}

template <class Detail>
Detail Find(const google::rpc::Status& status) {
  Detail detail;
  for (const auto& any : status.details()) {
    if (any.UnpackTo(&detail)) return detail;
  }
  return Detail();
}

bool Contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

// True if something else than gRPC has answered, such as a server of web pages.
bool IsOtherProtocol(std::string_view message) {
  return Contains(message, "parsing HTTP/2") || Contains(message, "http1.x");
}

constexpr std::string_view kUnknownName = "nobody knows an address of this name";

// True if gRPC, or a message of ours, says that the name of the host has no address.
bool IsUnknownName(std::string_view message) {
  return Contains(message, "C-ares") || Contains(message, "DNS resolution") ||
         Contains(message, kUnknownName);
}

// What helps a user who cannot reach a server of the network; empty for one of this machine.
std::string HostAdvice(const std::string& server, std::string_view words) {
  const std::string host = server.substr(0, server.rfind(':'));
  if (IsUnknownName(words)) return fmt::format("look for a misprint; getent hosts {}", host);
  if (host.starts_with("127.") || host == "localhost" || host == "[::1]") return "";
  return fmt::format(
      "see whether contactd runs there; one that listens on its loopback only is at\n"
      "                   127.0.0.1:7070 here with ssh -N -L 7070:127.0.0.1:7070 {}",
      host);
}

// A line that says how to have a server at this address; empty where something else is.
std::string HelpAt(const std::string& server, const std::string& message) {
  if (IsOtherProtocol(message)) return "";
  const std::string advice = ServerAdvice(server, message);
  if (!advice.empty()) return fmt::format("  what helps:      {}\n", advice);
  return fmt::format("  start one here:  contactd --listen {} --data-dir DIR\n", server);
}

std::string Unreachable(const grpc::Status& status, const std::string& server) {
  const std::string& message = status.error_message();
  const std::string here = HelpAt(server, message);
  return fmt::format(
      "cannot reach contactd at {} ({})\n"
      "{}  {}contactctl --server HOST:PORT …, CONTACT_SERVER, contactctl config use PROFILE",
      server, TransportWords(message), here,
      here.empty() ? "choose another:  " : "or choose one:   ");
}

std::string Words(const grpc::Status& status, const std::string& reason,
                  const std::string& server) {
  if (status.error_code() == grpc::StatusCode::UNAVAILABLE && reason.empty()) {
    return Unreachable(status, server);
  }
  if (status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED) {
    return fmt::format("{} did not answer in time; --timeout gives it longer", server);
  }
  std::string words = status.error_message();
  if (!reason.empty()) words += fmt::format(" ({})", reason);
  if (reason == "EVENTS_COMPACTED") {
    words += "\n  the rest:  contactctl describe JOB, contactctl watch JOB --kinds cycle,iteration";
  }
  if (reason == "UNAUTHENTICATED") {
    words +=
        "\n  say who you are:  --token-file FILE, or --cert FILE --key FILE, with --tls-ca FILE";
  }
  return words.empty()
             ? fmt::format("the server failed with code {}", static_cast<int>(status.error_code()))
             : words;
}

// The server sends paths from the job and appends the hint; the scenario is the file here.
Violation FromServer(const google::rpc::BadRequest::FieldViolation& violation) {
  std::string_view field = violation.field();
  for (const std::string_view prefix : {"job.", "scenario.", "sweep."}) {
    if (field.starts_with(prefix)) field.remove_prefix(prefix.size());
  }
  return {.field = std::string(field), .description = violation.description(), .hint = {}};
}

grpc::ChannelArguments Arguments() {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(kMaxAnswerBytes);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 5000);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, 30'000);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 20'000);
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);  // A proxy for the web does not know contactd.
  return arguments;
}

// A host name or an address, one of IPv6 in brackets.
bool IsHost(std::string_view host) {
  if (host.starts_with('[')) return host.ends_with(']');
  return !host.empty() && host.find_first_of(":/ ") == std::string_view::npos;
}

void RequireAddress(const std::string& server) {
  if (server.starts_with("unix:")) return;
  const std::size_t colon = std::min(server.rfind(':'), server.size());
  const std::string port = server.substr(std::min(colon + 1, server.size()));
  const bool digits = port.find_first_not_of("0123456789") == std::string::npos;
  if (!port.empty() && digits && IsHost(server.substr(0, colon))) return;
  const std::size_t scheme = server.find("://");
  const std::string why = scheme == std::string::npos
                              ? "must be HOST:PORT"
                              : fmt::format("contactd speaks gRPC, not {}; give HOST:PORT alone",
                                            server.substr(0, scheme));
  throw Failure(ExitCode::kUsage,
                fmt::format("--server is '{}': {}, such as 127.0.0.1:7070", server, why));
}

}  // namespace

std::string TransportWords(const std::string& message) {
  if (Contains(message, "Connection refused")) return "connection refused";
  if (IsUnknownName(message)) return std::string(kUnknownName);
  return IsOtherProtocol(message) ? "what answers there does not speak gRPC" : message;
}

std::string ServerAdvice(const std::string& server, const std::string& words) {
  if (!server.starts_with("unix:")) return HostAdvice(server, words);
  const bool packaged = server.starts_with("unix:/run/contactd/");
  if (Contains(words, "Permission denied")) {
    return packaged ? "sudo adduser \"$USER\" contact, then log in again"
                    : "log in again if you have joined its group, else ask its owner";
  }
  return packaged ? "sudo systemctl start contactd" : "";
}

CallFailure::CallFailure(const grpc::Status& status, const std::string& server)
    : Failure(Code(status.error_code(), Find<google::rpc::ErrorInfo>(Details(status)).reason()),
              Words(status, Find<google::rpc::ErrorInfo>(Details(status)).reason(), server)),
      status_(status.error_code()) {
  const google::rpc::Status details = Details(status);
  reason_ = Find<google::rpc::ErrorInfo>(details).reason();
  const auto request = Find<google::rpc::BadRequest>(details);
  for (const auto& violation : request.field_violations()) {
    violations_.push_back(FromServer(violation));
  }
}

Failure CallFailure::AllTold() const {
  std::string text;
  for (const Violation& violation : violations_) {
    text +=
        fmt::format("{}{}: {}", text.empty() ? "" : "\n", violation.field, violation.description);
  }
  return {code(), violations_.empty() ? what() : text};
}

Client::Client(std::string server, std::chrono::milliseconds call_timeout,
               const std::shared_ptr<grpc::ChannelCredentials>& credentials, Answers answers)
    : server_(std::move(server)), call_timeout_(call_timeout) {
  RequireAddress(server_);
  channel_ = grpc::experimental::CreateCustomChannelWithInterceptors(
      server_, credentials, Arguments(),
      answers == Answers::kPrintable ? PrintableAnswers() : Interceptors());
  stub_ = v1::JobService::NewStub(channel_);
}

void Client::Try(const std::function<grpc::Status(grpc::ClientContext*)>& call) {
  grpc::Status status;
  auto pause = kFirstPause;
  for (int i = 0; i < kTries; ++i) {
    if (i > 0) std::this_thread::sleep_for(std::exchange(pause, 2 * pause));
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + call_timeout_);
    status = call(&context);
    if (status.ok()) return;
    if (status.error_code() != grpc::StatusCode::UNAVAILABLE) break;
  }
  // A deadline that passed while there was no connection says that there is no server.
  if (status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED &&
      channel_->GetState(false) != GRPC_CHANNEL_READY) {
    status = {grpc::StatusCode::UNAVAILABLE, "no connection in time"};
  }
  throw CallFailure(status, server_);
}

}  // namespace contact::cli
