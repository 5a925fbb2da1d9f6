#pragma once

#include <string>
#include <variant>

#include "config.h"

namespace contact {

/// Why the program ends at once.
struct Exit {
  int code;          ///< An ExitCode.
  std::string text;  ///< To print before: on stdout if the code is 0, on stderr otherwise.
};

/// Reads the flags. Each is also an environment variable (`--data-dir` is CONTACTD_DATA_DIR) and a
/// key of the file named by `--config`; a flag beats the variable, and that beats the file.
std::variant<Config, Exit> ReadConfig(int argc, const char* const* argv);

}  // namespace contact
