#pragma once

#include <spdlog/logger.h>

namespace contact {

enum class LogFormat {
  kText,  ///< Time, level, message.
  kJson,  ///< The same, one object a line.
};

/// Makes the log of the process, which goes to stderr.
void SetUpLog(spdlog::level::level_enum level, LogFormat format);

/// Gives a log the format.
void SetFormat(LogFormat format, spdlog::logger* log);

}  // namespace contact
