#include "cli/input/table_dialect.h"

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <boost/locale/encoding_utf.hpp>
#include <map>
#include <optional>

#include "cli/base/scalar.h"

namespace contact::cli {
namespace {

constexpr std::string_view kSeparators = "\t;, ";  // Earlier ones first, where several fit.
constexpr std::size_t kMostLooks = 1000;           // Lines that are looked at.

bool IsComment(std::string_view line) { return line.starts_with('#'); }

bool IsBlank(std::string_view line) {
  return line.find_first_not_of(" \t\r") == std::string_view::npos;
}

// 'n' for a number, 'g' for a gap, 't' for a text.
char KindOf(const std::string& text, char separator) {
  double number = 0;
  if (IsGap(text)) return 'g';
  if (ReadField(text, false, &number)) return 'n';
  return separator != ',' && ReadField(text, true, &number) ? 'n' : 't';
}

std::string KindsOf(std::string_view line, char separator) {
  std::string kinds;
  for (const TableField& field : AllFieldsOf(line, separator)) {
    kinds += KindOf(field.text, separator);
  }
  return kinds;
}

// Whether all that `kinds` has after the fields of a row is empty.
bool EndsAs(const std::string& row, const std::string& kinds) {
  return kinds.find_first_not_of('g', row.size()) == std::string::npos;
}

// Whether a line is a row of these kinds. It may end early, or with empty fields.
bool Fits(const std::string& kinds, const std::string& row) {
  if (kinds.size() < 2 || !EndsAs(row, kinds)) return false;
  for (std::size_t i = 0; i < std::min(kinds.size(), row.size()); ++i) {
    if (kinds[i] != 'g' && kinds[i] != row[i]) return false;
  }
  return kinds.find('n') != std::string::npos;
}

// Whether a line has a number where rows have their first one, so that it is no header.
bool BeginsAs(const std::string& row, const std::string& kinds) {
  const std::size_t number = row.find('n');
  return kinds.size() >= 2 && kinds.size() > number && kinds[number] == 'n';
}

// Whether a line is a row with a mistake.
bool IsAlmostARow(const std::string& kinds, const std::string& row) {
  return BeginsAs(row, kinds) && kinds.size() >= row.size() && EndsAs(row, kinds);
}

// The lines from `first` on that may be rows.
std::vector<std::size_t> Candidates(std::span<const std::string_view> lines, std::size_t first) {
  std::vector<std::size_t> found;
  for (std::size_t i = first; i < lines.size(); ++i) {
    if (!IsBlank(lines[i]) && !IsComment(lines[i])) found.push_back(i);
  }
  return found;
}

// What most lines of the second half are with this separator; empty: no rows.
std::string MostCommonKinds(std::span<const std::string_view> lines,
                            std::span<const std::size_t> candidates, char separator) {
  std::map<std::string, int> counts;
  const std::size_t half = candidates.size() / 2;
  const std::size_t stride = (candidates.size() - half) / kMostLooks + 1;
  for (std::size_t i = half; i < candidates.size(); i += stride) {
    std::string kinds = KindsOf(lines[candidates[i]], separator);
    kinds.erase(kinds.find_last_not_of('g') + 1);
    if (kinds.size() < 2 || kinds.find('n') == std::string::npos) continue;
    std::ranges::replace(kinds, 'g', 'n');
    ++counts[kinds];
  }
  const auto texts = [](const std::string& kinds) { return std::ranges::count(kinds, 't'); };
  const auto best = std::ranges::max_element(counts, [&](const auto& a, const auto& b) {
    if (a.second != b.second) return a.second < b.second;
    return texts(a.first) > texts(b.first);
  });
  return best == counts.end() ? std::string() : best->first;
}

// The first of two lines, one after the other, that are rows; or one before it that would be but
// for a mistake, so that a mistake hides no row.
std::optional<std::size_t> FirstRow(std::span<const std::string_view> lines,
                                    std::span<const std::size_t> candidates,
                                    const TableDialect& dialect) {
  const auto kinds = [&](std::size_t i) {
    return KindsOf(lines[candidates[i]], dialect.separator);
  };
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!Fits(kinds(i), dialect.kinds)) continue;
    if (i + 1 < candidates.size() && !Fits(kinds(i + 1), dialect.kinds) &&
        !IsAlmostARow(kinds(i + 1), dialect.kinds)) {
      continue;
    }
    while (i > 0 && BeginsAs(dialect.kinds, kinds(i - 1))) --i;
    for (std::size_t j = 0; j < i; ++j) {
      if (IsAlmostARow(kinds(j), dialect.kinds)) return candidates[j];
    }
    return candidates[i];
  }
  return std::nullopt;
}

