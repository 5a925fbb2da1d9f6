#include "rpc/grpc_log.h"

#include <google/protobuf/stubs/logging.h>
#include <grpc/support/log.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/mutex.h"
#include "base/spelling.h"

namespace contact {
namespace {

constexpr int kLinesPerSecond = 10;

// Counts the lines of the running second.
class LineBudget {
 public:
  // The number of lines that were left out before this one; nothing if this one is left out, too.
  std::optional<int> Take() {
    const auto second = std::chrono::floor<std::chrono::seconds>(std::chrono::steady_clock::now());
    if (std::exchange(second_, second) != second) lines_ = 0;
    if (++lines_ <= kLinesPerSecond) return std::exchange(left_out_, 0);
    ++left_out_;
    return std::nullopt;
  }

 private:
  std::chrono::time_point<std::chrono::steady_clock, std::chrono::seconds> second_;
  int lines_ = 0;
  int left_out_ = 0;
};

spdlog::level::level_enum Level(gpr_log_severity severity) {
  switch (severity) {
    case GPR_LOG_SEVERITY_DEBUG:
      return spdlog::level::debug;
    case GPR_LOG_SEVERITY_INFO:
      return spdlog::level::info;
    case GPR_LOG_SEVERITY_ERROR:
      break;
  }
  return spdlog::level::warn;  // gRPC calls it an error; the cause is a bad peer.
}

// A place in gRPC's source: file and line. Each has a budget of its own, so that frequent lines of
// one do not suppress those of the others.
using Site = std::pair<std::string_view, int>;

std::optional<int> TakeOf(const Site& site) {
  static Mutex mutex;
  static std::map<Site, LineBudget> budgets ABSL_GUARDED_BY(mutex);
  const MutexLock lock(mutex);
  return budgets[site].Take();
}

void Log(gpr_log_func_args* line) {
  const auto left_out = TakeOf({line->file, line->line});
  if (!left_out) return;
  if (*left_out > 0) spdlog::warn("gRPC: {} left out", Count(*left_out, "line", "lines"));
  spdlog::log(Level(line->severity), "gRPC: {}", line->message);
}

// Whatever level it has, a client has sent it; what is fatal ends the process by itself.
void LogOfProtobuf(google::protobuf::LogLevel /*level*/, const char* file, int line,
                   const std::string& message) {
  const auto left_out = TakeOf({file, line});
  if (!left_out) return;
  if (*left_out > 0) spdlog::warn("protobuf: {} lines left out", *left_out);
  spdlog::warn("protobuf: {}", message);
}

}  // namespace

void RouteGrpcLog() {
  gpr_set_log_function(Log);
  google::protobuf::SetLogHandler(LogOfProtobuf);
}

}  // namespace contact
