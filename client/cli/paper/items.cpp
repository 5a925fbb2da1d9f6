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
  const auto is_asked = [&ids](const std::string& id) {
    return std::ranges::find(ids, id) != ids.end();
  };
  std::vector<PaperItem> wanted;
  for (const Group& group : Groups()) {
    if (std::ranges::none_of(group.ids, is_asked)) continue;
    for (PaperItem& item : group.make(lab)) {
      if (is_asked(item.id)) wanted.push_back(std::move(item));
    }
  }
  return wanted;
}

}  // namespace contact::cli
