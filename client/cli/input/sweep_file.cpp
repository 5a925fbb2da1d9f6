#include "cli/input/sweep_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/base/scalar.h"
#include "cli/input/file_table.h"
#include "cli/input/scenario_file.h"
#include "cli/input/sweep_rules.h"
#include "cli/input/templates.h"
#include "cli/input/yaml_document.h"
#include "cli/input/yaml_reader.h"

namespace contact::cli {
namespace {

// A sweep while it is read: gathers mistakes at their places.
class SweepFile {
 public:
  // `shipped`: its base is a template, not a file.
  SweepFile(std::string path, VariableValues variables, bool shipped)
      : path_(std::move(path)),
        variables_(std::move(variables)),
        shipped_(shipped),
        tables_(std::filesystem::path(path_).parent_path().string()) {}

  v1::Sweep Read(const std::string& text) {
    try {
      root_.reset(LoadYaml(text).first);
      ReadRoot();
    } catch (const YAML::Exception& error) {
      AddAt(error.mark, "", "malformed YAML: " + error.msg, "");
    }
    if (mistakes_.empty()) Check();
    RequireNone(mistakes_);
    return std::move(sweep_);
  }

 private:
  void ReadRoot() {
    if (root_.IsNull()) return AddAt(root_.Mark(), "", "is empty", "a sweep has base and axes");
    const auto advise = [this](const YAML::Mark& mark, const std::string& field,
                               const std::string& what, const std::string& hint) {
      advice_.push_back(DiagnosticAt(name(), mark, field, what, hint));
    };
    const VariableFields own =
        ResolveVariables(variables_, std::bind_front(&SweepFile::AddAt, this), advise, &root_);
    if (!mistakes_.empty()) return;  // A text that names an unknown variable has no value.
    std::erase_if(variables_, [&own](const auto& given) { return own.contains(given.first); });
    YAML::Node rest = YAML::Clone(root_);
    if (rest.IsMap() && rest["base"].IsDefined() && rest["base"].IsScalar()) {
      OpenBase(rest["base"].Scalar());
      rest.remove("base");
    } else {
      RequireKnown(variables_, own);
    }
    NameFields(base_ ? base_->variables() : WithinBase(own), &rest);
    NumberEnums(&rest);
    // The reader sees a clone, whose nodes have no marks.
    const YamlReader::Report report = [this](const YAML::Mark&, const std::string& field,
                                             const std::string& what, const std::string& hint) {
      AddAt(FindNode(root_, field).node.Mark(), field, what, hint);
    };
    YamlReader(report, std::bind_front(&FileTables::Read, &tables_, report))
        .ReadMessage(rest, "", &sweep_);
    std::ranges::copy(tables_.mistakes(), std::back_inserter(mistakes_));
    std::ranges::copy(tables_.advice(), std::back_inserter(advice_));
  }

  // The fields of variables that lie in the base, as paths from there.
  static VariableFields WithinBase(const VariableFields& variables) {
    constexpr std::string_view kBase = "base.";
    VariableFields within;
    for (const auto& [name, fields] : variables) {
      for (const std::string& field : fields) {
        if (field.starts_with(kBase)) within[name].push_back(field.substr(kBase.size()));
      }
      within[name];  // Also if it is no field.
    }
    return within;
  }

  // Gives axes over a variable the fields of the variable.
  void NameFields(const VariableFields& variables, YAML::Node* sweep) {
    if (!sweep->IsMap() || !(*sweep)["axes"].IsSequence()) return;
    int index = 0;
    for (YAML::Node axis : (*sweep)["axes"]) {
      const std::string path = fmt::format("axes[{}].field", index++);
      if (!axis.IsMap() || !axis["field"].IsScalar()) continue;
      const auto found = FindVariableAxis(axis["field"].Scalar(), variables);
      if (!found) continue;
      if (found->fields.empty()) {
        AddAt(FindNode(root_, path).node.Mark(), path, found->problem, found->hint);
        continue;
      }
      if (!axis["label"].IsDefined()) axis["label"] = axis["field"].Scalar();
      axis["field"] = found->fields.front();
      for (std::size_t i = 1; i < found->fields.size(); ++i)
        axis["also"].push_back(found->fields[i]);
    }
  }

  // The values of an enum are its numbers on the wire; here they may be its words.
  static void NumberEnums(YAML::Node* sweep) {
    if (!sweep->IsMap() || !(*sweep)["axes"].IsSequence()) return;
    for (YAML::Node axis : (*sweep)["axes"]) {
      if (!axis.IsMap() || !axis["field"].IsScalar() || !axis["values"].IsSequence()) continue;
      for (YAML::Node entry : axis["values"]) {
        if (!entry.IsScalar() || ParseNumber(entry.Scalar())) continue;
        const std::optional<double> number = AxisValue(axis["field"].Scalar(), entry.Scalar());
        if (number) entry = static_cast<int>(*number);
      }
    }
  }

  void OpenBase(const std::string& name) {
    const std::filesystem::path path = std::filesystem::path(path_).parent_path() / name;
    if (shipped_) {
      const std::string text(FindTemplate(path.stem().string()).text);
      base_.emplace(path.stem().string(), text, variables_);
    } else {
      base_ = ScenarioFile::Open(path.string(), variables_);
    }
    for (Diagnostic& mistake : base_->diagnostics()) mistakes_.push_back(std::move(mistake));
    *sweep_.mutable_base() = base_->scenario();
  }

  void Check() {
    if (!sweep_.has_base()) {
      return AddAt(root_.Mark(), "base", "is missing", "name a scenario file, or write one here");
    }
    mistakes_ = CheckSweep(sweep_, base_ ? &*base_ : nullptr, [this](const Violation& rule) {
      if (std::optional<Diagnostic> placed = tables_.Place(rule)) return *placed;
      return DiagnosticIn(root_, name(), rule);
    });
    if (!mistakes_.empty()) return;
    for (const Diagnostic& advice : advice_) fmt::print(stderr, "{}\n", Format(advice, "warning"));
    if (base_) TellAdvice(*base_);
  }

  void AddAt(const YAML::Mark& mark, std::string field, std::string what, std::string hint) {
    mistakes_.push_back(
        DiagnosticAt(name(), mark, std::move(field), std::move(what), std::move(hint)));
  }

  std::string name() const { return path_ == "-" ? "<stdin>" : path_; }

  const std::string path_;
  VariableValues variables_;  ///< That are not the file's own.
  const bool shipped_;
  YAML::Node root_;
  std::optional<ScenarioFile> base_;  ///< If it is a file of its own.
  FileTables tables_;                 ///< Of a base that is written here.
  v1::Sweep sweep_;
  std::vector<Diagnostic> mistakes_;
  std::vector<Diagnostic> advice_;  ///< On the file's own variables.
};

// True if a document is a mapping with this key.
bool Has(const std::string& text, const char* key) {
  try {
    const YAML::Node root = LoadYaml(text).first;
    return root.IsMap() && root[key].IsDefined();
  } catch (const YAML::Exception&) {
    return false;
  }
}

}  // namespace

v1::Sweep ReadSweep(const std::string& path, const std::string& text,
                    const VariableValues& variables, bool shipped) {
  return SweepFile(path, variables, shipped).Read(text);
}

bool IsSweep(const std::string& text) { return Has(text, "base") || Has(text, "axes"); }

bool IsScenario(const std::string& text) { return !IsSweep(text) && Has(text, "bodies"); }

}  // namespace contact::cli
