#pragma once

#include <map>

#include "cli/program.h"

namespace sandstroke {

/// A command of the program with all that it takes and makes, to be disturbed.
struct FaultedCommand {
  const char* name;
  std::vector<std::string> arguments;
  void (*prepare)(const std::filesystem::path& folder);  ///< puts in place what it reads
  std::vector<std::string> products;                     ///< the files it makes
  bool together = false;  ///< its products are all as they were or all new, never a mixture
  bool records = false;   ///< no two recordings are the same, and none is written over
};
extern const FaultedCommand run_command, sweep_command, golden_command, record_command, render_command;
/// Runs the program in the folder, where it must succeed.
void make(const std::vector<std::string>& arguments, const std::filesystem::path& folder);
void PrintTo(const FaultedCommand& command, std::ostream* out);

/// The same command in the same state, again and again.
class Disturbed {
 public:
  /// Runs it once undisturbed.
  explicit Disturbed(const FaultedCommand& command);
  Disturbed(const Disturbed&) = delete;
  ~Disturbed();

  double seconds() const { return seconds_; }              ///< that it takes undisturbed
  const std::string& printed() const { return printed_; }  ///< undisturbed, to standard output
  /// Runs it in a fresh folder: prepare() and start().
  ProgramResult run(const Conditions& conditions);
  void prepare();
  ProgramResult start(Conditions conditions = {}) const;
  /// Numbers of calls when it is undisturbed.
  struct Counts {
    long changes = 0;  ///< of files
    long reads = 0;    ///< of the user's files
  };
  Counts calls();
  const std::filesystem::path& folder() const { return folder_; }
  long kilobytes_before() const { return kilobytes_before_; }
  long kilobytes_after() const { return kilobytes_after_; }

  /// Nothing looks complete that is not, and each product is as before or as it should be. Else a failure of
  /// the test, which says where.
  void expect_nothing_half(const std::string& where) const;
  /// The same command now gives what it gives undisturbed.
  void expect_rerun(const std::string& where) const;
  /// "nothing", "as before", "new" ... : what is there now.
  std::string state() const;

 private:
  using Products = std::map<std::string, std::string>;
  Products products() const;

  const FaultedCommand& command_;
  std::filesystem::path inputs_, folder_;
  Products before_, after_;  // contents
  double seconds_ = 0.0;
  std::string printed_;
  long kilobytes_before_ = 0, kilobytes_after_ = 0;  // of all files
};

/// Sets SANDSTROKE_FAULT for tests/faulty_system.cpp, under which the program is run.
std::function<void()> faulty_system(const std::string& fault);
/// Some of so many calls, counted from 1: all of the last ones, where results are put in place, and as many
/// of those before.
std::vector<long> some_calls(long calls);

/// The end of the program, and the state of its files now, in words.
std::string outcome(const ProgramResult& result, const Disturbed& disturbed);

/// SANDSTROKE_FAULT_REPEATS of the environment, or a few.
int fault_repeats();

/// Adds a row to the table of faults, where the environment names a file for it: SANDSTROKE_FAULT_TABLE.
void tell(const std::string& fault, const std::string& command, int times, const std::string& outcome);
/// The same, with how often there was each outcome.
void tell(const std::string& fault, const std::string& command, const std::map<std::string, int>& outcomes);

}  // namespace sandstroke
