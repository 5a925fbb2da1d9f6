#include "cli/input/sweep_file.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/base/failure.h"
#include "cli/base/scalar.h"
#include "cli/base/text_file.h"
#include "cli/input/scenario_file.h"
#include "cli/input/yaml_reader.h"
#include "wire/field_path.h"
#include "wire/scenario_advice.h"
#include "wire/sweep_codec.h"

namespace contact::cli {
namespace {

// How much is too much is for the server to say; it has to fit into memory here, though.
constexpr ScenarioLimits kLimits{.max_bodies = std::numeric_limits<std::int32_t>::max(),
                                 .max_contacts = std::numeric_limits<std::int32_t>::max(),
                                 .max_samples = std::numeric_limits<std::int64_t>::max(),
                                 .max_cells = 1'000'000};

// The type of the field at a path in a scenario, if it is an enum.
const google::protobuf::EnumDescriptor* EnumAt(const std::string& path) {
  const google::protobuf::Descriptor* message = v1::Scenario::descriptor();
  const google::protobuf::FieldDescriptor* field = nullptr;
  for (const PathStep& step : ParsePath(path)) {
    field = message == nullptr ? nullptr : message->FindFieldByName(step.name);
    if (field == nullptr) return nullptr;
    message = field->message_type();
  }
  return field == nullptr ? nullptr : field->enum_type();
}

// A sweep while it is read: gathers mistakes at their places.
class SweepFile {
 public:
  SweepFile(std::string path, VariableValues variables)
      : path_(std::move(path)), variables_(std::move(variables)) {}

  v1::Sweep Read(const std::string& text) {
    try {
      root_.reset(YAML::Load(text));
      ReadRoot();
    } catch (const YAML::Exception& error) {
      AddAt(error.mark, "", "malformed YAML: " + error.msg, "");
    }
    if (mistakes_.empty()) Check();
    for (const Diagnostic& advice : advice_) fmt::print(stderr, "{}\n", Format(advice, "warning"));
    if (mistakes_.empty()) return std::move(sweep_);
    std::string list;
    for (const Diagnostic& mistake : mistakes_) list += Format(mistake) + "\n";
    list += mistakes_.size() == 1 ? "1 error" : fmt::format("{} errors", mistakes_.size());
    throw Failure(ExitCode::kInvalidScenario, list);
  }

 private:
  void ReadRoot() {
    if (root_.IsNull()) return AddAt(root_.Mark(), "", "is empty", "a sweep has base and axes");
    const YamlReader::Report report = [this](const YAML::Mark& mark, const std::string& field,
                                             const std::string& what, const std::string& hint) {
      AddAt(mark, field, what, hint);
    };
    const VariableValues own = ResolveVariables(variables_, report, &root_);
    std::erase_if(variables_, [&own](const auto& given) { return own.contains(given.first); });
    YAML::Node rest = YAML::Clone(root_);
    if (rest.IsMap() && rest["base"].IsDefined() && rest["base"].IsScalar()) {
      OpenBase(rest["base"].Scalar());
      rest.remove("base");
    } else {
      RequireKnown(variables_, own);
    }
    NumberEnums(&rest);
    YamlReader(report).ReadMessage(rest, "", &sweep_);
  }

  // The values of an enum are its numbers on the wire; here they may be its words.
  static void NumberEnums(YAML::Node* sweep) {
    if (!sweep->IsMap() || !(*sweep)["axes"].IsSequence()) return;
    for (YAML::Node axis : (*sweep)["axes"]) {
      if (!axis.IsMap() || !axis["field"].IsScalar() || !axis["values"].IsSequence()) continue;
      const auto* type = EnumAt(axis["field"].Scalar());
      for (std::size_t i = 0; type != nullptr && i < axis["values"].size(); ++i) {
        YAML::Node entry = axis["values"][i];
        const auto* value = entry.IsScalar() ? type->FindValueByName(entry.Scalar()) : nullptr;
        if (value != nullptr) entry = value->number();
      }
    }
  }

  void OpenBase(const std::string& name) {
    base_ = ScenarioFile::Open((std::filesystem::path(path_).parent_path() / name).string(),
                               variables_);
    for (Diagnostic& mistake : base_->diagnostics()) mistakes_.push_back(std::move(mistake));
    *sweep_.mutable_base() = base_->scenario();
  }

  void Check() {
    if (!sweep_.has_base()) {
      return AddAt(root_.Mark(), "base", "is missing", "name a scenario file, or write one here");
    }
    const DecodedSweep plan = DecodeSweep(sweep_, kLimits);
    for (const Violation& violation : plan.violations) mistakes_.push_back(Place(violation));
    if (!plan.violations.empty()) return;
    for (const Violation& advice : Advise(sweep_, plan)) advice_.push_back(Place(advice));
  }

