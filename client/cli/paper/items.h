#pragma once

#include <string>
#include <vector>

#include "cli/paper/lab.h"
#include "cli/paper/report.h"

namespace contact::cli {

/// The figures and tables that can be made, in the paper's order.
const std::vector<std::string>& PaperItems();

/// Makes those asked for, by id. Figures that share a run are made from one run.
std::vector<PaperItem> MakePaperItems(const std::vector<std::string>& ids, Lab& lab);

// One group each.
std::vector<PaperItem> MakeDampingStudy(Lab& lab);  ///< fig3, fig4, fig5, exponent.
std::vector<PaperItem> MakeChainFigures(Lab& lab);  ///< fig9 to fig12.
std::vector<PaperItem> MakeChainTables(Lab& lab);   ///< table2, table3.
std::vector<PaperItem> MakeSpringItems(Lab& lab);   ///< table4, fig14 to fig17.

}  // namespace contact::cli
