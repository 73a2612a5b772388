#include "validation/study/study_table.h"

#include <gtest/gtest.h>

#include "validation/study/study_summary.h"
#include "validation/study/surface_error.h"

namespace sandstroke {
namespace {

Study small_study() {
  Study study;
  study.problems.push_back({"heap", "A heap", "What it is.", "l1", "misplaced sand", "", {}});
  for (const double error : {0.5, 0.25, 0.24}) {
    StudyRun run;
    run.problem = "heap";
    run.series = "s";
    run.label = "l";
    run.wall_seconds = 1.0 / error;
    run.score.l1 = run.error = error;
    run.pareto = true;
    study.runs.push_back(run);
  }
  study.runs[1].score.slope_errors.assign(flank_directions().size(), 2.0);
  study.orders.push_back({"heap", "s", "l1", 1.0, 0.9, 1.1, 3});
  study.estimates.push_back({"heap", "a", "force", 2.0, 1.0});
  study.notes = {"left out"};
  return study;
}

TEST(StudyJson, HoldsEveryColumnOfEveryRunAndWhatIsNoNumberAsNull) {
  const nlohmann::ordered_json json = study_json(small_study());
  ASSERT_EQ(json["runs"].size(), 3u);
  for (const auto& column : json["columns"])
    EXPECT_TRUE(json["runs"][0].contains(column["name"].get<std::string>())) << column["name"];
  EXPECT_EQ(json["runs"][0]["l1"], 0.5);
  EXPECT_TRUE(json["runs"][0]["work_error"].is_null());
  EXPECT_TRUE(json["runs"][0]["slope_error"].is_null());
  EXPECT_EQ(json["runs"][1]["slope_error"].size(), json["runs"][1]["directions"].size());
  EXPECT_EQ(json["runs"][0]["pareto"], true);
  EXPECT_TRUE(json["problems"][0]["converged_to"].is_null());
  EXPECT_EQ(json["orders"][0]["low"], 0.9);
  EXPECT_EQ(json["estimates"][0]["ratio"], 2.0);
  EXPECT_EQ(json["notes"][0], "left out");
}

TEST(StudyJson, HoldsWhatComesWithAProblem) {
  Study study = small_study();
  Problem& heap = study.problems[0];
  heap.plots = {{"Stress",
                 "note",
                 "angle",
                 "°",
                 "stress",
                 {{"flat", Plot::Look::dashed, {0.0, 1.0}, {2.0, 3.0}}},
                 {{Plot::Look::dashed, "a theory"}}}};
  heap.measured = {{"sand", "a plate", 2.0, 2.5, "somebody"}};
  const nlohmann::ordered_json json = study_json(study)["problems"][0];
  EXPECT_EQ(json["plots"][0]["curves"][0]["look"], "dashed");
  EXPECT_EQ(json["plots"][0]["curves"][0]["y"], nlohmann::ordered_json({2.0, 3.0}));
  EXPECT_EQ(json["plots"][0]["looks"][0]["text"], "a theory");
  EXPECT_EQ(json["measured"][0]["off"], 0.25);
  EXPECT_EQ(json["times_ticks"], false);
}

TEST(StudySummary, SaysWhatTicksTake) {
  Study study = small_study();
  study.runs[0].settings.tool = "rake";
  study.runs[0].settings.force_law = "rft";
  study.runs[0].of_paper = 2.25;
  const std::string text = study_summary(study);
  EXPECT_NE(text.find("rake"), std::string::npos) << text;
  EXPECT_NE(text.find("2.25"), std::string::npos) << text;
}

TEST(StudySummary, MarksWhatABusyMachineDisturbed) {
  Study study = small_study();
  EXPECT_EQ(study_summary(study).find('*'), std::string::npos);
  EXPECT_EQ(study_json(study)["disturbance"], "");
  study.runs[2].disturbed = true;
  study.runs[0].disturbed = true;
  study.runs[0].of_paper = 2.25;
  const std::string text = study_summary(study);
  EXPECT_NE(text.find("0.24  *\n"), std::string::npos) << text;
  EXPECT_NE(text.find("2.25  *\n"), std::string::npos) << text;
  EXPECT_NE(text.find("2 of 3 runs (marked *) were disturbed"), std::string::npos) << text;
  const nlohmann::ordered_json json = study_json(study);
  EXPECT_NE(json["disturbance"].get<std::string>().find("2 of 3 runs"), std::string::npos);
  EXPECT_EQ(json["runs"][2]["disturbed"], true);
  EXPECT_EQ(json["runs"][1]["disturbed"], false);
  EXPECT_NE(csv_text(runs_table(study.runs)).find(",disturbed,"), std::string::npos);
}

TEST(StudySummary, NamesTheNearestAndTheFastestThatIsNearlyAsNear) {
  const std::string text = study_summary(small_study());
  EXPECT_NE(text.find("0.24\n"), std::string::npos) << text;
  EXPECT_NE(text.find("0.25\n"), std::string::npos) << text;  // 0.5 is more than twice 0.24
  EXPECT_EQ(text.find("0.5\n"), std::string::npos) << text;
  EXPECT_NE(text.find("left out"), std::string::npos) << text;
}

TEST(StudyColumns, AreFoundByName) {
  EXPECT_EQ(number_in("l1", small_study().runs[0]), 0.5);
  EXPECT_ANY_THROW(number_in("weather", small_study().runs[0]));
}

}  // namespace
}  // namespace sandstroke
