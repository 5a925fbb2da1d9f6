#pragma once

#include <string>
#include <vector>

#include "cli/paper/lab.h"
#include "cli/paper/report.h"

namespace contact::cli {

/// The ids of the figures and tables that can be made, in the order of the paper within each group
/// that shares runs.
const std::vector<std::string>& PaperItems();

/// Makes the items with these ids, in the order of PaperItems. Items of a group share its runs.
/// Throws as Lab::Solve does.
std::vector<PaperItem> MakePaperItems(const std::vector<std::string>& ids, Lab& lab);

/// Makes the group fig3, fig4, fig5, exponent: isolated collisions under damping laws.
std::vector<PaperItem> MakeDampingStudy(Lab& lab);

/// Makes the group fig9 to fig12: motion of the triple-ball chain.
std::vector<PaperItem> MakeChainFigures(Lab& lab);

/// Makes the group table2, table3: restitution and passes of the triple-ball chain.
std::vector<PaperItem> MakeChainTables(Lab& lab);

/// Makes the group fig14 to fig17, table4: the ball on a spring.
std::vector<PaperItem> MakeSpringItems(Lab& lab);

}  // namespace contact::cli
