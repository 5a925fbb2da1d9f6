#include "cli/input/yaml_document.h"

#include <yaml-cpp/eventhandler.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <sstream>
#include <utility>
#include <vector>

#include "cli/base/files.h"
#include "wire/rules/field_path.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostYamlBytes = 16 << 20;
constexpr std::int64_t kMostValues = 1'000'000;

// Counts the values of a text while it is parsed, before anything is made of them.
class ValueCounter final : public YAML::EventHandler {
 public:
  // Where the first value stands, since the last Forget.
  const std::optional<YAML::Mark>& begin() const { return begin_; }
  void Forget() { begin_.reset(); }

  void OnDocumentStart(const YAML::Mark& /*mark*/) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { One(mark, anchor); }
  void OnScalar(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                const std::string& /*value*/) override {
    One(mark, anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Add(mark, values_[anchor]);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    Begin(mark, anchor);
  }
  void OnSequenceEnd() override { End(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    Begin(mark, anchor);
  }
  void OnMapEnd() override { End(); }

 private:
  struct Open {
    YAML::anchor_t anchor;
    std::int64_t before;  // Values before it.
  };

  void Add(const YAML::Mark& mark, std::int64_t values) {
    if (!begin_) begin_ = mark;
    total_ += values;
    if (total_ > kMostValues) throw YAML::ParserException(mark, "more than a million values");
  }
  void One(const YAML::Mark& mark, YAML::anchor_t anchor) {
    Add(mark, 1);
    if (anchor != 0) values_[anchor] = 1;
  }
  void Begin(const YAML::Mark& mark, YAML::anchor_t anchor) {
    open_.push_back({anchor, total_});
    Add(mark, 1);
  }
  void End() {
    if (open_.back().anchor != 0) values_[open_.back().anchor] = total_ - open_.back().before;
    open_.pop_back();
  }

  std::optional<YAML::Mark> begin_;
  std::int64_t total_ = 0;
  std::vector<Open> open_;                         // Lists and mappings around the next value.
  std::map<YAML::anchor_t, std::int64_t> values_;  // Of what has an anchor.
};

YAML::Node Child(const YAML::Node& node, const std::string& name) {
  if (!node.IsMap()) return YAML::Node(YAML::NodeType::Undefined);
  for (const auto& entry : node) {
    if (entry.first.IsScalar() && entry.first.Scalar() == name) return entry.second;
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

FoundNode Find(const YAML::Node& node, std::span<const PathStep> path) {
  if (path.empty()) return {node, true};
  const YAML::Node child = Child(node, path.front().name);
  if (!child.IsDefined()) return {node, false};
  if (!path.front().index) return Find(child, path.subspan(1));
  const auto index = static_cast<std::size_t>(*path.front().index);
  if (!child.IsSequence() || index >= child.size()) return {child, false};
  return Find(child[index], path.subspan(1));
}

}  // namespace

std::string ReadYaml(const std::string& path) { return ReadText(path, kMostYamlBytes); }

// YAML::LoadAll would find a second document too, but of some texts, such as `{},`, yaml-cpp 0.7
// finds documents without end.
YamlText LoadYaml(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  ValueCounter counter;
  std::optional<YAML::Mark> second;
  if (parser.HandleNextDocument(counter)) {
    counter.Forget();
    if (parser.HandleNextDocument(counter)) second = counter.begin();
  }
  return {YAML::Load(text), second};
}

std::string JoinPath(const std::string& path, const std::string& name) {
  return path.empty() ? name : path + "." + name;
}

FoundNode FindNode(const YAML::Node& root, const std::string& path) {
  return Find(root, ParsePath(path));
}

std::string WordsOf(const Violation& violation, bool given) {
  constexpr std::string_view kMissing = "is missing";
  const std::string& words = violation.description;
  const bool is_zero = given && words.starts_with("is missing; must be ");
  return is_zero ? "is 0" + words.substr(kMissing.size()) : words;
}

Diagnostic DiagnosticAt(std::string source, const YAML::Mark& mark, std::string field,
                        std::string what, std::string hint) {
  return {.source = std::move(source),
          .line = mark.line + 1,
          .column = mark.column + 1,
          .field = std::move(field),
          .what = std::move(what),
          .hint = std::move(hint)};
}

Diagnostic DiagnosticIn(const YAML::Node& root, std::string source, const Violation& violation) {
  const FoundNode found = FindNode(root, violation.field);
  return DiagnosticAt(std::move(source), found.node.Mark(), violation.field,
                      WordsOf(violation, found.exact), violation.hint);
}

}  // namespace contact::cli
