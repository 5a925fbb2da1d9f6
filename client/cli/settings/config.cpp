#include "cli/settings/config.h"

#define TOML_ENABLE_FORMATTERS 0
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "base/spelling.h"
#include "cli/base/failure.h"
#include "cli/base/files.h"

namespace contact::cli {
namespace {

// Reads the tables of one file, up to its first mistake.
class Reader {
 public:
  Reader(const std::vector<std::string_view>& keys, ConfigFile* file) : keys_(keys), file_(file) {}

  void Read(const toml::table& root) {
    for (const auto& [key, value] : root) {
      const toml::table* profiles = value.as_table();
      if (key == kProfileKey && profiles != nullptr) {
        ReadProfiles(*profiles);
      } else if (key == kProfileKey) {
        Refuse(value, fmt::format("a profile is a section, [profile.NAME]; {} chooses one",
                                  kUseProfileKey));
      } else if (key == kUseProfileKey) {
        ReadValue(kProfileKey, value, &file_->values);
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

std::string Trimmed(const std::string& line) {
  return boost::trim_copy_if(line, boost::is_any_of(" \t\r"));
}

// The key that a line sets; empty for other lines.
std::string KeyOf(const std::string& line) {
  const std::size_t equals = line.find('=');
  return equals == std::string::npos ? "" : Trimmed(line.substr(0, equals));
}

bool IsSection(const std::string& line) { return Trimmed(line).starts_with('['); }

// The line after the header of the section of `profile`, which is added at the end if missing.
std::vector<std::string>::iterator BeginOf(const std::string& profile,
                                           std::vector<std::string>* lines) {
  const std::string header = fmt::format("[profile.{}]", profile);
  auto begin = std::ranges::find(*lines, header, Trimmed);
  if (begin == lines->end()) {
    if (!lines->empty()) lines->emplace_back();
    lines->push_back(header);
    begin = lines->end() - 1;
  }
  return begin + 1;
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

std::optional<ConfigValue> FindInProfile(const std::vector<ConfigFile>& files,
                                         const std::string& key, const std::string& profile) {
  for (const ConfigFile& file : files) {
    const auto section = file.profiles.find(profile);
    if (profile.empty() || section == file.profiles.end()) continue;
    const auto found = section->second.find(key);
    if (found != section->second.end()) return found->second;
  }
  return std::nullopt;
}

std::optional<ConfigValue> FindValue(const std::vector<ConfigFile>& files, const std::string& key,
                                     const std::string& profile) {
  if (const auto value = FindInProfile(files, key, profile)) return value;
  for (const ConfigFile& file : files) {
    const auto found = file.values.find(key);
    if (found != file.values.end()) return found->second;
  }
  return std::nullopt;
}

std::string WithValue(const std::string& text, const std::string& profile, const std::string& key,
                      const std::string& value) {
  std::vector<std::string> lines = LinesOf(text);
  const std::string name = key == kProfileKey ? kUseProfileKey : key;
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
  std::string changed = fmt::format("{}\n", fmt::join(lines, "\n"));
  const ConfigFile file = ReadConfig("the changed file", changed, {key, kProfileKey});
  const auto now = FindValue({file}, key, profile);
  const bool other_keys = file.mistake.find("unknown key") != std::string::npos;
  if ((!file.mistake.empty() && !other_keys) || !now || now->text != value) {
    throw Failure(ExitCode::kLocal, "cannot change it line by line; edit the file by hand");
  }
  return changed;
}

}  // namespace contact::cli
