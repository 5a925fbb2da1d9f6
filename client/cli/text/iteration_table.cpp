#include "cli/text/iteration_table.h"

#include <fmt/format.h>

#include "cli/base/number.h"
#include "cli/text/render_ledger.h"

namespace contact::cli {
namespace {

std::string Row(const std::string& episode, const std::string& n, const std::string& contact,
                const std::string& mu, const std::string& out, const std::string& error,
                const std::string& update) {
  return fmt::format("{} {}  {} {} {} {}  {}", Pad(episode, -7), Pad(n, -3), Pad(contact, 14),
                     Pad(mu, -15), Pad(out, -13), Pad(error, -9), update);
}

// The interval in which μ is known to lie; a side that is not known yet is `-`.
std::string Bracket(const v1::Iteration::Unknown& unknown) {
  const auto side = [](double mu) { return mu == 0 ? "-" : Digits(mu, 9); };
  return fmt::format("[{}, {}]", side(unknown.bracket_low()), side(unknown.bracket_high()));
}

// The row with the bracket to its right in a wide table, else the row alone.
std::string WithBracket(const std::string& row, const std::string& bracket, const Style& style) {
  constexpr int kRow = 82;
  return style.wide ? Pad(row, kRow) + bracket : row;
}

std::string NextStep(const v1::Iteration& iteration, const v1::Iteration::Unknown& unknown) {
  if (iteration.accepted()) return "accepted";
  if (unknown.update() == v1::Iteration::UPDATE_UNSPECIFIED) return "-";
  return v1::Iteration::Update_Name(unknown.update());
}

}  // namespace

std::string IterationHeader(const Style& style) {
  return WithBracket(Row("EPISODE", "n", "CONTACT", "μ", "ε OUT", "|Δε|/ε", "NEXT"), "BRACKET OF μ",
                     style);
}

std::string IterationRow(const v1::Iteration& iteration, const v1::Iteration::Unknown& unknown,
                         const Style& style) {
  const double error = RestitutionError(unknown.restitution_out(), unknown.restitution_in());
  return WithBracket(
      Row(fmt::to_string(iteration.episode()), fmt::to_string(iteration.number()),
          unknown.contact(), Digits(unknown.mu(), 9), Digits(unknown.restitution_out(), 8),
          RelativeError(error), NextStep(iteration, unknown)),
      Bracket(unknown), style);
}

}  // namespace contact::cli
