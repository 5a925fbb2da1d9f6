#pragma once

#include <string>

namespace contact::cli {

/// The content `text` of a config file, changed to have `key = 'value'` in the section of
/// `profile`, or before all sections if `profile` is empty. All other lines stay, comments too.
/// Throws Failure (kLocal) if that cannot be done line by line.
std::string WithValue(const std::string& text, const std::string& profile, const std::string& key,
                      const std::string& value);

}  // namespace contact::cli
