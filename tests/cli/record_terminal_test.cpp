// `record` where somebody sits: at a terminal, with keys and a live line.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>
#include <utmp.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/program.h"
#include "io/stroke_file.h"
#include "reset_signals.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// The program at a terminal; its standard output goes to a file.
class AtTerminal {
 public:
  AtTerminal(const std::vector<std::string>& arguments, const fs::path& folder, const char* typed_ahead = "",
             unsigned short columns = 80, bool in_background = false)
      : out_(folder / ".stdout") {
    const winsize size = {24, columns, 0, 0};
    if (openpty(&master_, &slave_, nullptr, nullptr, &size) != 0) throw std::runtime_error("no terminal");
    before_ = settings();
    type(typed_ahead);
    std::vector<char*> argv = {const_cast<char*>("sandstroke")};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    child_ = fork();
    if (child_ == 0) {
      reset_signals();
      close(master_);
      login_tty(slave_);
      dup2(open(out_.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0644), STDOUT_FILENO);
      // The terminal stays with the group that this process leads; what it starts in another one runs
      // without.
      if (in_background && fork() != 0) {
        int status = 0;
        ::wait(&status);
        _exit(WEXITSTATUS(status));
      }
      if (in_background) setpgid(0, 0);
      if (chdir(folder.c_str()) == 0) execv(SANDSTROKE_PROGRAM, argv.data());
      _exit(127);
    }
  }
  ~AtTerminal() {
    if (!ended_) {
      kill(child_, SIGKILL);
      wait();
    }
    close(master_);
    close(slave_);
  }

  /// Reads what the terminal shows until it has shown this. False: the program ended before.
  bool shows(const std::string& text) {
    while (shown_.find(text) == std::string::npos)
      if (!read_more()) return false;
    return true;
  }
  void type(const char* keys) {
    EXPECT_EQ(write(master_, keys, std::strlen(keys)), static_cast<ssize_t>(std::strlen(keys)));
  }
  void send(int signal) { kill(child_, signal); }
  bool keys_come_unseen() const { return (settings().c_lflag & (ICANON | ECHO)) == 0; }
  bool is_as_before() const {
    const termios now = settings();
    return now.c_lflag == before_.c_lflag && now.c_iflag == before_.c_iflag &&
           now.c_oflag == before_.c_oflag && std::memcmp(now.c_cc, before_.c_cc, sizeof now.c_cc) == 0;
  }
  /// 128 + signal, if one ended it.
  int wait() {
    while (read_more()) {
    }
    int status = 0;
    waitpid(child_, &status, 0);
    ended_ = true;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  /// A line that nobody has read.
  bool has_unread_input() const {
    pollfd input = {slave_, POLLIN, 0};
    return poll(&input, 1, 0) == 1;
  }
  const std::string& shown() const { return shown_; }
  std::string out() const { return read_file(out_); }

 private:
  termios settings() const {
    termios settings{};
    tcgetattr(master_, &settings);
    return settings;
  }
  /// False: the program has ended, and all that it wrote was read.
  bool read_more() {
    siginfo_t info{};
    waitid(P_PID, static_cast<id_t>(child_), &info, WEXITED | WNOHANG | WNOWAIT);
    pollfd output = {master_, POLLIN, 0};
    if (poll(&output, 1, 20) == 0) return info.si_pid != child_;
    char bytes[1024];
    const ssize_t count = read(master_, bytes, sizeof bytes);
    if (count > 0) shown_.append(bytes, static_cast<std::size_t>(count));
    return count > 0;
  }

  fs::path out_;
  int master_ = -1, slave_ = -1;
  pid_t child_ = -1;
  termios before_{};
  std::string shown_;
  bool ended_ = false;
};

/// A hand that rests, for longer than any test waits.
fs::path folder_with_resting_hand() {
  const fs::path folder = test_folder();
  write_file(folder / "line.toml", "[[segment]]\nkind = \"move\"\nto = [0.05, 0.0]\nwait = 300.0\n");
  return folder;
}

const std::vector<std::string> record_to_json = {"record",   "--max-skipped",      "100",   "-o", "a.h5",
                                                 "--device", "scripted:line.toml", "--json"};

TEST(CliRecordTerminal, AKeyEndsARecordingAndTheTerminalIsAsBefore) {
  for (const char* key : {"q", "\033", "\n", " "}) {
    const fs::path folder = folder_with_resting_hand();
    AtTerminal program(record_to_json, folder);
    ASSERT_TRUE(program.shows(" Hz")) << program.shown();
    EXPECT_TRUE(program.keys_come_unseen());
    program.type(key);
    EXPECT_EQ(program.wait(), 0) << program.shown();
    EXPECT_TRUE(program.is_as_before());
    EXPECT_EQ(nlohmann::json::parse(program.out())["stop_reason"], "a key was pressed");
  }
}

TEST(CliRecordTerminal, TheLineSaysWhatIsWaitedFor) {
  const fs::path folder = test_folder();
  std::vector<std::string> arguments = record_to_json;
  arguments.insert(arguments.end(),
                   {"--feel", "scene.toml", "--countdown", "0.3", "--start-at-contact", "--duration", "0.3"});
  AtTerminal program(arguments, folder);
  EXPECT_TRUE(program.shows("record: begins in 0.")) << program.shown();
  EXPECT_TRUE(program.shows("record: touch the sand to begin")) << program.shown();
  EXPECT_TRUE(program.shows(" Hz")) << program.shown();
  EXPECT_EQ(program.wait(), 0) << program.shown();
}

TEST(CliRecordTerminal, TheLineSaysThatTheToolMustBeLifted) {
  const fs::path folder = test_folder();
  Stroke hand;
  for (int i = 0; i <= 300; ++i) {
    hand.time.push_back(0.05 * i);
    hand.position.emplace_back(0.0, 0.0, -0.065);
  }
  write_stroke_file(folder / "resting.h5", hand);
  AtTerminal program({"record", "--max-skipped", "100", "-o", "a.h5", "--device", "replay:resting.h5",
                      "--feel", "scene.toml"},
                     folder);
  EXPECT_TRUE(program.shows(" s: lift the tool out of the sand to begin; q ends it")) << program.shown();
  program.type("q");
  EXPECT_EQ(program.wait(), 0) << program.shown();
}

TEST(CliRecordTerminal, OtherKeysDoNothing) {
  const fs::path folder = folder_with_resting_hand();
  AtTerminal program(record_to_json, folder);
  ASSERT_TRUE(program.shows(" Hz"));
  program.type("x\032");  // Ctrl-Z would leave the hand with the last force
  program.type("\033[A");
  ASSERT_TRUE(program.shows("record 1.")) << program.shown();
  program.type("q");
  EXPECT_EQ(program.wait(), 0) << program.shown();
}

TEST(CliRecordTerminal, APausedTerminalDoesNotPauseTheRecording) {
  const fs::path folder = folder_with_resting_hand();
  AtTerminal program(record_to_json, folder);
  ASSERT_TRUE(program.shows(" Hz")) << program.shown();
  program.type("\023");  // Ctrl-S: nothing is shown until Ctrl-Q
  const auto size = [&] { return fs::file_size(folder / "a.h5.recording"); };
  for (const auto enough = size() + 100'000; size() < enough;) usleep(2000);  // some more lines are due
  program.type("q");
  while (!fs::exists(folder / "a.h5")) usleep(2000);
  program.type("\021");
  EXPECT_EQ(program.wait(), 0) << program.shown();
}

TEST(CliRecordTerminal, SignalsLeaveTheTerminalAsBefore) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGABRT}) {
    const fs::path folder = folder_with_resting_hand();
    AtTerminal program(record_to_json, folder);
    ASSERT_TRUE(program.shows(" Hz")) << program.shown();
    program.send(signal);
    EXPECT_EQ(program.wait(), 128 + signal) << program.shown();
    EXPECT_TRUE(program.is_as_before()) << signal;
    EXPECT_EQ(fs::exists(folder / "a.h5"), signal != SIGABRT);
  }
}

