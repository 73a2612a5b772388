#pragma once

#include <functional>
#include <string>
#include <vector>

#include "validation/study/problem.h"

namespace sandstroke {

/// One contender's result.
struct StudyRun {
  std::string problem, series, label;
  RunSettings settings;
  double step = not_applicable;  ///< Contender::step
  double wall_seconds = 0.0;     ///< least of the repeats: nothing makes a run faster than it is
  double median_seconds = 0.0, largest_seconds = 0.0;
  double repeats = 0;
  bool disturbed = false;  ///< by other programs: is_disturbed() of the repeats
  Score score;
  double error = not_applicable;     ///< the problem's
  double of_paper = not_applicable;  ///< time of a tick, over that of the paper's law in the same study
  bool pareto = false;               ///< no other run of the problem is both as near and as fast
  bool foreign = false;              ///< Contender::foreign
};

/// How a series' error falls with its step: log error = order * log step + constant by least squares, with
/// the 95 % confidence interval of the order (Student's t).
struct ConvergenceOrder {
  std::string problem, series, error;
  double order, low, high;
  int points;
};

struct Study {
  bool quick = false;
  std::vector<Problem> problems;  ///< with their contenders
  std::vector<StudyRun> runs;
  std::vector<ConvergenceOrder> orders;
  std::vector<ErrorCheck> estimates;
  std::vector<std::string> notes;  ///< what was left out, and why
};

struct StudyOptions : ProblemOptions {
  std::vector<std::string> problems;                     ///< names; empty: all
  int repeats = 0;                                       ///< of each run, at most; 0: 5, quick 3
  std::function<void(double)> progress = [](double) {};  ///< share that is done
};

/// Runs every contender of every problem, the repeats in turn (all once, then all again, ...), so that the
/// machine's drift hits all alike. Ends early, incomplete, when interrupted(). Error: input, for a problem
/// that is not known.
Study run_study(const StudyOptions& options);

/// Whether times of the same work [s] say that the machine was busy with something else: they differ by more
/// than 20 % of the least, or more than 20 % of the least was spent waiting for a processor. waited [s]: of
/// the least.
bool is_disturbed(double least, double largest, double waited);

/// Sets `pareto` of runs with an error, problem by problem.
void mark_pareto(std::vector<StudyRun>& runs);

/// Sets `of_paper` of runs that time ticks: over the run with the same tool and label under the paper's law.
void compare_ticks(std::vector<StudyRun>& runs);

/// Of points (step, error), all above 0, with at least 3 different steps; not_applicable otherwise.
ConvergenceOrder fit_order(const std::vector<std::pair<double, double>>& points);

}  // namespace sandstroke