  // In the sweep, or in the file of its base.
  Diagnostic Place(Violation violation) const {
    constexpr std::string_view kBase = "base.";
    if (base_ && violation.field.starts_with(kBase)) {
      violation.field.erase(0, kBase.size());
      return base_->Place(violation);
    }
    const YAML::Mark mark = FindNode(root_, violation.field).node.Mark();
    return {.source = name(),
            .line = mark.line + 1,
            .column = mark.column + 1,
            .field = violation.field,
            .what = violation.description,
            .hint = violation.hint};
  }

  void AddAt(const YAML::Mark& mark, std::string field, std::string what, std::string hint) {
    mistakes_.push_back({.source = name(),
                         .line = mark.line + 1,
                         .column = mark.column + 1,
                         .field = std::move(field),
                         .what = std::move(what),
                         .hint = std::move(hint)});
  }

  std::string name() const { return path_ == "-" ? "<stdin>" : path_; }

  const std::string path_;
  VariableValues variables_;  ///< That are not the file's own.
  YAML::Node root_;
  std::optional<ScenarioFile> base_;  ///< If it is a file of its own.
  v1::Sweep sweep_;
  std::vector<Diagnostic> mistakes_;
  std::vector<Diagnostic> advice_;
};

[[noreturn]] void FailAxis(const std::string& axis, bool drawn) {
  throw Failure(
      ExitCode::kUsage,
      fmt::format("--grid {}: expected FIELD={} or FIELD=A,B,C", axis,
                  drawn ? "LOW:HIGH, which --random and --lhs draw from," : "FIRST:LAST:COUNT"));
}

std::vector<double> Numbers(const std::string& axis, const std::string& range, bool drawn) {
  std::vector<double> numbers;
  std::istringstream parts(range);
  for (std::string part; std::getline(parts, part, ':');) {
    const auto number = ParseNumber(part);
    if (!number) FailAxis(axis, drawn);
    numbers.push_back(*number);
  }
  return numbers;
}

// `FIRST:LAST:COUNT` as a list of values, which may also fall.
std::string Steps(const std::string& axis, const std::string& range) {
  const std::vector<double> ends = Numbers(axis, range, false);
  constexpr double kMost = 10'000;
  if (ends.size() != 3 || !(ends[2] >= 1) || ends[2] > kMost) FailAxis(axis, false);
  const int count = static_cast<int>(ends[2]);
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    values.push_back(std::lerp(ends[0], ends[1], count == 1 ? 0.0 : 1.0 * i / (count - 1)));
  }
  return fmt::format("{:.15g}", fmt::join(values, ", "));  // Not 0.8999999999999999.
}

// In single quotes only the quote is special.
std::string QuotedYaml(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

// `LOW:HIGH` to draw from.
std::string Range(const std::string& axis, const std::string& range) {
  const std::vector<double> ends = Numbers(axis, range, true);
  if (ends.size() != 2) FailAxis(axis, true);
  return fmt::format("linear: {{low: {}, high: {}}}", ends[0], ends[1]);
}

// An axis as it stands in a sweep file.
std::string AxisEntry(const std::string& axis, bool drawn) {
  const std::size_t equals = axis.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == axis.size()) {
    FailAxis(axis, drawn);
  }
  const std::string values = axis.substr(equals + 1);
  if (values.find_first_of("[]{}#\n\"'") != std::string::npos) FailAxis(axis, drawn);
  const bool range = values.find(':') != std::string::npos;
  return fmt::format("  - {{field: {}, {}}}\n", QuotedYaml(axis.substr(0, equals)),
                     range && drawn
                         ? Range(axis, values)
                         : fmt::format("values: [{}]", range ? Steps(axis, values) : values));
}

}  // namespace

v1::Sweep OpenSweep(const std::string& path, const VariableValues& variables) {
  return ReadSweep(path, ReadText(path), variables);
}

v1::Sweep ReadSweep(const std::string& path, const std::string& text,
                    const VariableValues& variables) {
  return SweepFile(path, variables).Read(text);
}

v1::Sweep MakeGrid(const std::string& scenario, const std::vector<std::string>& axes,
                   const std::string& metric, const DrawnCells& drawn,
                   const VariableValues& variables) {
  std::string text = fmt::format("base: {}\naxes:\n", QuotedYaml(scenario));
  for (const std::string& axis : axes) text += AxisEntry(axis, drawn.count > 0);
  text += fmt::format("metrics: [{}]\n", QuotedYaml(metric.empty() ? "iterations" : metric));
  if (drawn.count > 0) {
    text +=
        fmt::format("combination: {}\ncount: {}\nseed: {}\n",
                    drawn.latin_hypercube ? "LATIN_HYPERCUBE" : "RANDOM", drawn.count, drawn.seed);
  }
  return ReadSweep("--grid", text, variables);
}

bool IsSweep(const std::string& text) {
  try {
    const YAML::Node root = YAML::Load(text);
    return root.IsMap() && (root["base"].IsDefined() || root["axes"].IsDefined());
  } catch (const YAML::Exception&) {
    return false;
  }
}

}  // namespace contact::cli
