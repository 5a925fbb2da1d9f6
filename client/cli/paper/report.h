#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cli/base/style.h"
#include "cli/figures/figure.h"

namespace contact::cli {

inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// A number of the paper beside ours.
struct Comparison {
  std::string what;
  double published = kNoNumber;  ///< As printed; NaN: none that can be read.
  double process = kNoNumber;    ///< Ours by the published process and definition.
  double converged = kNoNumber;  ///< Ours by the default solver, to its tolerance.
  double limit = kNoNumber;      ///< |process − published| that is documented; NaN: not compared.
  std::string why{};             ///< Why they differ, in a line; empty where they do not.

  double deviation() const { return process - published; }
  bool holds() const;  ///< The deviation is within what is documented.
};

/// Columns of numbers, each with its unit in its name; as long as the longest, the others end
/// early.
struct Data {
  std::string name;  ///< Of the file, without its ending.
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  std::string note = {};  ///< What the rows are, where their columns do not tell.
};

/// A figure or table of the paper, made again.
struct PaperItem {
  std::string id;     ///< Such as `fig12`.
  std::string title;  ///< What it shows.
  std::vector<Comparison> numbers;
  std::vector<Data> data;
  std::optional<Figure> figure = {};  ///< None for tables.

  bool holds() const;
};

/// Writes the item's data as CSV and its numbers as ID.txt and ID.json. Throws Failure (kLocal).
void Write(const PaperItem& item, const std::filesystem::path& directory);

/// Five significant digits; empty for NaN.
std::string Short(double value);

/// The numbers of all items as one table.
std::string Summary(const std::vector<PaperItem>& items, const Style& style);

}  // namespace contact::cli
