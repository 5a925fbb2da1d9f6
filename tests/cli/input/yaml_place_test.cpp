#include <gmock/gmock.h>

#include "cli/input/yaml_document.h"

namespace contact::cli {
namespace {

constexpr char kDocument[] =
    "title: two\n"
    "bodies:\n"
    "  - name: A\n"
    "    mass_kg: 1\n"
    "  - name: B\n"
    "output: {channels: [a, b]}\n";

// `line:column` of the node for a path, from 1, and `?` if it is not the field itself.
std::string PlaceOf(const std::string& path) {
  const FoundNode found = FindNode(YAML::Load(kDocument), path);
  const YAML::Mark mark = found.node.Mark();
  return fmt::format("{}:{}{}", mark.line + 1, mark.column + 1, found.exact ? "" : "?");
}

TEST(FindNode, FieldsAreFoundWhereTheirValuesBegin) {
  EXPECT_EQ(PlaceOf("title"), "1:8");
  EXPECT_EQ(PlaceOf("bodies"), "3:3");
  EXPECT_EQ(PlaceOf("bodies[0].mass_kg"), "4:14");
  EXPECT_EQ(PlaceOf("bodies[1].name"), "5:11");
  EXPECT_EQ(PlaceOf("output.channels[1]"), "6:24");
}

TEST(FindNode, WhatIsMissingIsToldAtTheInnermostNodeThereIs) {
  EXPECT_EQ(PlaceOf("bodies[1].mass_kg"), "5:5?");
  EXPECT_EQ(PlaceOf("bodies[2]"), "3:3?");
  EXPECT_EQ(PlaceOf("title[0]"), "1:8?");
  EXPECT_EQ(PlaceOf("title.words"), "1:8?");
  EXPECT_EQ(PlaceOf("output.format"), "6:9?");
  EXPECT_EQ(PlaceOf("end_time_s"), "1:1?");
}

TEST(DiagnosticAt, LinesAndColumnsCountFromOne) {
  const YAML::Node root = YAML::Load(kDocument);
  const Diagnostic mistake =
      DiagnosticAt("a.yaml", FindNode(root, "bodies[0].name").node.Mark(), "f", "is x", "y");
  EXPECT_EQ(Format(mistake), "a.yaml:3:11: f: is x — y");
}

TEST(DiagnosticAt, ThereIsNoPlaceInAnEmptyDocument) {
  const Diagnostic mistake = DiagnosticAt("a.yaml", YAML::Mark::null_mark(), "", "is empty", "");
  EXPECT_EQ(Format(mistake), "a.yaml: is empty");
}

}  // namespace
}  // namespace contact::cli
