#pragma once

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <yaml-cpp/yaml.h>

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace contact::cli {

/// The words that the value of an enum may be: all but the one with the number 0, which stands for
/// an unset field.
std::vector<std::string> EnumWords(const google::protobuf::EnumDescriptor& type);

/// The value of an enum that a text names, in either case and with `-` for `_`; null if there is
/// none.
const google::protobuf::EnumValueDescriptor* FindWord(const google::protobuf::EnumDescriptor& type,
                                                      const std::string& text);

/// A key with which a table of a scenario file says which numbers of another file it is.
struct FileKey {
  std::string_view name;
  /// Its JSON Schema type: `string`, `number`, `integer`, or empty for a text or a number.
  std::string_view type;
  /// What it means, for people.
  std::string_view text;
};

/// The keys, `file` first.
std::span<const FileKey> FileKeys();

/// The list of values of a table of times and values, which may be in a file of its own; null for
/// messages of another type.
const google::protobuf::FieldDescriptor* TableValues(const google::protobuf::Descriptor& type);

/// Reads YAML nodes into messages by reflection: keys are field names, enum values their names in
/// either case. Goes on after a mistake, so that all are reported. A key without a value leaves
/// its field out, but makes a message of nothing where the field is one (`gravity:`).
class YamlReader {
 public:
  /// Hears of each mistake: where, path of the field, what, hint (or empty).
  using Report = std::function<void(const YAML::Mark& mark, const std::string& field,
                                    const std::string& what, const std::string& hint)>;

  /// Reads the file that a mapping with the key `file` names into its message.
  using ReadFile = std::function<void(const YAML::Node& node, const std::string& path,
                                      google::protobuf::Message* message)>;

  /// Without `read_file`, no table may be in a file of its own.
  explicit YamlReader(Report report, ReadFile read_file = nullptr)
      : report_(std::move(report)), read_file_(std::move(read_file)) {}

  /// Reads a mapping. `path` is that of the message, empty for the outermost.
  void ReadMessage(const YAML::Node& node, const std::string& path,
                   google::protobuf::Message* message) const;

  /// Reads the value of one field, replacing what is there.
  void ReadField(const YAML::Node& node, const std::string& path,
                 const google::protobuf::FieldDescriptor& field,
                 google::protobuf::Message* message) const;

 private:
  /// Reads one key of a mapping and its value. Reports an unknown or repeated key.
  void ReadEntry(const YAML::Node& key, const YAML::Node& value, const std::string& path,
                 google::protobuf::Message* message) const;
  /// Reads a key of a mapping whose numbers are in a file: not one that Read of FileTables reads.
  void ReadEntryBesideFile(const YAML::Node& key, const YAML::Node& value, const std::string& path,
                           google::protobuf::Message* message) const;
  /// Reads a sequence into a repeated field.
  void ReadList(const YAML::Node& node, const std::string& path,
                const google::protobuf::FieldDescriptor& field,
                google::protobuf::Message* message) const;
  /// Reads a number, a flag or a text.
  void ReadScalar(const YAML::Node& node, const std::string& path,
                  const google::protobuf::FieldDescriptor& field,
                  google::protobuf::Message* message) const;
  /// Reads the word of an enum, or its number.
  void ReadEnum(const YAML::Node& node, const std::string& path,
                const google::protobuf::FieldDescriptor& field,
                google::protobuf::Message* message) const;
  /// Reports that the node is not what was `expected`.
  void Refuse(const YAML::Node& node, const std::string& path, const std::string& expected,
              const std::string& hint = {}) const;

  /// Whether the table of this type is in a file of its own, which the mapping names.
  bool IsInFile(const YAML::Node& node, const google::protobuf::Descriptor& type) const;

  Report report_;
  ReadFile read_file_;
};

}  // namespace contact::cli
