#include "cli/figures/form/figure_style.h"

#include <fmt/format.h>

#include <map>
#include <regex>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

[[noreturn]] void Refuse(const std::string& what) { throw Failure(ExitCode::kUsage, what); }

}  // namespace

FigureStyle::Size ParseSize(const std::string& text) {
  static const std::regex kSize(R"((\d{1,4}(?:\.\d{1,6})?)x(\d{1,4}(?:\.\d{1,6})?)(in|cm|mm)?)");
  static const std::map<std::string, double> kInches{
      {"", 1}, {"in", 1}, {"cm", 1 / 2.54}, {"mm", 1 / 25.4}};
  std::smatch parts;
  if (!std::regex_match(text, parts, kSize)) {
    Refuse(
        fmt::format("--size {}: must be a width and a height, such as 85x60mm or 3.4x2.5in", text));
  }
  const double inch = kInches.at(parts[3].str());
  const FigureStyle::Size size{std::stod(parts[1].str()) * inch, std::stod(parts[2].str()) * inch};
  for (const double length : {size.width, size.height}) {
    if (length < 1 || length > 100) {
      Refuse(fmt::format("--size {}: must be from 1 to 100 inches", text));
    }
  }
  return size;
}

FigureStyle::Font ParseFont(const std::string& text) {
  static const std::regex kFont(R"(([A-Za-z][A-Za-z0-9 _-]*)?(?:,?(\d{1,2}(?:\.\d{1,3})?))?)");
  std::smatch parts;
  const bool read = !text.empty() && std::regex_match(text, parts, kFont);
  if (!read) Refuse(fmt::format("--font {}: must be a font, such as Times,9 or Times or 9", text));
  FigureStyle::Font font{.family = parts[1].str()};
  if (!parts[2].matched) return font;
  font.points = std::stod(parts[2].str());
  if (font.points < 2) Refuse(fmt::format("--font {}: a size is at least 2 points", text));
  return font;
}

}  // namespace contact::cli
