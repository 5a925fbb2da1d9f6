#include "cli/text/iteration_table.h"

#include <fmt/format.h>

#include "cli/base/number.h"
#include "cli/text/render_ledger.h"

namespace contact::cli {
namespace {

constexpr int kRow = 80;           // Of all columns but the bracket.
constexpr int kWithBracket = 120;  // Of all columns.
constexpr int kWithRestitution = 60;

// The cells of a row, in the order of the columns.
struct Cells {
  std::string episode, n, contact, mu, out, error, update, bracket;
};

// As many columns as the terminal has room for.
std::string Row(const Cells& cells, const Style& style) {
  const bool narrow = style.width > 0 && style.width < kRow;
  const bool small = narrow && style.width < kWithRestitution;
  if (small) {
    return fmt::format("{}  {} {} {}", Pad(cells.n, -3), Pad(OneLine(cells.contact, 10), 10),
                       Pad(cells.mu, -12), Pad(cells.error, -9));
  }
  const std::string row = fmt::format(
      "{}  {} {} {} {}", Pad(cells.n, -3), Pad(OneLine(cells.contact, narrow ? 14 : 0), 14),
      Pad(cells.mu, -15), Pad(cells.out, -13), Pad(cells.error, -9));
  if (narrow) return row;
  const std::string all = fmt::format("{} {}  {}", Pad(cells.episode, -7), row, cells.update);
  return style.wide || style.width >= kWithBracket ? Pad(all, kRow + 2) + cells.bracket : all;
}

// The interval in which μ is known to lie; a side that is not known yet is `-`.
std::string Bracket(const v1::Iteration::Unknown& unknown) {
  const auto side = [](double mu) { return mu == 0 ? "-" : Digits(mu, 9); };
  return fmt::format("[{}, {}]", side(unknown.bracket_low()), side(unknown.bracket_high()));
}

std::string NextStep(const v1::Iteration& iteration, const v1::Iteration::Unknown& unknown) {
  if (iteration.accepted()) return "accepted";
  if (unknown.update() == v1::Iteration::UPDATE_UNSPECIFIED) return "-";
  return v1::Iteration::Update_Name(unknown.update());
}

}  // namespace

std::string IterationHeader(const Style& style) {
  return Row({"EPISODE", "n", "CONTACT", "μ", "ε OUT", "|Δε|/ε", "NEXT", "BRACKET OF μ"}, style);
}

std::string IterationRow(const v1::Iteration& iteration, const v1::Iteration::Unknown& unknown,
                         const Style& style) {
  const bool small = style.width > 0 && style.width < kWithRestitution;
  const double error = RestitutionError(unknown.restitution_out(), unknown.restitution_in());
  return Row(
      {fmt::to_string(iteration.episode()), fmt::to_string(iteration.number()), unknown.contact(),
       Digits(unknown.mu(), small ? 6 : 9), Digits(unknown.restitution_out(), 8),
       RelativeError(error), NextStep(iteration, unknown), Bracket(unknown)},
      style);
}

}  // namespace contact::cli
