#include "cli/input/file_table.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/spelling.h"
#include "cli/base/scalar.h"
#include "cli/base/unit.h"
#include "cli/input/yaml_document.h"
#include "wire/column_name.h"
#include "wire/rules/field_path.h"

namespace contact::cli {
namespace {

using google::protobuf::FieldDescriptor;

constexpr char kTimes[] = "times_s";

void Store(const std::vector<double>& numbers, const FieldDescriptor& field,
           google::protobuf::Message* message) {
  const auto* reflection = message->GetReflection();
  reflection->ClearField(message, &field);
  for (const double number : numbers) reflection->AddDouble(message, &field, number);
}

}  // namespace

// One mapping with the key `file`.
class FileTables::Request {
 public:
  Request(FileTables& all, const YAML::Node& node, const std::string& path,
          const YamlReader::Report& report)
      : all_(all), node_(node), path_(path), report_(report) {}

  void Read(google::protobuf::Message* message) {
    const FieldDescriptor& of_values = *TableValues(*message->GetDescriptor());
    std::optional<MeasuredTable> table = Open();
    if (!table) return;
    const auto times = TimeColumn(*table);
    const auto values = times ? ValueColumn(*table, *times) : std::nullopt;
    if (!times || !values) return;
    const double shift = Number("shift_s", 0);
    std::vector<double> t = Numbers(*table, *times, "time_unit", "s", 1);
    for (double& time : t) time += shift;
    const std::string unit(ColumnOf(of_values).unit);
    std::vector<double> v = Numbers(*table, *values, "unit", unit, Number("scale", 1));
    for (const Diagnostic& mistake : mistakes_) Add(mistake);
    if (failed_) return;
    const double first = t.front();
    Store(t, *message->GetDescriptor()->FindFieldByName(kTimes), message);
    Store(v, of_values, message);
    all_.sources_.insert_or_assign(path_, Source{std::move(*table), *times, *values, first});
  }

 private:
  // The node of a key; undefined if it has no value.
  YAML::Node Find(const std::string& key) const {
    const FoundNode found = FindNode(node_, key);
    return found.exact && !found.node.IsNull() ? found.node : YAML::Node(YAML::NodeType::Undefined);
  }

  void Refuse(const std::string& key, const std::string& what, const std::string& hint = {}) {
    failed_ = true;
    const FoundNode found = FindNode(node_, key);
    report_(found.node.Mark(), JoinPath(path_, key), what, hint);
  }

  std::string Text(const std::string& key) {
    const YAML::Node value = Find(key);
    if (!value.IsDefined()) return "";
    if (!value.IsScalar()) Refuse(key, "expected a text");
    return value.IsScalar() ? value.Scalar() : "";
  }

  double Number(const std::string& key, double usual) {
    const YAML::Node value = Find(key);
    if (!value.IsDefined()) return usual;
    const auto number = value.IsScalar() ? ParseNumber(value.Scalar()) : std::nullopt;
    if (number && std::isfinite(*number)) return *number;
    Refuse(key, "expected a number");
    return usual;
  }

  std::optional<MeasuredTable> Open() {
    const std::string name = Text("file");
    std::optional<int> skip;
    if (const YAML::Node lines = Find("skip"); lines.IsDefined()) {
      skip = lines.IsScalar() ? ParseInteger<int>(lines.Scalar()) : std::nullopt;
      if (!skip || *skip < 0) Refuse("skip", "expected a number of lines");
    }
    if (name.empty() && !failed_) Refuse("file", "is missing", "give the name of a file");
    if (failed_) return std::nullopt;
    try {
      return MeasuredTable::Open((std::filesystem::path(all_.folder_) / name).string(), skip);
    } catch (const InvalidFile& invalid) {
      for (const Diagnostic& mistake : invalid.mistakes()) Add(mistake);
    } catch (const Failure& failure) {
      Refuse("file", failure.what(), "the name counts from the folder of this file");
    }
    return std::nullopt;
  }

  // A mistake in the file itself.
  void Add(Diagnostic mistake) {
    failed_ = true;
    mistake.field = path_;
    all_.mistakes_.push_back(std::move(mistake));
  }

