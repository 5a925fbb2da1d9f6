#pragma once

#include <string>

#include "cli/link/client.h"

namespace contact::cli {

/// The name `jobs/ID` of the job that `text` means: an ID or `jobs/ID`; the beginning of an ID that
/// only one job of the server has; `last`, the newest job; or `last~N`, the Nth before it. Asks the
/// server unless the ID is whole. A text with which no ID begins is taken for an ID, so that the
/// server says that there is no such job. Throws Failure: kUsage with the candidates if several IDs
/// begin so, or for a bad N; kNotFound if the server has fewer jobs. Throws CallFailure.
std::string FindJob(Client& client, const std::string& text);

}  // namespace contact::cli
