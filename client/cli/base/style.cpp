#include "cli/base/style.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>

#include "base/spelling.h"

namespace contact::cli {
namespace {

bool WantsColor(bool terminal, const std::string& color) {
  if (color != "auto") return color == "always";
  const char* no_color = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  const bool dumb = term != nullptr && std::string_view(term) == "dumb";
  return terminal && !dumb && (no_color == nullptr || *no_color == '\0');
}

// Parameters of the escape sequence of each Tone, in its order.
constexpr std::string_view kCodes[] = {"", "1", "32", "33", "31", "2"};

// The words of a line, each with the spaces that follow it.
std::vector<std::string> Words(std::string_view line) {
  std::vector<std::string> words;
  while (!line.empty()) {
    const std::size_t next = line.find_first_not_of(' ', std::min(line.find(' '), line.size()));
    words.emplace_back(line.substr(0, next));
    line.remove_prefix(words.back().size());
  }
  return words;
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
  return fmt::format("\x1b[{}m{}\x1b[0m", kCodes[static_cast<std::size_t>(tone)], text);
}

int Width(std::string_view text) {
  int width = 0;
  bool painting = false;  // Between escape and m.
  for (const char byte : text) {
    painting = painting || byte == '\x1b';
    const bool follows = (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
    if (!painting && !follows) ++width;
    if (byte == 'm') painting = false;
  }
  return width;
}

std::string TrimRight(std::string text) {
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

std::vector<std::string> Fold(const std::vector<std::string>& parts, int width) {
  std::vector<std::string> lines;
  for (const std::string& part : parts) {
    const bool fits =
        width == 0 || (!lines.empty() && Width(lines.back()) + Width(TrimRight(part)) <= width);
    if (!lines.empty() && fits) {
      lines.back() += part;
    } else {
      lines.push_back(part);
    }
  }
  for (std::string& line : lines) line = TrimRight(std::move(line));
  return lines;
}

std::string Wrap(std::string_view text, const Style& style) {
  if (style.width == 0) return std::string(text);
  std::string wrapped;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    wrapped += fmt::format("{}\n", fmt::join(Fold(Words(line), style.width), "\n"));
  }
  return wrapped;
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

std::string OneLine(std::string_view text, int most) {
  const std::string line = Printable(text, ' ');
  return most > 0 && Width(line) > most ? Cut(line, most - 1) + "…" : line;
}

bool TerminalHasUtf8() {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const char* value = std::getenv(name);
    if (value == nullptr || *value == '\0') continue;
    const std::string_view locale = value;
    return locale.find("UTF-8") != std::string_view::npos ||
           locale.find("utf8") != std::string_view::npos;
  }
  return false;
}

}  // namespace contact::cli
