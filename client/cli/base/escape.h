#pragma once

#include <string>
#include <string_view>

namespace contact::cli {

/// Texts of users and servers, escaped for the languages of the pages and tables that quote them.
/// Characters that are not printable (UnprintableBytes) become spaces, but ends of lines stay.

/// `text` with the special characters of HTML escaped, so that it cannot become markup. It may
/// also stand in an attribute between double quotes.
std::string HtmlText(std::string_view text);

/// `text` as LaTeX sets it: no character of it becomes a command. Greek letters and the few other
/// signs of our units become commands of its mathematics.
std::string LatexText(std::string_view text);

}  // namespace contact::cli
