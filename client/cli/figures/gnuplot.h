#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/export/provenance.h"

namespace contact::cli {

/// Text of a user as a gnuplot string, which cannot become commands.
std::string GnuplotString(std::string_view text);

/// What a picture is drawn as: svg, png, pdf, tikz, or txt, which is of characters. All are the
/// same picture; png has twice the pixels of svg. Its functions give pieces of a script.
class Medium {
 public:
  static constexpr int kColumns = 80;

  /// `columns` is how wide a txt is.
  explicit Medium(std::string_view format, int columns = kColumns)
      : format_(format), columns_(columns) {}

  bool characters() const { return format_ == "txt"; }
  bool tex() const { return format_ == "tikz"; }

  /// The terminal, eight inches wide except of txt and tikz; `height_in` is for that width.
  std::string Terminal(double height_in) const;

  /// Text of a user as a string that cannot become commands, neither of gnuplot nor of TeX.
  std::string Text(std::string_view text) const;

  /// ` font …` of about so many points; nothing for characters.
  std::string Font(int points) const;

  /// Commands that write where a picture comes from below its last plot; none without sources, and
  /// for characters, where DescribePicture does it.
  std::string Caption(const std::vector<Provenance>& sources) const;

 private:
  std::string format_;
  int columns_;
};

/// Runs a script file through gnuplot, whose messages go to the standard error. Throws Failure
/// (kLocal) if gnuplot is not installed or fails.
void RunGnuplot(const std::string& script_path);

}  // namespace contact::cli
