#include "cli/style.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace contact::cli {
namespace {

bool WantsColor(bool terminal, const std::string& color) {
  if (color != "auto") return color == "always";
  const char* no_color = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  const bool dumb = term != nullptr && std::string_view(term) == "dumb";
  return terminal && !dumb && (no_color == nullptr || *no_color == '\0');
}

std::string_view Code(Tone tone) {
  switch (tone) {
    case Tone::kPlain:
      return "";
    case Tone::kStrong:
      return "1";
    case Tone::kGood:
      return "32";
    case Tone::kWarning:
      return "33";
    case Tone::kBad:
      return "31";
    case Tone::kFaint:
      return "2";
  }
  return "";
}

}  // namespace

Style StyleOf(int descriptor, const std::string& color) {
  Style style;
  style.terminal = isatty(descriptor) == 1;
  style.color = WantsColor(style.terminal, color);
  winsize size = {};
  if (style.terminal && ioctl(descriptor, TIOCGWINSZ, &size) == 0) style.width = size.ws_col;
  return style;
}

std::string Paint(std::string_view text, Tone tone, const Style& style) {
  if (!style.color || tone == Tone::kPlain) return std::string(text);
  return fmt::format("\x1b[{}m{}\x1b[0m", Code(tone), text);
}

int Width(std::string_view text) {
  return static_cast<int>(std::ranges::count_if(
      text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }));
}

std::string Pad(std::string_view text, int width) {
  const std::string spaces(static_cast<std::size_t>(std::max(0, std::abs(width) - Width(text))),
                           ' ');
  return width < 0 ? spaces + std::string(text) : std::string(text) + spaces;
}

std::string Cut(std::string_view text, int width) {
  while (Width(text) > width) text.remove_suffix(1);
  return std::string(text);
}

}  // namespace contact::cli
