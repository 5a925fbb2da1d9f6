#pragma once

#include <google/protobuf/descriptor.h>

#include <span>
#include <string>

namespace contact::cli {

/// The contract as a serialised google.protobuf.FileDescriptorSet, comments included. Made by the
/// build from proto/; lives as long as the program.
std::span<const unsigned char> ContractBytes();

/// The contract with its comments, which the descriptors of the generated classes lack. Owns the
/// descriptors that it gives out.
class Contract {
 public:
  /// Reads ContractBytes. Throws std::logic_error if they are damaged.
  Contract();

  /// The message of package contact.v1 with this short name, such as `Scenario`. Throws
  /// std::logic_error if there is none.
  const google::protobuf::Descriptor& Message(const std::string& name) const;

 private:
  google::protobuf::DescriptorPool pool_;
};

/// The text of a comment of the contract. Each paragraph is one line; an indented line of the
/// comment, such as a formula, stays a line with its indentation.
std::string Unwrap(const std::string& comment);

/// The unwrapped comment before `element`, a descriptor of a Contract; empty without one.
template <class Element>
std::string CommentOf(const Element& element) {
  google::protobuf::SourceLocation location;
  return element.GetSourceLocation(&location) ? Unwrap(location.leading_comments) : "";
}

/// The comment of a field, followed by its rules in words: `Mass. Range: (0, 1e12].`
std::string FieldText(const google::protobuf::FieldDescriptor& field);

/// The name of a message within the package, such as `Load.Sine`; the full name of a message of
/// another package.
std::string ShortTypeName(const google::protobuf::Descriptor& message);

/// True for the value 0 of an enum if it means that no value is chosen. Files do not contain it.
bool IsUnspecified(const google::protobuf::EnumValueDescriptor& value);

}  // namespace contact::cli
