#include "cli/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <memory>
#include <sstream>

#include "reset_signals.h"
#include "test_folder.h"

namespace sandstroke {
namespace fs = std::filesystem;

std::string read_file(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void write_file(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

namespace {

std::string written_to(int file) {
  std::string text(static_cast<std::size_t>(lseek(file, 0, SEEK_END)), '\0');
  return pread(file, text.data(), text.size(), 0) < 0 ? "" : text;
}

/// The settings of the program that is executed next.
void refuse_real_time() {
  const rlimit none{0, 0};
  setrlimit(RLIMIT_RTPRIO, &none);
  setrlimit(RLIMIT_MEMLOCK, &none);
  prctl(PR_CAPBSET_DROP, CAP_SYS_NICE);  // root's; others have none
  prctl(PR_CAPBSET_DROP, CAP_IPC_LOCK);
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& arguments, const fs::path& folder,
                          const Conditions& conditions) {
  // The output stays in memory: the folder may be full, read-only, or gone.
  const int out = conditions.out ? open(conditions.out, O_WRONLY | O_CLOEXEC)
                                 : memfd_create("out", MFD_CLOEXEC),
            err = memfd_create("err", MFD_CLOEXEC);
  std::vector<char*> argv = {const_cast<char*>("sandstroke")};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) {
    reset_signals();
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    if (conditions.most_file_bytes > 0) {
      const rlimit limit{conditions.most_file_bytes, conditions.most_file_bytes};
      setrlimit(RLIMIT_FSIZE, &limit);
    }
    if (!conditions.path.empty()) setenv("PATH", conditions.path.c_str(), 1);
    if (conditions.real_time_refused) refuse_real_time();
    if (conditions.in_child) conditions.in_child();
    if (chdir(folder.c_str()) == 0) execv(SANDSTROKE_PROGRAM, argv.data());
    _exit(127);
  }
  const auto ended = [child] {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == child;
  };
  if (conditions.signal) {
    if (conditions.when)
      while (!conditions.when() && !ended()) usleep(2000);
    else
      usleep(static_cast<useconds_t>(1000 * conditions.after_ms));
    kill(child, conditions.signal);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  ProgramResult result;
  result.peak_memory = 1024.0 * static_cast<double>(usage.ru_maxrss);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (!conditions.out) result.out = written_to(out);
  result.err = written_to(err);
  close(out);
  close(err);
  return result;
}

fs::path test_folder() {
  // The folder belongs to this process, for several may run the same tests; it stays where one fails.
  static const std::shared_ptr<TestFolder> all(new TestFolder, [](const TestFolder* folder) {
    if (!testing::UnitTest::GetInstance()->Failed()) delete folder;
  });
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test->test_suite_name()) + "_" + test->name();
  for (char& c : name) c = c == '/' ? '_' : c;
  const fs::path folder = *all / name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  write_file(folder / "scene.toml",
             "[bed]\nsize = [0.3, 0.2]\ncells = [150, 100]\n[stroke]\nfile = \"line.toml\"\n[view]\nsize = "
             "[320, 180]\n");
  write_file(
      folder / "line.toml",
      "start = [-0.05, 0.0]\nspeed = 0.2\n[[segment]]\nkind = \"line\"\nto = [0.05, 0.0]\ndepth = 0.004\n");
  return folder;
}

void expect_run_refused(const std::string& scene, const std::vector<std::string>& settings,
                        const std::string& sentence, const fs::path& folder) {
  std::vector<std::string> words = {"run", scene, "-o", "refused.h5"};
  for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
  const ProgramResult run = run_program(words, folder);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find(sentence), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(folder / "refused.h5"));
}

}  // namespace sandstroke
