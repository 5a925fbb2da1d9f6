#pragma once

#include <chrono>
#include <string>

#include "cli/verbs/identity/device_login.h"

namespace contact::cli {

/// Gets `url`, or posts `form` to it if there is one; follows no redirection. The server of an
/// https URL must show a certificate of the authorities in the file `ca`, or of the system's if
/// that is empty. `timeout` limits connecting and each wait for data. Throws Failure: kUnreachable
/// if there is no answer or one of more than 1 MiB, kUsage if `url` is no http or https URL.
WebAnswer Ask(const std::string& url, const Form* form, const std::string& ca,
              std::chrono::milliseconds timeout);

}  // namespace contact::cli
