#include "cli/base/text_file.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>
#include <system_error>

#include "cli/base/failure.h"
#include "cli/base/output_file.h"

namespace contact::cli {
namespace {

// False if the stream cannot be read, as that of a folder. An empty one can.
// Reads little more than `most` bytes.
bool ReadAll(std::istream& stream, std::size_t most, std::string* text) {
  if (!stream) return false;
  std::array<char, 1 << 16> block;
  while (stream.read(block.data(), block.size()), stream.gcount() > 0) {
    text->append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (text->size() > most) return true;
  }
  return stream.eof() && !stream.bad();
}

}  // namespace

std::string ReadText(const std::string& path, std::size_t most) {
  std::string text;
  std::ifstream file;
  if (path != "-") file.open(path, std::ios::binary);
  if (!ReadAll(path == "-" ? std::cin : file, most, &text)) {
    throw Failure(ExitCode::kLocal,
                  fmt::format("cannot read {}: {}", path, std::generic_category().message(errno)));
  }
  if (text.size() > most) {
    throw Failure(ExitCode::kLocal, fmt::format("{} has more than {} MiB", path, most >> 20));
  }
  return text;
}

void WriteText(const std::string& text, const std::string& path) {
  OutputFile file(path);
  std::fwrite(text.data(), 1, text.size(), file.get());
  file.Close();
}

std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace contact::cli
