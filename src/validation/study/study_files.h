#pragma once

#include <filesystem>

#include "validation/study/study.h"

namespace sandstroke {

/// The files of a bench's report: FOLDER/bench.html, bench.csv and bench.h5. Makes the folder. Replaces each
/// file of an earlier bench when the new one is complete.
class StudyFiles {
 public:
  /// Checks, before any work is done, that the files can be written. Error: io.
  explicit StudyFiles(const std::filesystem::path& folder);
  std::filesystem::path page() const { return folder_ / "bench.html"; }
  /// Writes all files. bench.h5 has /runs/COLUMN (n), /orders/COLUMN, /slope_error (n, directions) in deg
  /// (NaN if a problem has no flanks) and /directions in deg. Error: io.
  void write(const Study& study) const;

 private:
  std::filesystem::path table() const { return folder_ / "bench.csv"; }
  std::filesystem::path data() const { return folder_ / "bench.h5"; }
  std::filesystem::path folder_;
};

}  // namespace sandstroke
