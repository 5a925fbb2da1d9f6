#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "cli/input/diagnostic.h"
#include "cli/input/file_table.h"
#include "cli/input/variables.h"
#include "contact/v1/scenario.pb.h"
#include "wire/scenario/scenario_codec.h"

namespace contact::cli {

/// A scenario as its author wrote it: a YAML file (of which JSON is a part) and overrides of its
/// fields. Mistakes are gathered, not thrown.
class ScenarioFile {
 public:
  /// Reads `path`; `-` is the standard input. Throws Failure (kLocal) if there is no such file.
  static ScenarioFile Open(const std::string& path, const VariableValues& variables = {});

  /// Reads `text`; `name` is what mistakes call it, `folder` where tables in files of their own
  /// are. Throws Failure (kUsage) if it has not one of the variables.
  ScenarioFile(std::string name, const std::string& text, const VariableValues& variables = {},
               std::string folder = {});

  /// Overrides a field: `contacts[0].restitution=0.7`. In brackets may stand the name of a body or
  /// contact, or `*` for every entry of a list. The value is YAML. Throws Failure (kUsage) if this
  /// is no assignment.
  void Set(const std::string& assignment);

  /// Checks the rules of the contract, in the words of the server. Where the file itself has
  /// mistakes, only what they cannot have caused is added.
  void Check(const ScenarioLimits& limits = {});

  /// Adds a broken rule at the place where its field is written.
  void Add(const Violation& violation);

  /// A broken rule, or advice, with the place where its field is written, or would be.
  Diagnostic Place(const Violation& violation) const;

  /// What was read, with the overrides; incomplete if there are mistakes.
  const v1::Scenario& scenario() const { return scenario_; }

  /// All mistakes, in order of place.
  std::vector<Diagnostic> diagnostics() const;

  /// What is no mistake, but will probably not show what the author wants: variables that are used
  /// nowhere, and what Check found.
  const std::vector<Diagnostic>& advice() const { return advice_; }

  /// The fields of each variable that the file declares.
  const VariableFields& variables() const { return variables_; }

 private:
  /// Reads the YAML and fills the scenario.
  void ReadDocument(const std::string& text, const VariableValues& variables);
  /// Adds a mistake at a place of the file.
  void AddAt(const YAML::Mark& mark, std::string field, std::string what, std::string hint);
  /// True if one of the mistakes may be the reason why the rule is broken.
  bool MayFollowFrom(const std::vector<Diagnostic>& mistakes, const Violation& violation) const;

  /// What mistakes call the file.
  std::string name_;
  /// The document, whose nodes know their places.
  YAML::Node root_;
  FileTables tables_;
  v1::Scenario scenario_;
  VariableFields variables_;
  /// Paths of the fields that Set has replaced: they have no place in the file.
  std::vector<std::string> overridden_;
  std::vector<Diagnostic> diagnostics_;
  std::vector<Diagnostic> advice_;
};

/// The scenario with the overrides, such as `end_time_s=1e-3`, and its rules checked. Throws
/// Failure (kInvalidScenario) that lists every mistake.
ScenarioFile Checked(ScenarioFile file, const std::vector<std::string>& overrides,
                     const ScenarioLimits& limits = {});

/// Tells on the standard error what Check advises.
void TellAdvice(const ScenarioFile& file);

}  // namespace contact::cli
