// sandstroke_bench: what whole runs cost, as one JSON object. All on one thread, all in one go, so that its
// figures can be compared with each other; between runs on a busy machine compare ratios.
#include "bench/end_to_end.h"

#include <spdlog/fmt/fmt.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ctime>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "report/page.h"
#include "validation/study/study.h"

namespace sandstroke {
namespace {

double peak_rss() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024.0;
}

void write_all(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = write(file, text.data() + done, text.size() - done);
    if (n <= 0) _exit(2);
    done += static_cast<std::size_t>(n);
  }
}

/// Rows of speed, as Markdown.
std::string table_of(const nlohmann::json& rows) {
  const bool compares = !rows.empty() && rows[0].contains("before");
  std::string text = compares ? "| what | | before | now | times |\n|---|---|---|---|---|\n"
                              : "| what | | |\n|---|---|---|\n";
  bool disturbed = false;
  const auto number = [](const nlohmann::json& value) {
    const double x = value.get<double>();
    return x < 1000.0 ? fmt::format("{:.3g}", x) : fmt::format("{:.0f}", x);
  };
  for (const nlohmann::json& row : rows) {
    text += "| " + row["name"].get<std::string>() + " | " + row["unit"].get<std::string>() + " | ";
    if (compares) text += number(row["before"]) + " | ";
    text += number(row["value"]) + (row["disturbed"].get<bool>() ? " *" : "");
    if (compares) text += " | " + fmt::format("{:.2f}", row["ratio"].get<double>());
    text += " |\n";
    disturbed = disturbed || row["disturbed"].get<bool>();
  }
  if (disturbed)
    text += "\n\\* Repeats differ by more than 20 %: other programs disturbed them. Measure again.\n";
  return text;
}

}  // namespace

nlohmann::json in_child(const std::function<nlohmann::json()>& measure) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no child process");
  if (child == 0) {
    close(ends[0]);
    try {
      const double before = peak_rss();
      nlohmann::json result = measure();
      result["peak_rss_bytes"] = peak_rss() - before;
      write_all(ends[1], result.dump());
      _exit(0);
    } catch (const std::exception& error) {
      std::cerr << error.what() << '\n';
      _exit(1);
    }
  }
  close(ends[1]);
  std::string text;
  char buffer[4096];
  for (ssize_t n; (n = read(ends[0], buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(n));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error("a measurement failed");
  return nlohmann::json::parse(text);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

nlohmann::json spread(const std::vector<double>& values) {
  return {{"median", median(values)},
          {"least", *std::min_element(values.begin(), values.end())},
          {"largest", *std::max_element(values.begin(), values.end())},
          {"disturbed", is_disturbed(*std::min_element(values.begin(), values.end()),
                                     *std::max_element(values.begin(), values.end()), 0.0)},
          {"repeats", values.size()}};
}

}  // namespace sandstroke

int main(int argc, char** argv) {
  using namespace sandstroke;
  CLI::App app("Measures whole runs of sandstroke on one thread and prints one JSON object");
  BenchOptions options;
  std::string output, only;
  bool table = false;
  app.add_flag("--quick", options.quick, "Seconds rather than minutes: smaller beds, shorter strokes");
  app.add_option("--only", only,
                 "One part of the report, such as sweeps; soak (10 min) is only measured where it is named");
  app.add_option("--before", options.before, "Another build of the program, which speed compares with");
  app.add_flag("--table", table, "Only speed, as a table (Markdown)");
  app.add_option("-o,--output", output, "Write the report to this file");
  CLI11_PARSE(app, argc, argv);
  if (table) only = "speed";

  try {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    nlohmann::ordered_json report;
    report["machine"] = describe_machine();
    report["quick"] = options.quick;
    const auto add = [&](const std::string& name, const std::function<nlohmann::json()>& measure) {
      if (only.empty() || name == only) report[name] = measure();
    };
    add("paper_scene", [&] { return in_child([&] { return measure_paper_scene(options); }); });
    add("bed_sizes", [&] { return measure_bed_sizes(options); });
    add("tile_sizes", [&] { return in_child(measure_tile_sizes); });
    add("long_stroke", [&] { return in_child([&] { return measure_long_stroke(options); }); });
    add("cones", [&] { return in_child([&] { return measure_cones(options); }); });
    add("rough_beds", [&] { return in_child([&] { return measure_rough_beds(options); }); });
    add("levels", [&] { return in_child([&] { return measure_levels(options); }); });
    add("clones", [&] { return in_child([&] { return measure_clones(options); }); });
    add("paper_law", [&] { return in_child([&] { return measure_paper_law(options); }); });
    add("sweeps", [&] { return in_child([&] { return measure_sweeps(options); }); });
    add("recording", [&] { return in_child([&] { return measure_recording(options); }); });
    if (only == "soak") add(only, [&] { return in_child([&] { return measure_soak(options); }); });
    add("speed", [&] { return measure_speed(options); });
    const std::string text = table ? table_of(report["speed"]) : report.dump(2) + "\n";
    if (output.empty()) {
      std::cout << text;
    } else {
      std::ofstream file(output);
      file << text;
      if (!file.flush()) throw std::runtime_error("cannot write " + output);
    }
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "sandstroke_bench: " << error.what() << '\n';
    return 1;
  }
}
