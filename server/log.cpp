#include "log.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace contact {
namespace {

// The message as a JSON string: it may hold what a client wrote.
class JsonMessage final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& line, const std::tm& /*time*/,
              spdlog::memory_buf_t& out) override {
    const nlohmann::json message = std::string(line.payload.begin(), line.payload.end());
    const std::string text = message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    out.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<JsonMessage>();
  }
};

}  // namespace

void SetFormat(LogFormat format, spdlog::logger* log) {
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<JsonMessage>('*');
  formatter->set_pattern(format == LogFormat::kJson
                             ? R"({"time":"%Y-%m-%dT%H:%M:%S.%e%z","level":"%l","message":%*})"
                             : "%Y-%m-%dT%H:%M:%S.%e%z %l %v");
  log->set_formatter(std::move(formatter));
}

void SetUpLog(spdlog::level::level_enum level, LogFormat format) {
  auto log = spdlog::stderr_logger_mt("contactd");
  log->set_level(level);
  SetFormat(format, log.get());
  spdlog::set_default_logger(std::move(log));
}

void Greet(LogFormat format, const std::string& line) {
  spdlog::logger greeting("greeting", std::make_shared<spdlog::sinks::stdout_sink_mt>());
  if (format == LogFormat::kJson) {
    SetFormat(format, &greeting);
  } else {
    greeting.set_pattern("%v");
  }
  greeting.info(line);
  greeting.flush();
}

}  // namespace contact
