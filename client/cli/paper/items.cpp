#include "cli/paper/items.h"

#include <algorithm>

namespace contact::cli {
namespace {

struct Group {
  std::vector<std::string> ids;
  std::vector<PaperItem> (*make)(Lab& lab);
};

const std::vector<Group>& Groups() {
  static const std::vector<Group> groups = {
      {{"fig3", "fig4", "fig5", "exponent"}, MakeDampingStudy},
      {{"fig9", "fig10", "fig11", "fig12"}, MakeChainFigures},
      {{"table2", "table3"}, MakeChainTables},
      {{"fig14", "fig15", "fig16", "fig17", "table4"}, MakeSpringItems}};
  return groups;
}

bool Contains(const std::vector<std::string>& ids, const std::string& id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

}  // namespace

const std::vector<std::string>& PaperItems() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> ids;
    for (const Group& group : Groups()) {
      ids.insert(ids.end(), group.ids.begin(), group.ids.end());
    }
    return ids;
  }();
  return all;
}

std::vector<PaperItem> MakePaperItems(const std::vector<std::string>& ids, Lab& lab) {
  std::vector<PaperItem> wanted;
  for (const Group& group : Groups()) {
    if (std::none_of(group.ids.begin(), group.ids.end(),
                     [&](const std::string& id) { return Contains(ids, id); })) {
      continue;
    }
    for (PaperItem& item : group.make(lab)) {
      if (Contains(ids, item.id)) wanted.push_back(std::move(item));
    }
  }
  return wanted;
}

}  // namespace contact::cli
