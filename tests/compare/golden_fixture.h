#pragma once

#include <gtest/gtest.h>

#include "compare/golden.h"
#include "synthetic_run.h"

namespace sandstroke {

/// A made-up run and its golden entry; a test changes the run before it compares them.
class Golden : public testing::Test {
 protected:
  Golden() {
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) picture.pixel(x, y)[0] = static_cast<std::uint8_t>(x % 256);
  }

  GoldenRun finished() {
    run.write(folder / "run.h5");
    return {folder / "run.h5", picture, {}};
  }
  Comparison compare() { return compare_golden(entry(), finished(), Tolerances{}); }

  GoldenEntry entry() const { return {"dune", folder / "golden/dune", "sandstroke golden update dune"}; }

  void expect_only_failure(const std::string& name, const std::string& words) {
    sandstroke::expect_only_failure(compare(), name, words);
  }

  TestFolder folder;
  SyntheticRun run;
  Image picture = Image(720, 405);
};

}  // namespace sandstroke
