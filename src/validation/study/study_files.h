#pragma once

#include <filesystem>

#include "validation/study/study.h"

namespace sandstroke {

/// Where a study's report goes: FOLDER/bench.html, bench.csv and bench.h5. The folder is made; files of an
/// earlier study are replaced, each when its successor is complete.
class StudyFiles {
 public:
  /// Refuses, before any work is done, a place that cannot be written. Error: io.
  explicit StudyFiles(const std::filesystem::path& folder);
  std::filesystem::path page() const { return folder_ / "bench.html"; }
  /// bench.h5: /runs/COLUMN (n), /orders/COLUMN, and /slope_error (n, directions) in deg, NaN where a problem
  /// has no flanks, with /directions in deg. Error: io.
  void write(const Study& study) const;

 private:
  std::filesystem::path table() const { return folder_ / "bench.csv"; }
  std::filesystem::path data() const { return folder_ / "bench.h5"; }
  std::filesystem::path folder_;
};

}  // namespace sandstroke
