#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace contact::cli {

/// The output formats. Each is a row of formats.def, which says all else about it: a new format
/// needs its row, its writer, a test and a line of the README, and no other change.
enum class OutputFormat {
#define FORMAT(enumerator, name, ending, uses, about) enumerator,
#include "cli/settings/formats.def"
};

/// What a format is for; a format may have several uses.
enum FormatUse : unsigned {
  kPrinted = 1,  ///< Commands print it to the standard output.
  kData = 2,     ///< `export` writes the numbers of a job in it.
  kFigure = 4,   ///< `plot` draws in it.
};

/// One row of the registry.
struct FormatInfo {
  /// The format that the row describes.
  OutputFormat format;
  /// The value of -o.
  std::string_view name;
  /// How its files end, with the dot; empty: no file name tells the format.
  std::string_view ending;
  /// Bits of FormatUse.
  unsigned uses;
  /// What it is, for the help; empty if the name says it.
  std::string_view about;
};

/// All formats, in the order of formats.def.
const std::vector<FormatInfo>& Formats();

/// The row of a format.
const FormatInfo& InfoOf(OutputFormat format);

/// The name of a format, such as `netcdf`.
inline std::string_view NameOf(OutputFormat format) { return InfoOf(format).name; }

/// The format with this name; none if there is no such format.
std::optional<OutputFormat> FindFormat(std::string_view name);

/// The format that the ending of a file name tells, in small or capital letters, among those with
/// this use; none if the ending belongs to no such format.
std::optional<OutputFormat> FormatOfFile(const std::string& path, FormatUse use);

/// The same, but `standard` for a name without ending. Throws Failure (kUsage), which lists the
/// endings, for an ending of no such format: its file would not be what its name says.
OutputFormat RequireFormatOfFile(const std::string& path, FormatUse use, OutputFormat standard);

/// The names of the formats that have one of these uses (bits of FormatUse).
std::vector<std::string> FormatNames(unsigned uses);

/// The names of the formats with this use and what they are, with commas between, for the help.
std::string FormatHelp(FormatUse use);

/// The endings of the files of this use, with commas between, for the help.
std::string FormatEndings(FormatUse use);

}  // namespace contact::cli
