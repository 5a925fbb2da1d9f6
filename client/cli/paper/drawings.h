#pragma once

#include <string>
#include <vector>

#include "cli/figures/figure.h"
#include "cli/paper/lab.h"
#include "cli/paper/report.h"

namespace contact::cli {

/// Fig. 3: |δ̇| over δ for each restitution, compression solid, restitution dashed.
Figure DrawDeformationVelocities(const Data& data);

/// Figs. 4 and 5: columns over the first one; `labels` are those of the others.
Figure DrawColumns(const Data& data, const std::string& y_label,
                   const std::vector<std::string>& labels);

/// Fig. 4: the restitution asked for, dotted.
void AddIdeal(Figure* figure);

/// Fig. 9: B1 solid, B2 dashed, B3 dotted.
Figure DrawVelocities(const Solved& run);

/// Figs. 10 to 12: a preset of several runs over each other, a colour each; the first contact
/// solid, the second dashed. Contact bands and μ/k are those of the last run.
Figure DrawModels(const std::string& preset, const std::vector<const Solved*>& runs,
                  const std::vector<std::string>& names);

}  // namespace contact::cli
