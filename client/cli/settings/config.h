#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace contact::cli {

/// A value in a config file.
struct ConfigValue {
  /// The value as a flag would have it.
  std::string text;
  /// Where it stands: `path:line`.
  std::string origin;
};

/// The key of the profile in use, as that of the flag --profile.
inline constexpr char kProfileKey[] = "profile";

/// What config files call kProfileKey: TOML does not take `profile = …` beside `[profile.lab]`.
inline constexpr char kUseProfileKey[] = "use_profile";

/// Values by key, such as `server`. The profile in use has the key kProfileKey.
using ConfigSection = std::map<std::string, ConfigValue>;

/// A config file in TOML:
///   use_profile = "lab"
///   server = "127.0.0.1:7070"
///   [profile.lab]
///   server = "lab.example:7070"
struct ConfigFile {
  /// The file, as messages name it.
  std::string path;
  /// Values outside of profiles.
  ConfigSection values;
  /// The values of each profile, by its name.
  std::map<std::string, ConfigSection> profiles;
  /// Where and why the file cannot be read; empty if it can.
  std::string mistake;
};

/// Reads a config file with the content `text`. A key that is not among `keys` is a mistake of the
/// file, as is a value that is no text or whole number. Messages call the file `path`.
ConfigFile ReadConfig(const std::string& path, const std::string& text,
                      const std::vector<std::string_view>& keys);

/// Reads those of ./contact.toml, UserConfigPath() and /etc/contact/config.toml that exist. A value
/// in an earlier file wins over one in a later file.
std::vector<ConfigFile> ReadConfigFiles(const std::vector<std::string_view>& keys);

/// $XDG_CONFIG_HOME/contact/config.toml, or the same in ~/.config; empty without a home.
std::string UserConfigPath();

/// The value of `key` in the section of `profile` of the first file that has it there.
std::optional<ConfigValue> FindInProfile(const std::vector<ConfigFile>& files,
                                         const std::string& key, const std::string& profile);

/// The value of `key` in the first file that has it: in the sections of `profile`, else outside of
/// profiles. An empty `profile` has no sections.
std::optional<ConfigValue> FindValue(const std::vector<ConfigFile>& files, const std::string& key,
                                     const std::string& profile);

/// The content `text` of a config file, changed to have `key = 'value'` in the section of
/// `profile`, or before all sections if `profile` is empty. All other lines stay, comments too.
/// Throws Failure (kLocal) if that cannot be done line by line.
std::string WithValue(const std::string& text, const std::string& profile, const std::string& key,
                      const std::string& value);

}  // namespace contact::cli
