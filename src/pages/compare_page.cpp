#include "pages/compare_page.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "compare/compare_runs.h"
#include "core/asset.h"
#include "core/error.h"
#include "pages/curves.h"
#include "pages/maps.h"
#include "pages/sand_part.h"
#include "report/page.h"

SANDSTROKE_DECLARE_ASSET(compare);

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// One side of the comparison: its file, name and value of its provenance, its resolved scene. The page calls
/// it "golden" or "run" unless it has a label.
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
  const nlohmann::json compared = to_json(comparison);
  return {SANDSTROKE_ASSET(compare),
          title,
          {{"machine", describe_machine()},
           {"passed", comparison.passed()},
           {"checks", compared["checks"]},
           {"tolerances", compared["tolerances"]},
           {"settings", compared["settings"]},
           {"golden", std::move(golden)},
           {"run", std::move(run)},
           {"parts", Json::array()},
           {"missing", Json::array()}}};
}

bool failed(const Comparison& comparison, const std::string& name) {
  return std::any_of(comparison.checks.begin(), comparison.checks.end(),
                     [&](const Check& check) { return check.name == name && !check.passed; });
}

/// A page on two files. It calls them by their names, or by their whole paths where the names are the same.
PageOfParts start_page_of_files(const fs::path& golden_file, const fs::path& run_file,
                                const Comparison& comparison, Json golden, Json run) {
  const bool same = golden_file.filename() == run_file.filename();
  const std::string a = (same ? golden_file : golden_file.filename()).string(),
                    b = (same ? run_file : run_file.filename()).string();
  if (a != b) {
    golden["label"] = a;
    run["label"] = b;
  }
  return start_page(fmt::format("{} against {}", b, a), comparison, std::move(golden), std::move(run));
}

}  // namespace

PageOfParts run_page(const RunFile& golden, const RunFile& run, const Comparison& comparison,
                     const Tolerances& tolerances, bool coarsen) {
  PageOfParts page = start_page_of_files(golden.name(), run.name(), comparison, side(golden), side(run));
  if (failed(comparison, "initial height")) {
    page.add_part("Initial height", [&]() -> Json {
      const RunPair pair = run_pair(golden, run, coarsen);
      const HeightField a = pair.golden.initial(), b = pair.run.initial();
      if (a.rows() != b.rows() || a.cols() != b.cols()) return nullptr;  // "Final height" says so
      return surfaces_part({"Initial height", a, a, b, b, tolerances.height});
    });
  }
  std::optional<HeightField> a, b;  // final, once they are read
  page.add_part("Final height", [&] {
    const RunPair pair = run_pair(golden, run, coarsen);
    a = pair.golden.final();
    b = pair.run.final();
    return surfaces_part(
        {"Final height", *a, pair.golden.initial(), *b, pair.run.initial(), tolerances.height});
  });
  page.add_part("Both in 3-D", [&]() -> Json {
    if (!a || !b || a->rows() != b->rows() || a->cols() != b->cols()) return nullptr;
    SandPart part("Both in 3-D", "The final surfaces and their difference.", *a);
    part.add(page.data["golden"].value("label", "golden"), *a);
    part.add(page.data["run"].value("label", "run"), *b);
    part.offer_difference("by the difference");
    return part.json();
  });
  page.add_part("Traces", [&] { return traces_part(whole_trace(golden), whole_trace(run), tolerances); });
  return page;
}

PageOfParts picture_page(const fs::path& golden_file, const Image& golden, const fs::path& run_file,
                         const Image& run, const Comparison& comparison, const Tolerances& tolerances) {
  PageOfParts page = start_page_of_files(golden_file, run_file, comparison, side(golden_file.string()),
                                         side(run_file.string()));
  page.add_part("Picture",
                [&] { return pictures_part("Picture", golden, run, static_cast<int>(tolerances.pixel)); });
  return page;
}

PageOfParts golden_page(const GoldenEntry& entry, const GoldenRun& run_of_scene, const Comparison& comparison,
                        const Tolerances& tolerances) {
  const RunFile run(run_of_scene.run_file);
  Json run_side = side(run);
  run_side["name"] = fmt::format("the run of scene {}", entry.name);
  PageOfParts page =
      start_page(fmt::format("{} against its golden entry", entry.name), comparison,
                 side(entry.folder.string(), as_far_as_known([&] { return golden_provenance(entry); }),
                      as_far_as_known([&] { return read_golden(entry).scene; })),
                 run_side);
  page.add_part("Change of height", [&] {
    const GoldenContent golden = read_golden(entry);
    const HeightField expected(golden.change, golden.cell_size), change(height_change(run), golden.cell_size);
    const HeightField none(expected.rows(), expected.cols(), expected.cell_size());
    const HeightField none_of_run(change.rows(), change.cols(), change.cell_size());
    return surfaces_part(
        {"Change of height", expected, none, change, none_of_run, tolerances.height, ColourScale::diverging});
  });
  page.add_part("Picture", [&] {
    return pictures_part("Picture", read_golden_picture(entry), run_of_scene.picture,
                         static_cast<int>(tolerances.pixel));
  });
  page.add_part("Traces",
                [&] { return traces_part(read_golden(entry).trace, whole_trace(run), tolerances); });
  return page;
}

}  // namespace sandstroke
