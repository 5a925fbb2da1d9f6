#include "cli/settings/config.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include "base/spelling.h"
#include "cli/base/failure.h"
#include "cli/base/text_file.h"

namespace contact::cli {
namespace {

constexpr char kProfile[] = "profile";
constexpr char kUse[] = "use_profile";  // TOML has no room for both profile = and [profile.lab].

// Reads the tables of one file, up to its first mistake.
class Reader {
 public:
  Reader(const std::vector<std::string_view>& keys, ConfigFile* file) : keys_(keys), file_(file) {}

  void Read(const toml::table& root) {
    for (const auto& [key, value] : root) {
      const toml::table* profiles = value.as_table();
      if (key == kProfile && profiles != nullptr) {
        ReadProfiles(*profiles);
      } else if (key == kProfile) {
        Refuse(value, fmt::format("a profile is a section, [profile.NAME]; {} chooses one", kUse));
      } else if (key == kUse) {
        ReadValue(kProfile, value, &file_->values);
      } else {
        ReadValue(std::string(key.str()), value, &file_->values);
      }
    }
  }

 private:
  void ReadProfiles(const toml::table& profiles) {
    for (const auto& [name, section] : profiles) {
      ConfigSection& values = file_->profiles[std::string(name.str())];
      const toml::table* table = section.as_table();
      if (table == nullptr) return Refuse(section, "a profile is a section, [profile.NAME]");
      for (const auto& [key, value] : *table) ReadValue(std::string(key.str()), value, &values);
    }
  }

  void ReadValue(const std::string& key, const toml::node& value, ConfigSection* section) {
    if (std::ranges::find(keys_, key) == keys_.end()) {
      return Refuse(value,
                    WithHint(fmt::format("unknown key {}", Quoted(key)), DidYouMean(key, keys_)));
    }
    const std::string origin = fmt::format("{}:{}", file_->path, value.source().begin.line);
    if (const auto text = value.value_exact<std::string>()) {
      (*section)[key] = {*text, origin};
    } else if (const auto number = value.value_exact<int64_t>()) {
      (*section)[key] = {fmt::format("{}", *number), origin};
    } else {
      Refuse(value, fmt::format("{} must be a text, such as {} = \"…\"", key, key));
    }
  }

  void Refuse(const toml::node& node, const std::string& what) {
    if (!file_->mistake.empty()) return;
    const toml::source_position place = node.source().begin;
    file_->mistake = fmt::format("{}:{}:{}: {}", file_->path, place.line, place.column, what);
  }

  const std::vector<std::string_view>& keys_;
  ConfigFile* file_;
};

// The key that a line sets; empty for other lines.
std::string KeyOf(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(" \t");
  const std::size_t end = line.find_first_of(" \t=", begin);
  const std::size_t equals = line.find('=');
  if (begin == std::string::npos || equals == std::string::npos || end > equals) return "";
  return line.substr(begin, end - begin);
}

bool IsSection(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(" \t");
  return begin != std::string::npos && line[begin] == '[';
}

std::string Trimmed(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return "";
  return line.substr(begin, line.find_last_not_of(" \t\r") + 1 - begin);
}

using Lines = std::vector<std::string>;

Lines LinesOf(const std::string& text) {
  Lines lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The line after the header of the section of `profile`, which is added at the end if missing.
Lines::iterator BeginOf(const std::string& profile, Lines* lines) {
  const std::string header = fmt::format("[profile.{}]", profile);
  auto begin = std::ranges::find(*lines, header, Trimmed);
  if (begin == lines->end()) {
    if (!lines->empty()) lines->emplace_back();
    lines->push_back(header);
    begin = lines->end() - 1;
  }
  return begin + 1;
}

std::string Joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace

ConfigFile ReadConfig(const std::string& path, const std::string& text,
                      const std::vector<std::string_view>& keys) {
  ConfigFile file;
  file.path = path;
  try {
    Reader(keys, &file).Read(toml::parse(text, path));
  } catch (const toml::parse_error& error) {
    const toml::source_position place = error.source().begin;
    file.mistake = fmt::format("{}:{}:{}: {}", path, place.line, place.column, error.description());
  }
  return file;
}

std::vector<ConfigFile> ReadConfigFiles(const std::vector<std::string_view>& keys) {
  std::vector<ConfigFile> files;
  for (const std::string& path :
       {std::string("contact.toml"), UserConfigPath(), std::string("/etc/contact/config.toml")}) {
    if (path.empty() || !std::filesystem::is_regular_file(path)) continue;
    try {
      files.push_back(ReadConfig(path, ReadText(path), keys));
    } catch (const Failure& failure) {
      files.push_back({.path = path, .values = {}, .profiles = {}, .mistake = failure.what()});
    }
  }
  return files;
}

std::string UserConfigPath() {
  constexpr char kFile[] = "contact/config.toml";
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config != nullptr && *config == '/') return std::filesystem::path(config) / kFile;
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home == '/') return std::filesystem::path(home) / ".config" / kFile;
  return "";
}

std::optional<ConfigValue> FindValue(const std::vector<ConfigFile>& files, const std::string& key,
                                     const std::string& profile) {
  for (const ConfigFile& file : files) {
    const auto section = file.profiles.find(profile);
    if (profile.empty() || section == file.profiles.end()) continue;
    const auto found = section->second.find(key);
    if (found != section->second.end()) return found->second;
  }
  for (const ConfigFile& file : files) {
    const auto found = file.values.find(key);
    if (found != file.values.end()) return found->second;
  }
  return std::nullopt;
}

std::string WithValue(const std::string& text, const std::string& profile, const std::string& key,
                      const std::string& value) {
  std::vector<std::string> lines = LinesOf(text);
  const std::string name = key == kProfile ? kUse : key;
  const char quote = value.find('\'') == std::string::npos ? '\'' : '"';
  const std::string setting = fmt::format("{} = {}{}{}", name, quote, value, quote);
  const auto begin = profile.empty() ? lines.begin() : BeginOf(profile, &lines);
  const auto end = std::find_if(begin, lines.end(), IsSection);
  const auto old = std::ranges::find(begin, end, name, KeyOf);
  if (old != end) {
    *old = setting;
  } else {
    auto last = end;  // After the values of the section, before the blank lines.
    while (last != begin && Trimmed(*(last - 1)).empty()) --last;
    lines.insert(last, setting);
  }
  const std::string changed = Joined(lines);
  const ConfigFile file = ReadConfig("the changed file", changed, {key, kProfile});
  const auto now = FindValue({file}, key, profile);
  const bool other_keys = file.mistake.find("unknown key") != std::string::npos;
  if ((!file.mistake.empty() && !other_keys) || !now || now->text != value) {
    throw Failure(ExitCode::kLocal, "cannot change it line by line; edit the file by hand");
  }
  return changed;
}

}  // namespace contact::cli
