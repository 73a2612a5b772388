#include "cli/announce_view.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "core/error.h"
#include "core/interrupt.h"

namespace sandstroke {
namespace {

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value != '\0';
}

bool has_desktop() { return (is_set("DISPLAY") || is_set("WAYLAND_DISPLAY")) && !is_set("CI"); }

std::filesystem::path page_to(const std::string& address, const TemporaryFolder& folder) {
  const std::filesystem::path page = folder / "view.html";
  std::ofstream(page) << fmt::format("<!DOCTYPE html><meta http-equiv=\"refresh\" content=\"0; url={}\">\n",
                                     address);
  return page;
}

}  // namespace

ViewOpener::ViewOpener(const std::string& address)
    : child_(FedChild::start({"xdg-open", page_to(address, folder_).string()})) {}

std::unique_ptr<ViewOpener> announce_view(const ViewServer& server, bool opens) {
  fmt::print(stderr, "view: {}\n", server.address());
  fmt::print(stderr, "from another machine: ssh -L {0}:127.0.0.1:{0} HOST, then open that address there\n",
             server.port());
  std::fflush(stderr);
  if (!opens || !has_desktop()) return nullptr;
  try {
    return std::make_unique<ViewOpener>(server.address());
  } catch (const Error& failure) {
    spdlog::warn("the view was not opened: {}", failure.what());
    return nullptr;
  }
}

void wait_for_page(const ViewServer& server, const char* what) {
  fmt::print(stderr, "the {} begins when a page is open\n", what);
  while (server.pages() == 0 && !interrupted())
    std::this_thread::sleep_for(std::chrono::duration<double>(picture_interval));
}

}  // namespace sandstroke
