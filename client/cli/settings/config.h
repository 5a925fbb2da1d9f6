#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace contact::cli {

/// A value in a config file.
struct ConfigValue {
  std::string text;
  std::string origin;  ///< `path:line`.
};

/// Values by key, such as `server`; that of `use_profile` is `profile`.
using ConfigSection = std::map<std::string, ConfigValue>;

/// A config file in TOML:
///   use_profile = "lab"
///   server = "127.0.0.1:7070"
///   [profile.lab]
///   server = "lab.example:7070"
struct ConfigFile {
  std::string path;
  ConfigSection values;
  std::map<std::string, ConfigSection> profiles;
  std::string mistake;  ///< Where and why it cannot be read; empty if it can.
};

/// Reads `text`, whose keys must be among `keys`. `path` is what mistakes call it.
ConfigFile ReadConfig(const std::string& path, const std::string& text,
                      const std::vector<std::string_view>& keys);

/// The files that there are among ./contact.toml, config.toml of the user and of the system. What
/// an earlier one says wins.
std::vector<ConfigFile> ReadConfigFiles(const std::vector<std::string_view>& keys);

/// $XDG_CONFIG_HOME/contact/config.toml, or the same in ~/.config; empty without a home.
std::string UserConfigPath();

/// The value of `key`, first in the sections of `profile`, then outside of profiles. None for an
/// empty `profile` in the former.
std::optional<ConfigValue> FindValue(const std::vector<ConfigFile>& files, const std::string& key,
                                     const std::string& profile);

/// `text` with `key = "value"` in the section of `profile`, or before all sections if that is
/// empty; all else, comments too, is as it was. Throws Failure (kLocal) where that cannot be done
/// line by line.
std::string WithValue(const std::string& text, const std::string& profile, const std::string& key,
                      const std::string& value);

}  // namespace contact::cli
