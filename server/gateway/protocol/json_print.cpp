#include "gateway/protocol/json_print.h"

#include <fmt/format.h>
#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/time_util.h>

#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <vector>

#include "gateway/protocol/frames.h"

namespace contact::gateway {
namespace {

namespace pb = google::protobuf;
using pb::Descriptor;
using pb::FieldDescriptor;
using pb::Message;
using pb::util::TimeUtil;

// Nanoseconds of a second.
constexpr int kSecond = 1'000'000'000;

bool InRange(const pb::Timestamp& time) {
  return time.seconds() >= TimeUtil::kTimestampMinSeconds &&
         time.seconds() <= TimeUtil::kTimestampMaxSeconds && time.nanos() >= 0 &&
         time.nanos() < kSecond;
}

bool InRange(const pb::Duration& time) {
  const bool one_sign =
      (time.seconds() <= 0 || time.nanos() >= 0) && (time.seconds() >= 0 || time.nanos() <= 0);
  return time.seconds() >= TimeUtil::kDurationMinSeconds &&
         time.seconds() <= TimeUtil::kDurationMaxSeconds && time.nanos() > -kSecond &&
         time.nanos() < kSecond && one_sign;
}

// Prints a message by its descriptor. Of the messages with a JSON of their own it knows the times,
// and leaves others to protobuf. Each function is false if its part has no JSON.
class Printer {
 public:
  bool Print(const Message& message);
  std::string Take() { return std::move(out_); }

 private:
  bool PrintFields(const Message& message);
  bool PrintField(const Message& message, const FieldDescriptor& field);
  bool PrintMap(const Message& message, const FieldDescriptor& field);
  bool PrintList(const Message& message, const FieldDescriptor& field);
  // One value; of a field that is not repeated `index` is kOnly.
  bool PrintValue(const Message& message, const FieldDescriptor& field, int index);
  bool PrintByProtobuf(const Message& message);
  template <class Time>
  bool PrintTime(const Message& message);

  void PrintEnum(const pb::EnumDescriptor& type, int number);
  void PrintBytes(const FieldDescriptor& field, const std::string& bytes);
  void PrintText(const std::string& text);
  template <class Real>
  void PrintReal(Real value);
  template <class Value>
  void Append(const char* format, const Value& value) {
    fmt::format_to(std::back_inserter(out_), fmt::runtime(format), value);
  }

  static constexpr int kOnly = -1;

