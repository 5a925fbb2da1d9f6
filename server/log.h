#pragma once

#include <spdlog/logger.h>

#include <string>

namespace contact {

/// Form of the lines of the log.
enum class LogFormat {
  kText,  ///< Time, level and message, separated by spaces.
  kJson,  ///< A JSON object with `time`, `level` and `message`.
};

/// Makes the default logger of the process, which writes to stderr. To be called once.
void SetUpLog(spdlog::level::level_enum level, LogFormat format);

/// Gives a logger the format.
void SetFormat(LogFormat format, spdlog::logger* log);

/// Prints a line to the standard output at once, in JSON as a line of the log.
void Greet(LogFormat format, const std::string& line);

}  // namespace contact
