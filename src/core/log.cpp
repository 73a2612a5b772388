#include "core/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace sandstroke {

void start_log(bool quiet) {
  auto logger = spdlog::get("sandstroke");
  if (!logger) logger = spdlog::stderr_color_mt("sandstroke");
  logger->set_pattern("%^%L%$ %v");
  logger->set_level(quiet ? spdlog::level::warn : spdlog::level::info);
  spdlog::set_default_logger(logger);
}

}  // namespace sandstroke
