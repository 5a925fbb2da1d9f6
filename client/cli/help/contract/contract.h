#pragma once

#include <google/protobuf/descriptor.h>

#include <span>
#include <string>

namespace contact::cli {

/// The contract as a serialised google.protobuf.FileDescriptorSet, comments included.
std::span<const unsigned char> ContractBytes();

/// The contract with its comments, which the descriptors of the generated classes lack.
class Contract {
 public:
  Contract();

  /// A message of package contact.v1, by its short name.
  const google::protobuf::Descriptor& Message(const std::string& name) const;

 private:
  google::protobuf::DescriptorPool pool_;
};

/// The comment before `element`, a descriptor of a Contract: a line for each paragraph; lines
/// that are indented in the comment keep a line and their indentation.
template <class Element>
std::string CommentOf(const Element& element);

/// The name of an element within the package, such as `Load.Sine`.
std::string ShortTypeName(const google::protobuf::Descriptor& message);

/// The value of an enum that stands for none, and that nobody writes.
bool IsUnspecified(const google::protobuf::EnumValueDescriptor& value);

}  // namespace contact::cli
