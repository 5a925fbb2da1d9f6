#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace contact {

/// The candidate that `name` is most likely a misspelling of; empty if none is near. Near is one
/// that begins with `name`, whatever `-` and `_` are in the two, or that a few edits turn into it:
/// up to a third of its letters, at least 2, at most half. The first of equally near ones. Names of
/// more than 64 bytes are near nothing. The result is one of `candidates`, not a copy.
std::string_view Nearest(std::string_view name, const std::vector<std::string_view>& candidates);

/// The hint `did you mean 'x'?` with the candidate nearest to `name`, or `otherwise` if none is
/// near.
std::string DidYouMean(std::string_view name, const std::vector<std::string_view>& candidates,
                       const std::string& otherwise = "");

/// The line `message — hint`; the message alone if there is no hint.
std::string WithHint(const std::string& message, const std::string& hint);

/// A count with its noun: `1 body`, `2 bodies`.
std::string Count(std::int64_t count, std::string_view one, std::string_view many);

/// Length in bytes of the character that the text begins with, if it steers a terminal or turns the
/// direction of what follows: control characters, C1 included, separators of lines, and the marks
/// of bidirectional text. 0: it begins with none of them.
std::size_t UnprintableBytes(std::string_view text);

/// The text with `instead` for each of these characters.
std::string Printable(std::string_view text, char instead = '?');

/// Printable text that keeps line feeds and tabs.
std::string PrintableLines(std::string_view text);

/// Text of a user, to be shown in a message: cut to 64 bytes at the end of a UTF-8 character, and
/// printable.
std::string Shortened(std::string_view text);

/// Shortened text in single quotes.
std::string Quoted(std::string_view text);

}  // namespace contact