// Whether rows have decimal commas: some number has one, and none a point.
bool HasDecimalCommas(std::span<const std::string_view> lines,
                      std::span<const std::size_t> candidates, const TableDialect& dialect) {
  if (dialect.separator == ',') return false;
  bool comma = false;
  const std::size_t stride = candidates.size() / kMostLooks + 1;
  for (std::size_t i = 0; i < candidates.size(); i += stride) {
    if (candidates[i] < dialect.first_row) continue;
    for (const TableField& field : FieldsOf(lines[candidates[i]], dialect.separator)) {
      double number = 0;
      const bool point = field.text.find('.') != std::string::npos;
      if (point && ReadField(field.text, false, &number)) return false;
      comma |= field.text.find(',') != std::string::npos && ReadField(field.text, true, &number);
    }
  }
  return comma;
}

}  // namespace

std::vector<TableField> AllFieldsOf(std::string_view line, char separator) {
  std::vector<TableField> fields(1);
  bool quoted = false, begun = separator != ' ';
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool parts = !quoted && (c == separator || (separator == ' ' && c == '\t'));
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back().text += line[i++];
    } else if (c == '"') {
      quoted = !quoted, begun = true;
    } else if (!parts) {
      if (!begun) fields.back().column = static_cast<int>(i) + 1;
      fields.back().text += c, begun = true;
    } else if (separator != ' ') {
      fields.push_back({"", static_cast<int>(i) + 2});
    } else if (begun) {
      fields.push_back({"", static_cast<int>(i) + 2});
      begun = false;
    }
  }
  for (TableField& field : fields) boost::trim(field.text);
  return fields;
}

std::vector<TableField> FieldsOf(std::string_view line, char separator) {
  std::vector<TableField> fields = AllFieldsOf(line, separator);
  while (!fields.empty() && fields.back().text.empty()) fields.pop_back();
  return fields;
}

bool ReadField(std::string_view text, bool decimal_comma, double* number) {
  std::optional<double> read;
  if (decimal_comma) {
    if (text.find('.') != std::string_view::npos) return false;
    std::string pointed(text);
    std::ranges::replace(pointed, ',', '.');
    read = ParseNumber(pointed);
  } else {
    read = ParseNumber(text);
  }
  if (!read) return false;
  *number = *read;
  return true;
}

bool IsGap(std::string_view text) {
  const std::string lower = boost::to_lower_copy(std::string(text));
  return lower.empty() || lower == "nan" || lower == ".nan" || lower == "na" || lower == "n/a" ||
         lower == "-nan";
}

TableDialect FindDialect(std::span<const std::string_view> lines, std::size_t first) {
  const std::vector<std::size_t> candidates = Candidates(lines, first);
  TableDialect best;
  for (const char separator : kSeparators) {
    const std::string kinds = MostCommonKinds(lines, candidates, separator);
    const bool better =
        best.kinds.empty() || std::ranges::count(kinds, 't') < std::ranges::count(best.kinds, 't');
    if (!kinds.empty() && better) best = {.separator = separator, .kinds = kinds};
  }
  if (best.kinds.empty()) return best;
  const auto row = FirstRow(lines, candidates, best);
  if (!row) return {};
  best.first_row = *row;
  best.decimal_comma = HasDecimalCommas(lines, candidates, best);
  return best;
}

std::string InUtf8(const std::string& bytes) {
  constexpr std::string_view kUtf8 = "\xEF\xBB\xBF", kLittle = "\xFF\xFE", kBig = "\xFE\xFF";
  if (bytes.starts_with(kUtf8)) return InUtf8(bytes.substr(kUtf8.size()));
  if (bytes.starts_with(kLittle) || bytes.starts_with(kBig)) {
    const std::size_t low = bytes.starts_with(kLittle) ? 0 : 1;
    std::u16string wide;
    for (std::size_t i = 2; i + 1 < bytes.size(); i += 2) {
      wide += static_cast<char16_t>(static_cast<unsigned char>(bytes[i + low]) |
                                    static_cast<unsigned char>(bytes[i + 1 - low]) << 8U);
    }
    return boost::locale::conv::utf_to_utf<char>(wide);
  }
  if (IsUtf8(bytes)) return bytes;
  std::u32string points;
  for (const char byte : bytes) points += static_cast<unsigned char>(byte);
  return boost::locale::conv::utf_to_utf<char>(points);
}

}  // namespace contact::cli
