#pragma once

#include <string>
#include <vector>

#include "cli/figures/figure.h"
#include "cli/paper/lab.h"
#include "cli/paper/report.h"

namespace contact::cli {

/// Fig. 3: |deformation velocity| [m/s] over deformation [m], compression solid, restitution
/// dashed. A row of `data` is restitution, deformation, deformation velocity; rows of one
/// restitution, which have a colour of their own, stand together.
Figure DeformationVelocityFigure(const Data& data);

/// Figs. 4 and 5: each column of `data` over the first one, which is the restitution that was asked
/// for. `labels` has the entries in the key, one for each column but the first.
Figure ColumnsFigure(const Data& data, const std::string& y_label,
                     const std::vector<std::string>& labels);

/// Adds the dotted line y = x of Fig. 4, on which a law would deliver what it is asked for.
void AddIdeal(Figure* figure);

/// Fig. 9: velocities over time, B1 solid, B2 dashed, B3 dotted. Throws as PresetFigure does.
Figure VelocitiesFigure(const Solved& run);

/// Figs. 10 to 12: a preset of several runs over each other, a colour for each run; the first
/// contact is solid, the second dashed. Bands and μ/k are those of the last run. `names` names the
/// runs in the key. Throws as PresetFigure does.
Figure ModelsFigure(const std::string& preset, const std::vector<const Solved*>& runs,
                    const std::vector<std::string>& names);

}  // namespace contact::cli
