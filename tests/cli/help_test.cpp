#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <regex>
#include <set>

#include "cli/program.h"
#include "io/scene_keys.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

std::string printed(const std::vector<std::string>& arguments) {
  const ProgramResult result = run_program(arguments, testing::TempDir());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return result.out;
}

std::string in_one_line(const std::string& text) { return std::regex_replace(text, std::regex("\\s+"), " "); }

/// A manual page as one reads it: without the marks of roff.
std::string page(const std::vector<std::string>& arguments) {
  const std::string dashes = std::regex_replace(printed(arguments), std::regex(R"(\\-)"), "-");
  return in_one_line(std::regex_replace(dashes, std::regex(R"(\\f[BIR]|\\&)"), ""));
}

TEST(CliHelp, ThePageOfTheProgramHasEveryOptionOfEveryCommand) {
  const std::string manual = page({"help", "--man"});
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{{"run"},
                                                                                       {"render"},
                                                                                       {"report"},
                                                                                       {"compare"},
                                                                                       {"golden", "check"},
                                                                                       {"sweep"},
                                                                                       {"sweep", "status"},
                                                                                       {"stroke", "convert"},
                                                                                       {"record"},
                                                                                       {"bench"},
                                                                                       {"stress"},
                                                                                       {"info"},
                                                                                       {"init"}}) {
    std::vector<std::string> words = {"help"};
    words.insert(words.end(), command.begin(), command.end());
    const std::string help = printed(words);
    std::string name;
    for (const std::string& word : command) name += " " + word;
    EXPECT_NE(manual.find(".SS sandstroke" + name), std::string::npos) << name;
    const std::regex option("\n  (-\\S+)");
    int options = 0;
    for (std::sregex_iterator found(help.begin(), help.end(), option), end; found != end; ++found, ++options)
      EXPECT_NE(manual.find((*found)[1].str()), std::string::npos) << name << (*found)[1];
    EXPECT_GT(options, 0) << name;
  }
}

TEST(CliHelp, OptionsSayTheirDefaults) {
  // The part of a command's help on one option: to the next one.
  const auto help_of = [](const std::string& command, const std::string& option) {
    const std::string help = printed({"help", command});
    const std::size_t begin = help.find("\n  " + option + " ");
    EXPECT_NE(begin, std::string::npos) << option;
    return in_one_line(help.substr(begin, help.find("\n  -", begin + 1) - begin));
  };
  for (const char* option : {"--size", "--view", "--style", "--azimuth", "--elevation", "--distance",
                             "--target", "--light-azimuth", "--light-elevation"})
    EXPECT_NE(help_of("render", option).find("Default: the scene's [view]"), std::string::npos) << option;
  EXPECT_NE(help_of("render", "--contour").find("Default: 0"), std::string::npos);
  EXPECT_NE(help_of("run", "--threads").find("Default: 0"), std::string::npos);
  EXPECT_NE(help_of("record", "--stop-switch").find("counted from 0"), std::string::npos);
}

TEST(CliHelp, ValuesAreInAReadersWords) {
  for (const std::string command :
       {"run", "render", "export", "compare", "sweep", "record", "bench", "stroke convert"}) {
    std::vector<std::string> words = {"help"};
    for (std::istringstream parts(command); parts >> words.emplace_back();) {
    }
    words.pop_back();
    const std::string help = printed(words);
    for (const char* type : {"FLOAT", "INT:", "TEXT:", "Needs:", "Excludes:", "POSITIVE", " in ["})
      EXPECT_EQ(help.find(type), std::string::npos) << command << ": " << type;
  }
  const std::string run = printed({"help", "run"}), compare = printed({"compare", "--help"});
  EXPECT_NE(run.find("--frames NUMBER >= 0 "), std::string::npos) << run;
  EXPECT_NE(run.find("--threads 0 to 1024 "), std::string::npos) << run;
  EXPECT_NE(run.find("--estimate-error[={coarser,finer}]"), std::string::npos) << run;
  EXPECT_NE(compare.find("--pixel-tolerance NUMBER from 0 to 255 (default 2)"), std::string::npos) << compare;
  EXPECT_NE(printed({"help", "sweep"}).find("--shard I/N (not with --dry-run, --slurm)"), std::string::npos);
}

TEST(CliHelp, ExplainsFilesInTopics) {
  for (const auto& [command, topic] :
       std::map<std::string, std::string>{{"sweep", "plan"}, {"script", "script"}}) {
    const std::string help =
        command == "sweep" ? printed({"sweep", "--help"}) : printed({"stroke", "script", "--help"});
    EXPECT_LT(std::count(help.begin(), help.end(), '\n'), 50) << help;
    EXPECT_NE(help.find("sandstroke help " + topic), std::string::npos) << help;
  }
}

TEST(CliHelp, ScenesAreExplainedKeyByKey) {
  const std::string manual = page({"help", "--man", "scene"}), table = printed({"help", "scene"});
  EXPECT_EQ(table, printed({"info", "--scene-keys"}));
  for (const KeySection& section : all_scene_keys())
    for (const KeyRow& key : section.keys) {
      const std::string value = key.value.empty() ? "" : " = " + key.value;
      EXPECT_NE(manual.find(key.name + value), std::string::npos) << key.name;
      EXPECT_NE(manual.find(key.explanation()), std::string::npos) << key.name;
      EXPECT_NE(table.find(key.explanation()), std::string::npos) << key.name;
    }
}

