#include "core/nearest_name.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace sandstroke {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row[b.size()];
}

/// The last part of a dotted key.
std::string_view last_part(std::string_view name) { return name.substr(name.rfind('.') + 1); }

}  // namespace

std::string nearest_name(const std::string& name, const std::set<std::string>& known) {
  if (known.contains(name)) return {};  // a key of another [[table]] of the same name
  const auto next = known.upper_bound(name);
  if (next != known.end() && next->starts_with(name) && next->find('.', name.size()) == std::string::npos)
    return *next;
  std::string same_last;
  for (const std::string& one : known)
    if (last_part(one) == last_part(name)) same_last += (same_last.empty() ? "" : " or ") + one;
  if (!same_last.empty()) return same_last;
  const auto closer = [&](const std::string& a, const std::string& b) {
    return edit_distance(a, name) < edit_distance(b, name);
  };
  const auto best = std::min_element(known.begin(), known.end(), closer);
  if (best == known.end() || edit_distance(*best, name) > 1 + name.size() / 3) return {};
  return *best;
}

}  // namespace sandstroke
