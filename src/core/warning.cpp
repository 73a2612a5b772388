#include "core/warning.h"

#include <spdlog/spdlog.h>

namespace sandstroke {
namespace {

thread_local WarningList* innermost = nullptr;

}  // namespace

WarningList::WarningList() : around_(innermost) { innermost = this; }
WarningList::~WarningList() { innermost = around_; }

void warn(const Warning& warning) {
  for (WarningList* list = innermost; list; list = list->around_) list->warnings_.push_back(warning);
  const bool unstable = warning.code == WarningCode::loop_swings;
  spdlog::log(unstable ? spdlog::level::err : spdlog::level::warn, "{}", warning.line());
}

void warn_if_any(WarningCode code, const std::string& sentence) {
  if (!sentence.empty()) warn({code, sentence});
}

}  // namespace sandstroke