TEST(CliHelp, MetricsAreDefinedWithTheirUnits) {
  const std::string manual = page({"help", "--man", "metrics"}), table = printed({"help", "metrics"});
  const ProgramResult refused = run_program({"sweep", "plan.toml", "-o", "out"}, [] {
    const fs::path folder = test_folder();
    write_file(folder / "plan.toml",
               "[sweep]\nscene = \"scene.toml\"\nmetrics = [\"slope_max\"]\n[axes]\nforce.k_s = [1.0]\n");
    return folder;
  }());
  EXPECT_EQ(refused.exit_code, 2);
  // All that a plan may name are explained, with formula and unit.
  std::istringstream names(refused.err.substr(refused.err.find("take from: ") + 11));
  int count = 0;
  for (std::string name; std::getline(names, name, ',') && name.find('(') == std::string::npos; ++count) {
    name = name.substr(name.find_first_not_of(' '));
    EXPECT_NE(table.find("\n  " + name + " "), std::string::npos) << name << table;
    EXPECT_NE(manual.find(name + " "), std::string::npos) << name;
  }
  EXPECT_GT(count, 15);
  EXPECT_NE(refused.err.find("slope_max is now slope_max_geometric"), std::string::npos) << refused.err;
  for (const char* text : {"N s/m", "sum (h - h_golden) dx^2", "relaxation.talus_angle"})
    EXPECT_NE(table.find(text), std::string::npos) << text;
}

TEST(CliHelp, HasNoPageOfWhatIsNotThere) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"help", "sand"}, {"help", "--man", "run"}, {"help", "run", "x"}}) {
    const ProgramResult result = run_program(words, testing::TempDir());
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find("scene, script, plan, metrics, warnings"), std::string::npos) << result.err;
  }
}

/// The words that bash offers for the last of these, parted as bash does it, by the folder's file
/// `completion`.
std::set<std::string> completed(const fs::path& folder, const std::string& words) {
  write_file(folder / "ask", "set -u\nsource ./completion\nCOMP_WORDS=(sandstroke " + words +
                                 ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\ncompopt() { :; }\n_sandstroke\n"
                                 "printf '%s\\n' \"${COMPREPLY[@]}\" > answer\n");
  EXPECT_EQ(std::system(("cd '" + folder.string() + "' && bash --norc ./ask").c_str()), 0) << words;
  std::istringstream answer(read_file(folder / "answer"));
  std::set<std::string> offered;
  for (std::string line; std::getline(answer, line);)
    if (!line.empty()) offered.insert(line);
  return offered;
}

TEST(CliCompletion, BashOffersWhatCanStandThere) {
  using Offered = std::set<std::string>;
  const fs::path folder = test_folder();  // scene.toml, line.toml
  write_file(folder / "run.h5", "");
  write_file(folder / "with blank.h5", "");
  write_file(folder / "picture.png", "");
  fs::create_directories(folder / "strokes/hole");
  write_file(folder / "strokes/hole/scene.toml", "");
  write_file(folder / "completion", printed({"completion", "bash"}));
  const auto offered = [&](const std::string& words) { return completed(folder, words); };

  EXPECT_EQ(offered("st"), (Offered{"stress", "stroke"}));
  EXPECT_EQ(offered("stroke ''"), (Offered{"convert", "info", "repair", "script"}));
  EXPECT_EQ(offered("golden ch"), Offered{"check"});
  EXPECT_EQ(offered("sweep st"), Offered{"status"});
  EXPECT_EQ(offered("sweep sc"), Offered{"scene.toml"});
  EXPECT_EQ(offered("run --est"), Offered{"--estimate-error"});
  EXPECT_EQ(offered("-q run --thr"), Offered{"--threads"});
  EXPECT_EQ(offered("run --qu"), Offered{"--quiet"});
  EXPECT_EQ(offered("render --view ''"), (Offered{"custom", "overview", "stroke", "top"}));
  EXPECT_EQ(offered("render --view = st"), Offered{"stroke"});
  EXPECT_EQ(offered("stroke convert --equal-times s"), Offered{"spread"});
  EXPECT_EQ(offered("render --frame ''"), (Offered{"all", "final", "initial"}));
  EXPECT_EQ(offered("record --device s"), Offered{"scripted:"});
  EXPECT_EQ(offered("run --estimate-error = c"), Offered{"coarser"});
  EXPECT_EQ(offered("run --estimate-error s"), (Offered{"scene.toml", "strokes"}));
  EXPECT_EQ(offered("help sc"), (Offered{"scene", "script"}));
  EXPECT_EQ(offered("completion ''"), (Offered{"bash", "zsh"}));

  EXPECT_EQ(offered("run ''"), (Offered{"scene.toml", "line.toml", "strokes"}));
  EXPECT_EQ(offered("render ''"), (Offered{"run.h5", "with blank.h5", "strokes"}));
  EXPECT_EQ(offered("compare run.h5 p"), Offered{"picture.png"});
  EXPECT_EQ(offered("run -o results --stroke = l"), Offered{"line.toml"});
  EXPECT_EQ(offered("bench --output s"), Offered{"strokes"});
  EXPECT_EQ(offered("golden check ''"), Offered{"hole"});
  EXPECT_EQ(offered("golden check --json h"), Offered{"hole"});

  EXPECT_EQ(offered("run --set displacement."), (Offered{"displacement.deposit=", "displacement.distance="}));
  EXPECT_EQ(offered("run --set tool.profile ="), (Offered{"paper", "sphere"}));
  EXPECT_EQ(offered("run --set tool.profile = s"), Offered{"sphere"});
  EXPECT_EQ(offered("run --set tool.radius = 1"), Offered{});
  EXPECT_EQ(offered("run --threads ''"), Offered{});
}

}  // namespace
}  // namespace sandstroke
