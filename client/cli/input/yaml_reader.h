#pragma once

#include <google/protobuf/message.h>
#include <yaml-cpp/yaml.h>

#include <functional>
#include <string>

namespace contact::cli {

/// The innermost node on the way to a field that the document has.
struct FoundNode {
  YAML::Node node;
  bool exact;  ///< It is that of the field itself.
};
FoundNode FindNode(const YAML::Node& root, const std::string& path);

/// Reads YAML nodes into messages by reflection: keys are field names, enum values their names in
/// either case. Goes on after a mistake, so that all are reported. A key without a value leaves
/// its field out, but makes a message of nothing where the field is one (`gravity:`).
class YamlReader {
 public:
  /// Hears of each mistake: where, path of the field, what, hint (or empty).
  using Report = std::function<void(const YAML::Mark& mark, const std::string& field,
                                    const std::string& what, const std::string& hint)>;

  explicit YamlReader(Report report) : report_(std::move(report)) {}

  /// Reads a mapping. `path` is that of the message, empty for the outermost.
  void ReadMessage(const YAML::Node& node, const std::string& path,
                   google::protobuf::Message* message) const;

  /// Reads the value of one field, replacing what is there.
  void ReadField(const YAML::Node& node, const std::string& path,
                 const google::protobuf::FieldDescriptor& field,
                 google::protobuf::Message* message) const;

 private:
  void ReadEntry(const YAML::Node& key, const YAML::Node& value, const std::string& path,
                 google::protobuf::Message* message) const;
  void ReadList(const YAML::Node& node, const std::string& path,
                const google::protobuf::FieldDescriptor& field,
                google::protobuf::Message* message) const;
  void ReadScalar(const YAML::Node& node, const std::string& path,
                  const google::protobuf::FieldDescriptor& field,
                  google::protobuf::Message* message) const;
  void ReadEnum(const YAML::Node& node, const std::string& path,
                const google::protobuf::FieldDescriptor& field,
                google::protobuf::Message* message) const;
  void Refuse(const YAML::Node& node, const std::string& path, const std::string& expected,
              const std::string& hint = {}) const;

  Report report_;
};

}  // namespace contact::cli
