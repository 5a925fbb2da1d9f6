#include "cli/figures/picture_source.h"

#include <fmt/format.h>

#include <boost/crc.hpp>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <utility>

#include "cli/base/html.h"
#include "cli/base/style.h"
#include "cli/base/text_file.h"

namespace contact::cli {
namespace {

// Puts `content` in the place of what the first element of this name has: gnuplot names itself.
void Replace(const std::string& element, const std::string& content, std::string* svg) {
  const std::string open = fmt::format("<{}>", element);
  const auto begin = svg->find(open);
  const auto end = svg->find(fmt::format("</{}>", element));
  if (begin == std::string::npos || end == std::string::npos) return;
  svg->replace(begin + open.size(), end - begin - open.size(), content);
}

std::string BigEndian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes += static_cast<char>((value >> static_cast<unsigned>(shift)) & 0xFFU);
  }
  return bytes;
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

std::string DescribedPng(std::string png, const std::string& title, const std::string& lines) {
  constexpr std::size_t kHeader = 8 + 25;  // Signature and IHDR, which comes first.
  return png.insert(kHeader, TextChunk("Title", title) + TextChunk("Description", lines));
}

// Without the lines in which gnuplot tells its version and the time.
std::string DescribedTikz(const std::string& picture, const std::vector<Provenance>& sources) {
  std::string described = Lines(sources, "% ") + "% \\usepackage{gnuplot-lua-tikz}\n";
  std::istringstream lines(picture);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("%%")) described.append(line).append("\n");
  }
  return described;
}

// Without the spaces that fill its lines.
std::string DescribedCharacters(const std::string& picture,
                                const std::vector<Provenance>& sources) {
  std::string described;
  std::istringstream lines(picture);
  for (std::string line; std::getline(lines, line);) {
    line.erase(0, line.starts_with('\f') ? 1 : 0);
    described.append(TrimRight(line)).append("\n");
  }
  described.erase(described.find_last_not_of('\n') + 1);
  described += '\n';
  return sources.empty() ? described : described + "\n" + Caption(sources) + "\n";
}

}  // namespace

void DescribePicture(std::string_view format, const std::string& path, const std::string& title,
                     const std::vector<Provenance>& sources) {
  if (format == "pdf") return;  // cairo writes none of it, and its dictionary is compressed.
  std::string picture = ReadText(path);
  const std::string lines = Lines(sources, "");
  if (format == "png") {
    picture = DescribedPng(std::move(picture), title, lines);
  } else if (format == "tikz") {
    picture = DescribedTikz(picture, sources);
  } else if (format == "txt") {
    picture = DescribedCharacters(picture, sources);
  } else {
    Replace("title", HtmlText(title), &picture);
    Replace("desc", HtmlText(lines), &picture);
  }
  WriteText(picture, path);
}

}  // namespace contact::cli
