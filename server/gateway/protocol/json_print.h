#pragma once

#include <google/protobuf/message.h>

#include <optional>
#include <string>

namespace contact::gateway {

/// A message as protobuf's JSON has it; nothing if it has none, as a time out of range. Numbers
/// have the fewest digits that identify them. Not protobuf 3.21's own printer, which describes each
/// type anew for each message and prints doubles up to three times.
std::optional<std::string> PrintJson(const google::protobuf::Message& message);

}  // namespace contact::gateway
