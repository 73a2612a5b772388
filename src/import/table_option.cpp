#include "import/table_option.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace sandstroke {

std::string option_of(const std::string& key) {
  std::string option = "--" + key;
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

std::string option_and_key(const std::string& key) {
  return fmt::format("stroke.table.{} (stroke convert: {})", key, option_of(key));
}

}  // namespace sandstroke
