#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include "cli/program.h"

namespace sandstroke {

/// The program in a thread, with its standard error in a file that a page can read its address from.
class Viewed {
 public:
  Viewed(std::vector<std::string> arguments, const std::filesystem::path& folder, Conditions conditions = {})
      : err_(folder / "err.txt") {
    std::filesystem::remove(err_);
    const std::string err = err_.string();
    conditions.in_child = [err, before = conditions.in_child] {
      if (before) before();
      dup2(open(err.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0644), STDERR_FILENO);
    };
    thread_ = std::thread([this, arguments = std::move(arguments), folder, conditions] {
      result_ = run_program(arguments, folder, conditions);
      ended_ = true;
    });
  }
  ~Viewed() {
    if (thread_.joinable()) thread_.join();
  }
  /// "": it ended without one.
  std::string address() const {
    std::smatch found;
    for (std::string said; !ended_; std::this_thread::sleep_for(std::chrono::milliseconds(2))) {
      said = std::filesystem::exists(err_) ? read_file(err_) : "";
      if (std::regex_search(said, found, std::regex("view: (http://127.0.0.1:\\d+/\\?token=[0-9a-f]{32})\n")))
        return found[1];
    }
    return {};
  }
  ProgramResult end() {
    thread_.join();
    result_.err = read_file(err_);
    return result_;
  }

 private:
  std::filesystem::path err_;
  ProgramResult result_;
  std::atomic<bool> ended_ = false;
  std::thread thread_;
};

}  // namespace sandstroke
