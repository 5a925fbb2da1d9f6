#include "cli/figures/provenance_stamp.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <boost/endian/conversion.hpp>
#include <boost/locale/encoding_utf.hpp>
#include <cstddef>
#include <cstdint>
#include <regex>
#include <utility>

#include "base/spelling.h"
#include "cli/base/escape.h"
#include "cli/base/style.h"
#include "cli/base/text_file.h"

namespace contact::cli {
namespace {

// Replaces the content of the first element of this name. gnuplot writes its own name there.
void Replace(const std::string& element, const std::string& content, std::string* svg) {
  const std::string open = fmt::format("<{}>", element);
  const auto begin = svg->find(open);
  const auto end = svg->find(fmt::format("</{}>", element));
  if (begin == std::string::npos || end == std::string::npos) return;
  svg->replace(begin + open.size(), end - begin - open.size(), content);
}

std::string StampedSvg(std::string svg, const std::string& title, const std::string& lines) {
  Replace("title", HtmlText(title), &svg);
  Replace("desc", HtmlText(lines), &svg);
  return svg;
}

std::string BigEndian(std::uint32_t value) {
  std::array<unsigned char, sizeof value> bytes{};
  boost::endian::store_big_u32(bytes.data(), value);
  return {bytes.begin(), bytes.end()};
}

// An iTXt chunk of PNG: UTF-8, not compressed, in no named language.
std::string TextChunk(std::string_view keyword, std::string_view text) {
  using namespace std::string_literals;
  const std::string content = fmt::format("iTXt{}{}{}", keyword, "\0\0\0\0\0"s, text);
  boost::crc_32_type crc;
  crc.process_bytes(content.data(), content.size());
  return BigEndian(static_cast<std::uint32_t>(content.size() - 4)) + content +
         BigEndian(crc.checksum());
}

std::string StampedPng(std::string png, const std::string& title, const std::string& lines) {
  constexpr std::size_t kHeader = 8 + 25;  // Signature and IHDR, which comes first.
  return png.insert(kHeader, TextChunk("Title", title) + TextChunk("Description", lines));
}

// A text string of PDF: UTF-16 in hexadecimal digits.
std::string PdfText(const std::string& text) {
  std::string digits = "<FEFF";
  for (const char16_t unit : boost::locale::conv::utf_to_utf<char16_t>(text)) {
    digits += fmt::format("{:04X}", static_cast<unsigned>(unit));
  }
  return digits + ">";
}

// Overwrites the time of drawing with spaces, so that no byte moves.
void EraseCreationDate(std::string* pdf) {
  const auto begin = pdf->rfind("/CreationDate (");
  if (begin == std::string::npos) return;
  const auto size = pdf->find(')', begin) + 1 - begin;
  pdf->replace(begin, size, size, ' ');
}

// Appends a new version of the document information: an incremental update, ISO 32000-1, 7.5.6. A
// trailer that cairo 1.16 does not write is left alone.
std::string StampedPdf(std::string pdf, const std::string& title, const std::string& lines) {
  static const std::regex kTrailer(
      R"(trailer\s+<< /Size (\d+)\s+/Root (\d+ 0 R)\s+/Info (\d+) 0 R\s+>>\s+)"
      R"(startxref\s+(\d+)\s+%%EOF\s*)");
  const std::string trailer = pdf.substr(std::min(pdf.rfind("trailer"), pdf.size()));
  std::smatch parts;
  if (!std::regex_match(trailer, parts, kTrailer)) return pdf;
  EraseCreationDate(&pdf);
  const std::size_t info = pdf.size();
  pdf += fmt::format("{} 0 obj\n<< /Title {}\n   /Subject {} >>\nendobj\n", parts[3].str(),
                     PdfText(title), PdfText(lines));
  const std::size_t table = pdf.size();
  return pdf + fmt::format(
                   "xref\n{0} 1\n{1:010} 00000 n \ntrailer\n<< /Size {2} /Root {3} /Info {0} 0 R "
                   "/Prev {4} >>\nstartxref\n{5}\n%%EOF\n",
                   parts[3].str(), info, parts[1].str(), parts[2].str(), parts[4].str(), table);
}

// Leaves out the lines in which gnuplot tells its version and the time.
std::string StampedTikz(const std::string& drawn, const std::vector<Provenance>& sources) {
  std::string stamped = Lines(sources, "% ") + "% \\usepackage{gnuplot-lua-tikz}\n";
  for (const std::string& line : LinesOf(drawn)) {
    if (!line.starts_with("%%")) stamped.append(line).append("\n");
  }
  return stamped;
}

// Leaves out the form feed and the spaces with which gnuplot fills lines.
std::string StampedCharacters(const std::string& drawn, const std::vector<Provenance>& sources) {
  std::string stamped;
  for (std::string line : LinesOf(drawn)) {
    line.erase(0, line.starts_with('\f') ? 1 : 0);
    stamped.append(TrimRight(line)).append("\n");
  }
  stamped.erase(stamped.find_last_not_of('\n') + 1);
  stamped += '\n';
  return sources.empty() ? stamped : stamped + "\n" + Caption(sources) + "\n";
}

}  // namespace

void StampProvenance(OutputFormat format, const std::string& path, const std::string& title,
                     const std::vector<Provenance>& sources) {
  std::string file = ReadText(path);
  const std::string shown = Printable(title, ' '), lines = Lines(sources, "");
  if (format == OutputFormat::kPng) {
    file = StampedPng(std::move(file), shown, lines);
  } else if (format == OutputFormat::kPdf) {
    file = StampedPdf(std::move(file), shown, lines);
  } else if (format == OutputFormat::kTikz) {
    file = StampedTikz(file, sources);
  } else if (format == OutputFormat::kText) {
    file = StampedCharacters(file, sources);
  } else {
    file = StampedSvg(std::move(file), shown, lines);
  }
  WriteText(file, path);
}

}  // namespace contact::cli
