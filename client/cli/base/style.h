#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace contact::cli {

/// What a text means, which decides on its colour.
enum class Tone { kPlain, kStrong, kGood, kWarning, kBad, kFaint };

/// How progress of a job is shown.
enum class ProgressForm {
  kNone,
  kBar,    ///< One line that is redrawn.
  kLines,  ///< A line for each tenth of the work.
  kJson,   ///< An object a line, for programs.
};

/// How to write to a stream.
struct Style {
  /// True if the stream is a terminal.
  bool terminal = false;
  /// True if Paint colours texts.
  bool color = false;
  /// Width of the terminal in characters; 0: no limit.
  int width = 0;
  /// True if tables show the columns that only wide tables have.
  bool wide = false;
  /// Tables show only the columns with these names, in this order; empty: all.
  std::vector<std::string> columns = {};
};

/// The style of an open file descriptor. `color` is auto, always or never; auto is in colour on
/// a terminal, unless NO_COLOR is set or TERM is dumb.
Style StyleOf(int descriptor, const std::string& color);

/// The text in the colour of its tone; the text itself without colour.
std::string Paint(std::string_view text, Tone tone, const Style& style);

/// Width of UTF-8 text in columns: one a character, none for the sequences of Paint.
int Width(std::string_view text);

/// The text without spaces at its end.
std::string TrimRight(std::string text);

/// Joins parts to lines of at most `width` characters (0: no limit); a longer part has a line of
/// its own.
std::vector<std::string> Fold(const std::vector<std::string>& parts, int width);

/// Breaks lines that are longer than the terminal is wide, between words.
std::string Wrap(std::string_view text, const Style& style);

/// `text` followed, or preceded for a negative width, by spaces up to |width| characters.
std::string Pad(std::string_view text, int width);

/// The first `width` characters of a text without colour.
std::string Cut(std::string_view text, int width);

/// A text of a user in one line without control characters, which would spoil a table; of more than
/// `most` characters (0: no limit) the first, and `…`.
std::string OneLine(std::string_view text, int most = 0);

/// True if the environment says that the terminal shows UTF-8.
bool TerminalHasUtf8();

}  // namespace contact::cli
