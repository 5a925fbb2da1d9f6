#include "cli/text/render_yaml.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <boost/algorithm/string/case_conv.hpp>
#include <cctype>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/spelling.h"

namespace contact::cli {
namespace {

using Json = nlohmann::ordered_json;

bool IsLetter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

// True if some reader may take the text without quotes for a number, a flag, a date or null.
bool NeedsQuotes(const std::string& text) {
  constexpr std::array<std::string_view, 11> kWords = {
      "true", "false", "yes", "no", "on", "off", "y", "n", "null", "nan", "infinity"};
  if (text.empty() || !IsLetter(text.front())) return true;
  return std::ranges::find(kWords, boost::to_lower_copy(text)) != kWords.end();
}

// `1e-08` is a text to readers of YAML 1.1, `1.0e-08` is not.
std::string Number(const Json& value) {
  std::string text = value.dump();
  const std::size_t exponent = text.find('e');
  if (exponent == std::string::npos || text.find('.') != std::string::npos) return text;
  return fmt::format("{}.0{}", text.substr(0, exponent), text.substr(exponent));
}

void Emit(const Json& value, YAML::Emitter* out) {
  if (value.is_object()) {
    *out << (value.empty() ? YAML::Flow : YAML::Block) << YAML::BeginMap;
    for (const auto& [key, entry] : value.items()) {
      *out << YAML::Key;
      Emit(key, out);
      *out << YAML::Value;
      Emit(entry, out);
    }
    *out << YAML::EndMap;
  } else if (value.is_array()) {
    const bool numbers = std::ranges::all_of(value, [](const Json& v) { return v.is_number(); });
    *out << (numbers ? YAML::Flow : YAML::Block) << YAML::BeginSeq;
    for (const Json& entry : value) Emit(entry, out);
    *out << YAML::EndSeq;
  } else if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    if (Printable(text) != text) *out << YAML::EscapeNonAscii << YAML::DoubleQuoted;
    if (NeedsQuotes(text)) *out << YAML::DoubleQuoted;
    *out << text;
  } else if (value.is_null()) {
    *out << YAML::Null;
  } else if (value.is_number()) {
    *out << Number(value);
  } else {
    *out << value.dump();  // true or false
  }
}

}  // namespace

std::string YamlOfJson(const std::string& json) {
  YAML::Emitter out;
  Emit(Json::parse(json), &out);
  return std::string(out.c_str(), out.size()) + "\n";
}

}  // namespace contact::cli
