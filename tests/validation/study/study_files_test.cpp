#include "validation/study/study_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "core/error.h"
#include "core/input_file.h"
#include "core/output_file.h"
#include "hdf5/hdf5_reader.h"
#include "test_folder.h"
#include "validation/study/surface_error.h"

namespace sandstroke {
namespace {

TEST(StudyFilesTest, PageTableAndDataSayTheSame) {
  Study study;
  study.problems.push_back({"heap", "Work of a heap", "What it is.", "work_error", "work", "", {}});
  for (const double error : {0.5, 0.25}) {
    StudyRun run;
    run.problem = "heap";
    run.series = "s, t";
    run.label = "l";
    run.score.work_error = run.error = error;
    study.runs.push_back(run);
  }
  study.runs[1].score.slope_errors.assign(flank_directions().size(), 2.0);
  const TestFolder folder;
  const StudyFiles files(folder / "new/folder");
  files.write(study);
  const std::string csv = read_text_file(folder / "new/folder/bench.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), static_cast<int>(study.runs.size()) + 1);
  const Hdf5Reader data(folder / "new/folder/bench.h5");
  const std::vector<double> errors = data.doubles("/runs/work_error");
  for (std::size_t i = 0; i < study.runs.size(); ++i) EXPECT_EQ(errors[i], study.runs[i].error);
  EXPECT_EQ(data.text_attribute("/runs/wall_seconds", "units"), "s");
  EXPECT_TRUE(std::isnan(data.grid("/slope_error")(0, 0)));
  EXPECT_EQ(data.grid("/slope_error")(1, 35), 2.0);
  EXPECT_NE(read_text_file(files.page()).find("Work of a heap"), std::string::npos);
}

TEST(StudyFilesTest, APathThatCannotBeWrittenIsRefusedAtOnce) {
  const TestFolder folder;
  std::ofstream(folder / "file") << "text";
  try {
    StudyFiles(folder / "file");
    FAIL();
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::io);
  }
}

}  // namespace
}  // namespace sandstroke
