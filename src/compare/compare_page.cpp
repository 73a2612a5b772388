#include "compare/compare_page.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "compare/compare_runs.h"
#include "compare/page_curves.h"
#include "compare/page_maps.h"
#include "core/error.h"
#include "report/page.h"

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// One of the two that are compared: its file, name and value of its provenance, its resolved scene.
Json side(const std::string& name, const std::vector<std::pair<std::string, std::string>>& provenance = {},
          const std::string& scene = "") {
  Json entries = Json::array();
  for (const auto& [entry, value] : provenance) entries.push_back({entry, value});
  return {{"name", name}, {"provenance", entries}, {"scene", scene}};
}

Json side(const RunFile& run) {
  return side(run.name(), as_far_as_known([&] { return run.provenance(); }),
              as_far_as_known([&] { return run.scene_text(); }));
}

PageOfParts start_page(const std::string& title, const Comparison& comparison, Json golden, Json run) {
  return {PageScript::compare,
          title,
          {{"machine", describe_machine()},
           {"passed", comparison.passed()},
           {"checks", to_json(comparison)["checks"]},
           {"golden", std::move(golden)},
           {"run", std::move(run)},
           {"parts", Json::array()},
           {"missing", Json::array()}}};
}

bool failed(const Comparison& comparison, const std::string& name) {
  return std::any_of(comparison.checks.begin(), comparison.checks.end(),
                     [&](const Check& check) { return check.name == name && !check.passed; });
}

std::string title_of(const fs::path& golden, const fs::path& run) {
  return fmt::format("{} against {}", run.filename().string(), golden.filename().string());
}

}  // namespace

PageOfParts run_page(const RunFile& golden, const RunFile& run, const Comparison& comparison,
                     const Tolerances& tolerances) {
  PageOfParts page = start_page(title_of(golden.name(), run.name()), comparison, side(golden), side(run));
  if (failed(comparison, "initial height")) {
    page.add_part("Initial height", [&]() -> Json {
      const HeightField a = golden.initial_bed(), b = run.initial_bed();
      if (a.rows() != b.rows() || a.cols() != b.cols()) return nullptr;  // the final ones show that
      return surfaces_part({"Initial height", a, a, b, b, tolerances.height});
    });
  }
  page.add_part("Final height", [&] {
    return surfaces_part({"Final height", golden.final_bed(), golden.initial_bed(), run.final_bed(),
                          run.initial_bed(), tolerances.height});
  });
  page.add_part("Traces", [&] { return traces_part(whole_trace(golden), whole_trace(run), tolerances); });
  return page;
}

PageOfParts picture_page(const fs::path& golden_file, const Image& golden, const fs::path& run_file,
                         const Image& run, const Comparison& comparison, const Tolerances& tolerances) {
  PageOfParts page = start_page(title_of(golden_file, run_file), comparison, side(golden_file.string()),
                                side(run_file.string()));
  page.add_part("Picture", [&] { return pictures_part("Picture", golden, run, tolerances.pixel); });
  return page;
}

PageOfParts golden_page(const std::string& name, const fs::path& entry, const GoldenRun& run_of_scene,
                        const Comparison& comparison, const Tolerances& tolerances) {
  const RunFile run(run_of_scene.run_file);
  Json run_side = side(run);
  run_side["name"] = fmt::format("the run of scene {}", name);
  PageOfParts page =
      start_page(fmt::format("{} against its golden entry", name), comparison,
                 side(entry.string(), as_far_as_known([&] { return golden_provenance(entry); })), run_side);
  page.add_part("Change of height", [&] {
    const GoldenContent golden = read_golden(entry);
    const HeightField expected(golden.change, golden.cell_size), change(height_change(run), golden.cell_size);
    const HeightField none(expected.rows(), expected.cols(), expected.cell_size());
    const HeightField none_of_run(change.rows(), change.cols(), change.cell_size());
    return surfaces_part({"Change of height", expected, none, change, none_of_run, tolerances.height, true});
  });
  page.add_part("Picture", [&] {
    return pictures_part("Picture", read_golden_picture(entry), run_of_scene.picture, tolerances.pixel);
  });
  page.add_part("Traces",
                [&] { return traces_part(read_golden(entry).trace, golden_trace(run), tolerances); });
  return page;
}

}  // namespace sandstroke
