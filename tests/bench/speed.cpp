// Times that a user waits for, measured through the program itself, so that another build of it can be
// measured in the same run, in turn: machines differ, and so do their hours.
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>

#include "bench/end_to_end.h"
#include "core/child_process.h"
#include "core/stopwatch.h"
#include "core/temporary_folder.h"
#include "validation/study/study.h"

namespace sandstroke {
namespace {

/// Runs the program. Gives wall and cpu [s, its children's included], peak [bytes, resident], and out, what
/// it said.
nlohmann::json run(const std::string& program, std::vector<std::string> words) {
  words.insert(words.begin(), program);
  return in_child([&] {  // which has no other children to tell it from
    const Stopwatch watch;
    const std::optional<ChildResult> ended = run_child(words);
    const double wall = watch.seconds();
    if (!ended || ended->exit_code != 0)
      throw std::runtime_error(program + " failed: " + (ended ? ended->err : "it is not there"));
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return nlohmann::json{{"wall", wall},
                          {"cpu", seconds(usage.ru_utime) + seconds(usage.ru_stime)},
                          {"peak", 1024.0 * static_cast<double>(usage.ru_maxrss)},
                          {"out", ended->out}};
  });
}

/// The words that run a scene, with these besides.
std::vector<std::string> run_words(const std::string& scene, const TemporaryFolder& folder,
                                   std::vector<std::string> more = {}) {
  std::vector<std::string> words = {"run", scene, "-o", (folder / "run.h5").string(), "--overwrite"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}
/// The summary of a run, and in `whole` the simulated time over that of the whole process.
nlohmann::json summary(const std::string& program, const std::string& scene, std::vector<std::string> more,
                       int threads = 1) {
  const TemporaryFolder folder;
  more.insert(more.end(), {"--json", "--threads", std::to_string(threads)});
  const nlohmann::json ran = run(program, run_words(scene, folder, std::move(more)));
  nlohmann::json summary = nlohmann::json::parse(ran["out"].get<std::string>());
  summary["whole"] = summary["simulated_seconds"].get<double>() / ran["wall"].get<double>();
  return summary;
}

const std::string strokes = std::string(SANDSTROKE_SOURCE) + "/strokes/";
const std::string wscg_scene = strokes + "wscg/scene.toml";

/// The peers' pile (piles.cpp) on n x n cells, which collapses by rkl.
nlohmann::json collapse(const std::string& program, int n, int threads) {
  const TemporaryFolder folder;
  std::ofstream(folder / "pile.toml")
      << "[bed]\nsize = [" << n * 0.001 << ", " << n * 0.001 << "]\ncells = [" << n << ", " << n
      << "]\nsurface = { kind = \"cylinder\", radius = " << 60.0 / 512 * n * 0.001
      << ", height = " << 80.0 / 512 * n * 0.001
      << " }\n[relaxation]\nlaw = \"isotropic\"\nmethod = \"rkl\"\n";
  return summary(program, (folder / "pile.toml").string(), {}, threads);
}

double sweep_seconds(const std::string& program, int jobs) {
  const TemporaryFolder folder;
  std::ofstream(folder / "plan.toml")
      << "[sweep]\nscene = \"" << wscg_scene
      << "\"\n[axes]\nrelaxation.talus_angle = { from = 20, to = 42.5, count = 20 }\n";
  return run(program, {"sweep", (folder / "plan.toml").string(), "-o", (folder / "swept").string(), "--jobs",
                       std::to_string(jobs)})["wall"];
}

enum class Better { more, less };

/// A line of the table, by a program.
struct Line {
  std::string name, unit;
  Better better;
  int repeats;
  std::function<double(const std::string&)> measure;
};

std::vector<Line> lines(bool quick) {
  std::vector<Line> all;
  const auto add = [&](std::string name, std::string unit, Better better, auto measure, int repeats = 7) {
    all.push_back({std::move(name), std::move(unit), better, quick ? 1 : repeats, measure});
  };
  const auto add_stroke = [&](const std::string& name, const std::vector<std::string>& words,
                              int repeats = 7) {
    const auto add_factor = [&](const char* suffix, const char* factor) {
      add(
          name + suffix, "times real time", Better::more,
          [words, factor](const std::string& program) -> double {
            return summary(program, wscg_scene, words)[factor];
          },
          repeats);
    };
    add_factor("", "real_time_factor");
    add_factor(", whole process", "whole");
  };
  add_stroke("stroke of 29 s (strokes/wscg), `paper`", {});
  add_stroke("stroke of 29 s (strokes/wscg), `accurate`", {"--set", "model.preset=accurate"});
  if (!quick)
    add_stroke("the same on 4000²", {"--set", "model.preset=accurate", "--set", "bed.cells=[4000, 4000]"}, 2);
  const std::string robot =
      std::string(SANDSTROKE_SHARED_DATA) + "/panda_comanip_force_1khz/symbol17_rec2.csv";
  if (std::filesystem::exists(robot))
    add_stroke("a robot's drawing of 9 s, as recorded, `accurate`",
               {"--stroke", robot, "--set", "stroke.table.rate=1000", "--set", "stroke.plane=fit", "--set",
                "stroke.place=centre", "--set", "stroke.depth=0.004", "--set", "model.preset=accurate"});
  // The passes of a pile are known from when it was timed.
  const auto passes = std::make_shared<std::map<std::pair<std::string, int>, double>>();
  for (const int n : quick ? std::vector{128, 256} : std::vector{512, 1024, 2048, 4096}) {
    const std::string pile = "pile on " + std::to_string(n) + "²";
    add(
        pile, "s", Better::less,
        [=](const std::string& program) -> double {
          const nlohmann::json outcome = collapse(program, n, 1);
          (*passes)[{program, n}] = outcome["passes"];
          return outcome["wall_seconds"];
        },
        n > 2000 ? 1 : 5);
    add(
        pile, "passes", Better::less,
        [=](const std::string& program) {
          return passes->at({program, n});
        },
        1);
  }
  const int large = quick ? 256 : 2048;
  add(
      "pile on " + std::to_string(large) + "², two threads over one", "times as fast", Better::more,
      [large](const std::string& program) {
        return collapse(program, large, 1)["wall_seconds"].get<double>() /
               collapse(program, large, 2)["wall_seconds"].get<double>();
      },
      2);
  if (!quick)
    add(
        "sweep of 20 points, two jobs over one", "times as fast", Better::more,
        [](const std::string& program) { return sweep_seconds(program, 1) / sweep_seconds(program, 2); }, 5);
  add(
      "`--version`", "ms", Better::less,
      [](const std::string& program) { return 1e3 * run(program, {"--version"})["wall"].get<double>(); }, 21);
  add(
      "`--version`", "MB", Better::less,
      [](const std::string& program) { return 1e-6 * run(program, {"--version"})["peak"].get<double>(); }, 3);
  add(
      "`info` of a run", "ms", Better::less,
      [](const std::string& program) {
        const TemporaryFolder folder;
        run(program, run_words(wscg_scene, folder));
        return 1e3 * run(program, {"info", (folder / "run.h5").string()})["wall"].get<double>();
      },
      7);
  add(
      "a run of an empty bed", "MB", Better::less,
      [](const std::string& program) {
        const TemporaryFolder folder;
        std::ofstream(folder / "empty.toml") << "[bed]\ncells = [64, 64]\nsize = [0.128, 0.128]\n";
        return 1e-6 * run(program, run_words((folder / "empty.toml").string(), folder))["peak"].get<double>();
      },
      3);
  add(
      "a frame of a film, 1280 x 720", "ms of CPU", Better::less,
      [](const std::string& program) {
        const TemporaryFolder folder;
        constexpr int frames = 21;  // of two seconds
        run(program, run_words(wscg_scene, folder,
                               {"--frames", "10", "--set", "stroke.start=1", "--set", "stroke.stop=3"}));
        const auto drawn = [&](const std::string& which, const char* to) -> double {
          return run(program, {"render", (folder / "run.h5").string(), "--frame", which, "-o",
                               (folder / to).string()})["cpu"];
        };
        const double one = drawn("0", "one.png");
        return 1e3 * (drawn("all", "all") - one) / (frames - 1);
      },
      3);
  const auto picture = [](const std::string& program, const char* cost) {
    const TemporaryFolder folder;
    const nlohmann::json without = run(program, run_words(wscg_scene, folder)),
                         with = run(program,
                                    run_words(wscg_scene, folder, {"--png", (folder / "run.png").string()}));
    return with[cost].get<double>() - without[cost].get<double>();
  };
  const std::string name = "a picture of 1280 x 720, beside its run";
  add(name, "s", Better::less, [=](const std::string& program) { return picture(program, "wall"); });
  add(
      name, "MB", Better::less, [=](const std::string& program) { return 1e-6 * picture(program, "peak"); },
      3);
  return all;
}

}  // namespace

nlohmann::json measure_speed(const BenchOptions& options) {
  std::vector<std::string> programs = {SANDSTROKE_PROGRAM};
  if (!options.before.empty()) programs.insert(programs.begin(), options.before);
  nlohmann::json rows = nlohmann::json::array();
  for (const Line& line : lines(options.quick)) {
    std::vector<double> best(programs.size(),
                             line.better == Better::more ? 0.0 : std::numeric_limits<double>::infinity());
    std::vector<std::vector<double>> values(programs.size());
    for (int repeat = 0; repeat < line.repeats; ++repeat)
      for (std::size_t i = 0; i < programs.size(); ++i) {  // in turn
        const double value = line.measure(programs[i]);
        best[i] = line.better == Better::more ? std::max(best[i], value) : std::min(best[i], value);
        values[i].push_back(value);
      }
    nlohmann::json row = {{"name", line.name}, {"unit", line.unit}, {"value", best.back()}};
    row["disturbed"] = std::any_of(values.begin(), values.end(), [](const std::vector<double>& of_program) {
      const auto [least, largest] = std::minmax_element(of_program.begin(), of_program.end());
      return is_disturbed(*least, *largest, 0.0);
    });
    if (programs.size() > 1) {
      row["before"] = best.front();
      row["ratio"] = line.better == Better::more ? best.back() / best.front() : best.front() / best.back();
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace sandstroke
