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
  double wall_seconds = 0.0;     ///< least of the repeats: disturbances only add time
  double median_seconds = 0.0, largest_seconds = 0.0;
  double repeats = 0;
  bool disturbed = false;  ///< other programs disturbed the repeats (is_disturbed())
  Score score;
  double error = not_applicable;     ///< in the problem's error column
  double of_paper = not_applicable;  ///< time of a tick, over that of the paper's law in the same bench
  bool pareto = false;               ///< no other run of the problem has as small an error and time
  bool external = false;             ///< Contender::external
};

/// The order at which a series' error falls with its step, with its 95 % confidence interval (Student's t).
/// Least squares fit: log error = order * log step + constant.
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
  int repeats = 0;                                       ///< most repeats of each run; 0: 5, quick 3
  std::function<void(double)> progress = [](double) {};  ///< gets the fraction that is done
};

/// Runs every contender of every problem. Takes repeats in turn (all once, then all again, ...), so that
/// drift of the machine affects all alike. Ends early, incomplete, when interrupted(). Error: input, for an
/// unknown problem.
Study run_study(const StudyOptions& options);

/// True if the times of the same work [s] show that the machine was busy: they differ by more than 20 % of
/// the least, or the least includes more than 20 % of waiting for a processor (`waited` [s]).
bool is_disturbed(double least, double largest, double waited);

/// Sets `pareto` in runs that have an error, problem by problem. Errors below `least`
/// (Problem::least_error) count as this error.
void mark_pareto(std::vector<StudyRun>& runs, double least = 0.0);

/// Sets `of_paper` in runs that time ticks: divides by the run with the same tool and label under the paper's
/// law.
void compare_ticks(std::vector<StudyRun>& runs);

/// Fits the order to points (step, error), all above 0. not_applicable with fewer than 3 different steps.
ConvergenceOrder fit_order(const std::vector<std::pair<double, double>>& points);

}  // namespace sandstroke
