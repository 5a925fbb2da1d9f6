#include "jobs/read/csv_text.h"

#include <fmt/format.h>
#include <google/protobuf/reflection.h>

#include <array>
#include <charconv>
#include <limits>
#include <string_view>
#include <utility>

#include "jobs/read/frame_values.h"
#include "wire/column_name.h"

namespace contact {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

void Append(double value, std::string* text) {
  std::array<char, 32> digits{};  // The longest has 24.
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 std::chars_format::general, 17);
  text->append(digits.data(), end.ptr);
}

// Of a list of numbers all, with spaces between them.
void AppendEach(const Message& row, const FieldDescriptor& list, std::string* text) {
  std::string_view space;
  for (const double value : row.GetReflection()->GetRepeatedFieldRef<double>(row, &list)) {
    *text += std::exchange(space, " ");
    Append(value, text);
  }
}

void Append(const Message& row, const FieldDescriptor& field, std::string* text) {
  if (field.is_repeated()) return AppendEach(row, field, text);
  const auto& reflection = *row.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      if (field.has_presence() && !reflection.HasField(row, &field))
        return Append(std::numeric_limits<double>::quiet_NaN(), text);
      return Append(reflection.GetDouble(row, &field), text);
    case FieldDescriptor::CPPTYPE_ENUM:
      *text += reflection.GetEnum(row, &field)->name();
      return;
    case FieldDescriptor::CPPTYPE_INT32:
      *text += fmt::format("{}", reflection.GetInt32(row, &field));
      return;
    case FieldDescriptor::CPPTYPE_BOOL:
      *text += reflection.GetBool(row, &field) ? '1' : '0';
      return;
    default:
      *text += reflection.GetString(row, &field);  // Names of contacts need no quotes.
  }
}

// A header, and a line for each entry.
template <class Row>
std::string Table(const google::protobuf::RepeatedPtrField<Row>& rows) {
  const auto& type = *Row::descriptor();
  std::string text;
  for (int i = 0; i < type.field_count(); ++i) {
    const ColumnName column = ColumnOf(*type.field(i));
    text += ColumnHeader(column.name, column.unit) + ',';
  }
  text.back() = '\n';
  for (const Row& row : rows) {
    for (int i = 0; i < type.field_count(); ++i) {
      Append(row, *type.field(i), &text);
      text += ',';
    }
    text.back() = '\n';
  }
  return text;
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

std::string CyclesCsv(const v1::Job& job) { return Table(job.cycles()); }

std::string GroupsCsv(const v1::Job& job) { return Table(job.groups()); }

}  // namespace contact
