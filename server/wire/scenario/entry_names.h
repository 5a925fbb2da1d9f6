#pragma once

#include <google/protobuf/message.h>

#include <string>

namespace contact {

/// An entry of a list that a path names, as in `contacts[B1-B2].restitution`.
struct NamedEntry {
  /// Its index; −1 if no single entry has the name.
  int index = -1;
  /// Why there is none; else empty.
  std::string problem = {};
  /// What to do about it; may be empty.
  std::string hint = {};
};

/// The entry with this name in `list`, a list of `message`. Bodies and contacts of a scenario have
/// names. A contact has its own, and that of the ledger if its entry makes no other contact.
NamedEntry FindNamed(const google::protobuf::Message& message,
                     const google::protobuf::FieldDescriptor& list, const std::string& name);

/// The name by which FindNamed finds the entry with this index of `list`; empty if it has none.
std::string NameOfEntry(const google::protobuf::Message& message,
                        const google::protobuf::FieldDescriptor& list, int index);

}  // namespace contact
