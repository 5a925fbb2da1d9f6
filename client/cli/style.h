#pragma once

#include <string>
#include <string_view>

namespace contact::cli {

enum class Tone { kPlain, kStrong, kGood, kWarning, kBad, kFaint };

/// How to write to a stream.
struct Style {
  bool terminal = false;  ///< Someone looks at it live.
  bool color = false;
  int width = 0;  ///< Characters in a line; 0: no limit.
};

/// The style of an open file descriptor. `color` is auto, always or never; auto is in colour on
/// a terminal, unless NO_COLOR is set or TERM is dumb.
Style StyleOf(int descriptor, const std::string& color);

std::string Paint(std::string_view text, Tone tone, const Style& style);

/// Characters of UTF-8 text, each taken as one column wide.
int Width(std::string_view text);

/// `text` followed, or preceded for a negative width, by spaces up to |width| characters.
std::string Pad(std::string_view text, int width);

/// The first `width` characters.
std::string Cut(std::string_view text, int width);

}  // namespace contact::cli
