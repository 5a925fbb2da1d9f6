#include "jobs/read/csv_text.h"

#include <fmt/format.h>

#include <array>
#include <charconv>

#include "jobs/read/frame_values.h"
#include "wire/column_name.h"

namespace contact {
namespace {

using google::protobuf::FieldDescriptor;

void Append(double value, std::string* text) {
  std::array<char, 32> digits{};  // The longest has 24.
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 std::chars_format::general, 17);
  text->append(digits.data(), end.ptr);
}

void Append(const v1::Cycle& cycle, const FieldDescriptor& field, std::string* text) {
  const auto& reflection = *v1::Cycle::GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return Append(reflection.GetDouble(cycle, &field), text);
    case FieldDescriptor::CPPTYPE_ENUM:
      *text += reflection.GetEnum(cycle, &field)->name();
      return;
    case FieldDescriptor::CPPTYPE_INT32:
      *text += fmt::format("{}", reflection.GetInt32(cycle, &field));
      return;
    default:
      *text += reflection.GetString(cycle, &field);  // Names of contacts need no quotes.
  }
}

}  // namespace

std::string CsvHeader(const v1::FrameChunk& chunk) {
  std::string text;
  for (const auto& column : chunk.columns()) {
    text += ColumnHeader(column.name(), column.unit()) + ',';
  }
  text.back() = '\n';
  return text;
}

std::string CsvRows(const v1::FrameChunk& chunk) {
  std::string text;
  for (int row = 0; row < chunk.samples(); ++row) {
    for (const auto& column : chunk.columns()) {
      Append(ValueAt(column, row), &text);
      text += ',';
    }
    text.back() = '\n';
  }
  return text;
}

std::string CyclesCsv(const v1::Job& job) {
  const auto& cycle = *v1::Cycle::descriptor();
  std::string text;
  for (int i = 0; i < cycle.field_count(); ++i) {
    const ColumnName column = ColumnOf(*cycle.field(i));
    text += ColumnHeader(column.name, column.unit) + ',';
  }
  text.back() = '\n';
  for (const v1::Cycle& row : job.cycles()) {
    for (int i = 0; i < cycle.field_count(); ++i) {
      Append(row, *cycle.field(i), &text);
      text += ',';
    }
    text.back() = '\n';
  }
  return text;
}

}  // namespace contact