  // The column that a key names; nothing if there is none, which is reported.
  std::optional<std::size_t> Column(const MeasuredTable& table, const std::string& key) {
    const std::string name = Text(key);
    const auto& columns = table.columns();
    const auto found = std::ranges::find_if(
        columns, [&](const auto& c) { return c.header == name || c.name == name; });
    if (found != columns.end()) return static_cast<std::size_t>(found - columns.begin());
    const auto number = ParseInteger<int>(name);
    if (number && *number >= 1 && *number <= std::ssize(columns)) {
      return static_cast<std::size_t>(*number - 1);
    }
    Refuse(key, fmt::format("{} has no column {}", table.source(), Quoted(name)),
           fmt::format("it has {}", table.Headers()));
    return std::nullopt;
  }

  std::optional<std::size_t> TimeColumn(const MeasuredTable& table) {
    if (Find("time_column").IsDefined()) return Column(table, "time_column");
    return table.TimeColumn().value_or(0);
  }

  std::optional<std::size_t> ValueColumn(const MeasuredTable& table, std::size_t times) {
    if (Find("column").IsDefined()) return Column(table, "column");
    return times == 0 ? 1 : 0;
  }

  // The numbers of a column in SI times `scale`.
  std::vector<double> Numbers(const MeasuredTable& table, std::size_t column,
                              const std::string& key, const std::string& si, double scale) {
    const std::optional<double> factor = Factor(table, column, key, si);
    std::vector<double> numbers = table.Numbers(column, MeasuredTable::Gap::kMistake, &mistakes_);
    if (factor) {
      for (double& number : numbers) number = InSi(number, *factor) * scale;
    }
    return numbers;
  }

  // The factor of the unit of a column: that of `key`, of its header, of what follows the last _ of
  // its name, or 1, which is told. Reports one that is none of this quantity.
  std::optional<double> Factor(const MeasuredTable& table, std::size_t index,
                               const std::string& key, const std::string& si) {
    const MeasuredColumn& column = table.columns()[index];
    const std::string given = Text(key);
    const std::string& unit = given.empty() ? column.unit : given;
    if (!unit.empty()) {
      const auto factor = UnitFactor(unit, si);
      if (!factor) {
        Refuse(given.empty() ? "file" : key,
               fmt::format("{} is no unit of a quantity in {}{}", Quoted(unit), si,
                           given.empty() ? fmt::format("; column {} of {} has it",
                                                       Quoted(column.header), table.source())
                                         : ""),
               fmt::format("{}: one of {}", key, UsualUnits(si)));
      }
      return factor;
    }
    const auto named = UnitFactor(column.name.substr(column.name.rfind('_') + 1), si);
    if (named && column.name.find('_') != std::string::npos) return named;
    all_.advice_.push_back(table.At(0, index,
                                    fmt::format("nothing tells the unit of {}; {} is taken",
                                                key == "unit" ? "the values" : "the times", si),
                                    fmt::format("{}: {} in the scenario says so", key, si)));
    all_.advice_.back().field = path_;
    return 1;
  }

  FileTables& all_;
  const YAML::Node& node_;
  const std::string& path_;
  const YamlReader::Report& report_;
  std::vector<Diagnostic> mistakes_;  // In both columns.
  bool failed_ = false;
};

void FileTables::Read(const YamlReader::Report& report, const YAML::Node& node,
                      const std::string& path, google::protobuf::Message* message) {
  Request(*this, node, path, report).Read(message);
}

std::optional<Diagnostic> FileTables::Place(const Violation& violation) const {
  const std::vector<PathStep> steps = ParsePath(violation.field);
  if (steps.empty() || !steps.back().index) return std::nullopt;
  const auto source = sources_.find(std::string(ParentPath(violation.field)));
  if (source == sources_.end()) return std::nullopt;
  const auto& [table, times, values, first_time] = source->second;
  const bool is_time = steps.back().name == kTimes;
  const auto row = static_cast<std::size_t>(*steps.back().index);
  if (row >= table.rows()) return std::nullopt;
  std::string hint = violation.hint;
  if (is_time && hint.empty() && first_time < 0) {
    hint = fmt::format("shift_s: {} lets the table begin at 0", -first_time);
  }
  Diagnostic placed = table.At(row, is_time ? times : values, violation.description, hint);
  placed.field = source->first;
  return placed;
}

}  // namespace contact::cli