TEST(CliRecordTerminal, CtrlCIsASignal) {
  const fs::path folder = folder_with_resting_hand();
  AtTerminal program(record_to_json, folder);
  ASSERT_TRUE(program.shows(" Hz")) << program.shown();
  program.type("\003");
  EXPECT_EQ(program.wait(), 130) << program.shown();
  EXPECT_TRUE(program.is_as_before());
}

TEST(CliRecordTerminal, AnErrorLeavesTheTerminalAsBefore) {
  const fs::path folder = folder_with_resting_hand();
  AtTerminal program({"record", "-o", "nowhere/a.h5", "--device", "scripted:line.toml"}, folder);
  EXPECT_EQ(program.wait(), 4) << program.shown();
  EXPECT_TRUE(program.is_as_before());
}

TEST(CliRecordTerminal, WhatWasTypedAheadIsForTheShell) {
  const fs::path folder = folder_with_resting_hand();
  std::vector<std::string> arguments = record_to_json;
  arguments.insert(arguments.end(), {"--duration", "0.3"});
  AtTerminal program(arguments, folder, "quit\n");
  EXPECT_EQ(program.wait(), 0) << program.shown();
  EXPECT_EQ(nlohmann::json::parse(program.out())["stop_reason"], "the time was up");
  EXPECT_TRUE(program.has_unread_input());
}

TEST(CliRecordTerminal, TheLineStaysOneLineInANarrowTerminal) {
  const fs::path folder = folder_with_resting_hand();
  constexpr std::size_t columns = 24;
  AtTerminal program(record_to_json, folder, "", columns);
  ASSERT_TRUE(program.shows("record 1.")) << program.shown();
  program.type("q");
  EXPECT_EQ(program.wait(), 0) << program.shown();
  std::istringstream shown(program.shown());
  const std::string erase = "\033[K";
  for (std::string line; std::getline(shown, line, '\r');) {
    EXPECT_EQ(line.find('\n'), line.npos) << line;
    EXPECT_LT(line.substr(0, line.find(erase)).size(), columns) << line;
  }
}

TEST(CliRecordTerminal, DrawsNothingInTheBackground) {
  const fs::path folder = folder_with_resting_hand();
  std::vector<std::string> arguments = record_to_json;
  arguments.insert(arguments.end(), {"--duration", "0.5"});
  AtTerminal program(arguments, folder, "", 80, true);
  EXPECT_EQ(program.wait(), 0) << program.shown();
  EXPECT_EQ(program.shown().find(" Hz"), std::string::npos) << program.shown();
}

TEST(CliRecordTerminal, QuietHidesTheLineAndKeysStillWork) {
  const fs::path folder = folder_with_resting_hand();
  std::vector<std::string> arguments = record_to_json;
  arguments.push_back("--quiet");
  AtTerminal program(arguments, folder);
  while (!fs::exists(folder / "a.h5.recording") || fs::file_size(folder / "a.h5.recording") < 20'000)
    usleep(2000);
  program.type("q");
  EXPECT_EQ(program.wait(), 0) << program.shown();
  EXPECT_EQ(program.shown().find(" Hz"), std::string::npos) << program.shown();
}

}  // namespace
}  // namespace sandstroke
