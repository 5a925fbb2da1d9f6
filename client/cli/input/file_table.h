#pragma once

#include <google/protobuf/message.h>
#include <yaml-cpp/yaml.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/input/diagnostic.h"
#include "cli/input/measured.h"
#include "cli/input/yaml_reader.h"
#include "wire/rules/violation.h"

namespace contact::cli {

/// Reads tables of loads and motions from files: `{file: measured.csv, column: force, unit: kN}`
/// becomes the lists `times_s` and `forces_n` of the message.
class FileTables {
 public:
  /// `folder`: that of the scenario file, from which the names of files count.
  explicit FileTables(std::string folder) : folder_(std::move(folder)) {}

  /// Reads the file that the mapping at `path` names into `message`. Mistakes in the mapping go to
  /// `report`, those in the file to mistakes().
  void Read(const YamlReader::Report& report, const YAML::Node& node, const std::string& path,
            google::protobuf::Message* message);

  /// A rule that an entry of a list from a file breaks, at the place where the file has the entry;
  /// nothing for other fields.
  std::optional<Diagnostic> Place(const Violation& violation) const;

  /// What is wrong in the files.
  const std::vector<Diagnostic>& mistakes() const { return mistakes_; }
  /// What was assumed, such as a unit that nothing tells.
  const std::vector<Diagnostic>& advice() const { return advice_; }

 private:
  // A file that was read, and the columns of it that a message has.
  struct Source {
    MeasuredTable table;
    std::size_t times, values;
    double first_time = 0;
  };
  class Request;

  std::string folder_;
  std::map<std::string, Source> sources_;  // By the path of the message.
  std::vector<Diagnostic> mistakes_, advice_;
};

}  // namespace contact::cli
