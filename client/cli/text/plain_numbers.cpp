#include "cli/text/plain_numbers.h"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <system_error>
#include <utility>
#include <vector>

namespace contact::cli {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

// True for a whole number that a double holds exactly, as all up to it.
bool IsExact(std::string_view number) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 53;
  if (number.starts_with('-')) number.remove_prefix(1);
  std::uint64_t value = 0;
  const char* const end = number.data() + number.size();
  const auto [rest, error] = std::from_chars(number.data(), end, value);
  return error == std::errc() && rest == end && value <= kMost;
}

bool Has64Bits(const FieldDescriptor* field) {
  return field != nullptr && (field->cpp_type() == FieldDescriptor::CPPTYPE_INT64 ||
                              field->cpp_type() == FieldDescriptor::CPPTYPE_UINT64);
}

// The place after the text that begins at `begin` with a quote.
std::size_t EndOfText(std::string_view json, std::size_t begin) {
  std::size_t end = begin + 1;
  while (json[end] != '"') end += json[end] == '\\' ? 2 : 1;
  return end + 1;
}

// Copies JSON and knows at each place which field's value stands there.
class Copier {
 public:
  explicit Copier(const Descriptor& message) : root_(&message) {}

  std::string Copy(std::string_view json) {
    for (std::size_t at = 0; at < json.size();) {
      if (json[at] == '"') {
        const std::size_t end = EndOfText(json, at);
        AddText(json.substr(at, end - at), json.substr(end).starts_with(':'));
        at = end;
        continue;
      }
      if (json[at] == '{') objects_.push_back({TypeOfNext(), nullptr});
      if (json[at] == '}') objects_.pop_back();
      copy_ += json[at++];
    }
    return std::move(copy_);
  }

 private:
  // An object that has begun.
  struct Object {
    const Descriptor* type;        // Null: its fields are not known.
    const FieldDescriptor* field;  // That was named last; null: not known.
  };

  // The type of the object that begins; null if it is a map or one of google's.
  const Descriptor* TypeOfNext() const {
    if (objects_.empty()) return root_;
    const FieldDescriptor* field = objects_.back().field;
    if (field == nullptr || field->is_map()) return nullptr;
    const Descriptor* type = field->message_type();
    const bool googles = type != nullptr && type->full_name().starts_with("google.protobuf.");
    return googles ? nullptr : type;
  }

  // Adds a text with its quotes: the name of a field, or a value of the last one.
  void AddText(std::string_view text, bool is_name) {
    Object& object = objects_.back();
    const std::string_view inner = text.substr(1, text.size() - 2);
    if (is_name) {
      const std::string name(inner);
      object.field = object.type == nullptr ? nullptr : object.type->FindFieldByName(name);
    }
    const bool plain = !is_name && Has64Bits(object.field) && IsExact(inner);
    copy_ += plain ? inner : text;
  }

  const Descriptor* const root_;
  std::vector<Object> objects_;
  std::string copy_;
};

}  // namespace

std::string WithPlainNumbers(std::string_view json, const Descriptor& message) {
  return Copier(message).Copy(json);
}

}  // namespace contact::cli