  std::string out_;
};

bool Printer::Print(const Message& message) {
  switch (message.GetDescriptor()->well_known_type()) {
    case Descriptor::WELLKNOWNTYPE_UNSPECIFIED:
      return PrintFields(message);
    case Descriptor::WELLKNOWNTYPE_TIMESTAMP:
      return PrintTime<pb::Timestamp>(message);
    case Descriptor::WELLKNOWNTYPE_DURATION:
      return PrintTime<pb::Duration>(message);
    default:
      return PrintByProtobuf(message);
  }
}

bool Printer::PrintFields(const Message& message) {
  std::vector<const FieldDescriptor*> fields;
  message.GetReflection()->ListFields(message, &fields);
  out_ += '{';
  bool first = true;
  for (const FieldDescriptor* field : fields) {
    if (field->is_extension()) continue;
    if (!std::exchange(first, false)) out_ += ',';
    PrintText(field->json_name());
    out_ += ':';
    if (!PrintField(message, *field)) return false;
  }
  out_ += '}';
  return true;
}

bool Printer::PrintField(const Message& message, const FieldDescriptor& field) {
  if (field.is_map()) return PrintMap(message, field);
  if (field.is_repeated()) return PrintList(message, field);
  return PrintValue(message, field, kOnly);
}

bool Printer::PrintMap(const Message& message, const FieldDescriptor& field) {
  const pb::Reflection& reflection = *message.GetReflection();
  out_ += '{';
  for (int i = 0; i < reflection.FieldSize(message, &field); ++i) {
    const Message& entry = reflection.GetRepeatedMessage(message, &field, i);
    if (i > 0) out_ += ',';
    const std::size_t start = out_.size();
    if (!PrintValue(entry, *field.message_type()->map_key(), kOnly)) return false;
    if (out_[start] != '"') {  // Keys are texts, also those of numbers.
      out_.insert(start, 1, '"');
      out_ += '"';
    }
    out_ += ':';
    if (!PrintValue(entry, *field.message_type()->map_value(), kOnly)) return false;
  }
  out_ += '}';
  return true;
}

bool Printer::PrintList(const Message& message, const FieldDescriptor& field) {
  const int size = message.GetReflection()->FieldSize(message, &field);
  out_ += '[';
  for (int i = 0; i < size; ++i) {
    if (i > 0) out_ += ',';
    if (!PrintValue(message, field, i)) return false;
  }
  out_ += ']';
  return true;
}

bool Printer::PrintValue(const Message& message, const FieldDescriptor& field, int index) {
  using pb::Reflection;
  const Reflection& of = *message.GetReflection();
  const bool only = index == kOnly;
  const auto get = [&](auto one, auto repeated) {
    return only ? (of.*one)(message, &field) : (of.*repeated)(message, &field, index);
  };
  std::string scratch;
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      Append("{}", get(&Reflection::GetInt32, &Reflection::GetRepeatedInt32));
      break;
    case FieldDescriptor::CPPTYPE_UINT32:
      Append("{}", get(&Reflection::GetUInt32, &Reflection::GetRepeatedUInt32));
      break;
    case FieldDescriptor::CPPTYPE_INT64:
      Append("\"{}\"", get(&Reflection::GetInt64, &Reflection::GetRepeatedInt64));
      break;
    case FieldDescriptor::CPPTYPE_UINT64:
      Append("\"{}\"", get(&Reflection::GetUInt64, &Reflection::GetRepeatedUInt64));
      break;
    case FieldDescriptor::CPPTYPE_DOUBLE:
      PrintReal(get(&Reflection::GetDouble, &Reflection::GetRepeatedDouble));
      break;
    case FieldDescriptor::CPPTYPE_FLOAT:
      PrintReal(get(&Reflection::GetFloat, &Reflection::GetRepeatedFloat));
      break;
    case FieldDescriptor::CPPTYPE_BOOL:
      Append("{}", get(&Reflection::GetBool, &Reflection::GetRepeatedBool));
      break;
    case FieldDescriptor::CPPTYPE_ENUM:
      PrintEnum(*field.enum_type(),
                get(&Reflection::GetEnumValue, &Reflection::GetRepeatedEnumValue));
      break;
    case FieldDescriptor::CPPTYPE_STRING:
      PrintBytes(field, only ? of.GetStringReference(message, &field, &scratch)
                             : of.GetRepeatedStringReference(message, &field, index, &scratch));
      break;
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return Print(only ? of.GetMessage(message, &field)
                        : of.GetRepeatedMessage(message, &field, index));
  }
  return true;
}

bool Printer::PrintByProtobuf(const Message& message) {
  std::string json;
  if (!pb::util::MessageToJsonString(message, &json).ok()) return false;
  out_ += json;
  return true;
}

template <class Time>
bool Printer::PrintTime(const Message& message) {
  const auto& time = *pb::DynamicCastToGenerated<Time>(&message);
  if (!InRange(time)) return false;
  PrintText(TimeUtil::ToString(time));
  return true;
}

void Printer::PrintEnum(const pb::EnumDescriptor& type, int number) {
  const pb::EnumValueDescriptor* value = type.FindValueByNumber(number);
  if (value == nullptr) {
    Append("{}", number);
  } else if (type.full_name() == "google.protobuf.NullValue") {
    out_ += "null";
  } else {
    PrintText(value->name());
  }
}

void Printer::PrintBytes(const FieldDescriptor& field, const std::string& bytes) {
  if (field.type() == FieldDescriptor::TYPE_STRING) {
    PrintText(bytes);
  } else {
    Append("\"{}\"", ToPaddedBase64(bytes));
  }
}

void Printer::PrintText(const std::string& text) {
  out_ += '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') out_ += '\\';
    if (static_cast<unsigned char>(c) < ' ') {
      Append("\\u{:04x}", static_cast<int>(c));
    } else {
      out_ += c;
    }
  }
  out_ += '"';
}

template <class Real>
void Printer::PrintReal(Real value) {
  if (!std::isfinite(value)) {
    out_ += std::isnan(value) ? "\"NaN\"" : value > 0 ? "\"Infinity\"" : "\"-Infinity\"";
    return;
  }
  std::array<char, 32> digits;
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  out_.append(digits.data(), end);
}

}  // namespace

std::optional<std::string> PrintJson(const Message& message) {
  Printer printer;
  if (!printer.Print(message)) return std::nullopt;
  return printer.Take();
}

}  // namespace contact::gateway
