// Whatever a user can get wrong: a non-zero exit, one sentence that names the place, and nothing that looks
// complete.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <map>

#include "any_hdf5.h"
#include "cli/program.h"
#include "hdf5/hdf5_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

struct Case {
  std::string name;
  std::vector<std::string> arguments;
  int exit_code;
  std::vector<std::string> parts;            ///< that the sentence must have
  std::map<std::string, std::string> files;  ///< written first
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

const std::string bed = "[bed]\nsize = [0.3, 0.2]\ncells = [150, 100]\n";

Case scene(const std::string& name, const std::string& text, std::vector<std::string> parts) {
  parts.push_back("bad.toml");
  return {name, {"run", "bad.toml", "-o", "out.h5"}, 2, parts, {{"bad.toml", text}}};
}

Case stroke_script(const std::string& name, const std::string& text, std::vector<std::string> parts) {
  parts.push_back("bad.toml");
  return {
      name, {"run", "scene.toml", "-o", "out.h5", "--stroke", "bad.toml"}, 2, parts, {{"bad.toml", text}}};
}

Case csv(const std::string& name, const std::string& text, std::vector<std::string> parts,
         std::vector<std::string> more = {"--rate", "1000"}) {
  std::vector<std::string> arguments = {"stroke",     "convert", "bad.csv",         "out.h5",
                                        "--position", "x,y,z",   "--position-unit", "m"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  parts.push_back("bad.csv");
  return {name, arguments, 2, parts, {{"bad.csv", text}}};
}

const std::vector<Case> cases = {
    {"NoCommand", {}, 2, {"--help"}, {}},
    {"UnknownCommand", {"rnu", "scene.toml"}, 2, {"did you mean run?"}, {}},
    {"UnknownOption", {"run", "scene.toml", "--fast"}, 2, {"--fast"}, {}},
    {"NegativeThreads", {"run", "scene.toml", "--threads", "-1"}, 2, {"threads"}, {}},
    {"MissingScene", {"run", "none.toml", "-o", "out.h5"}, 4, {"none.toml", "cannot be opened"}, {}},
    {"SceneIsAFolder", {"run", ".", "-o", "out.h5"}, 4, {"folder"}, {}},
    scene(
        "ThinPlate",
        "[model]\npreset = \"accurate\"\n" + bed + "[tool]\nshape = \"plate\"\n[stroke]\nfile = \"s.toml\"\n",
        {"2 cells wide at its narrowest (0.004 m)", "needs 3 cells", "bed.cells = [225, 150]",
         "tool.thickness"}),
    scene("ThinRake",
          "[model]\npreset = \"accurate\"\n" + bed +
              "[tool]\nshape = \"rake\"\nradius = 0.0005\n[stroke]\nfile = \"s.toml\"\n",
          {"0.5 cells wide", "tool.radius"}),
    scene("SmallSphere", bed + "[tool]\nradius = 0.0015\n[stroke]\nfile = \"s.toml\"\n",
          {"1.5 cells wide", "needs 2 cells", "tool.radius"}),
    scene("NotToml", "[bed\n", {"bad.toml:1", "TOML"}),
    scene("BinaryScene", std::string("\x89HDF\r\n\x1a\n\0\0", 10), {"TOML"}),
    scene("UnknownKey", bed + "[relaxation]\ntalus = 30\n",
          {"bad.toml:5", "relaxation.talus", "did you mean relaxation.talus_angle"}),
    scene("UnknownSection", bed + "[relax]\nrate = 30\n", {"bad.toml:4", "relax"}),
    scene("WrongType", bed + "[tool]\nradius = \"big\"\n",
          {"bad.toml:5", "tool.radius", "a string", "give a number"}),
    scene("NegativeRadius", bed + "[tool]\nradius = -0.01\n",
          {"bad.toml:5", "tool.radius", "-0.01", "above 0"}),
    scene("NanRadius", bed + "[tool]\nradius = nan\n", {"bad.toml:5", "tool.radius", "finite"}),
    scene("TalusZero", bed + "[relaxation]\ntalus_angle = 0.0\n", {"talus_angle", "above 0 and below 90"}),
    scene("TalusNinety", bed + "[relaxation]\ntalus_angle = 90\n", {"talus_angle", "above 0 and below 90"}),
    scene("UnknownLaw", bed + "[relaxation]\nlaw = \"granular\"\n",
          {"relaxation.law", "granular", "paper, isotropic"}),
    scene("NoCells", "[bed]\ncells = [0, 0]\n", {"bad.toml:2", "bed.cells"}),
    scene("OblongCells", "[bed]\ncells = [100, 200]\n", {"square"}),
    scene("BedBeyondMemory",
          "[bed]\ncells = [65536, 65536]\nsurface = { kind = \"noise\", amplitude = 1.0 }\n",
          {"bed.cells", "memory"}),
    scene("ToolLargerThanTheBed", bed + "[tool]\nradius = 0.2\n[stroke]\nfile = \"line.toml\"\n",
          {"tool.radius", "do not fit"}),
    scene("CellsWithoutVolume", "[bed]\nsize = [1e-150, 1e-150]\ncells = [10, 10]\n", {"bed.size", "1e-100"}),
    scene("ToolSmallerThanACell", bed + "[tool]\nradius = 0.0001\n[stroke]\nfile = \"line.toml\"\n",
          {"0.1 cells wide", "needs 2 cells", "tool.radius"}),
    scene("UnstableShare", bed + "[relaxation]\nlaw = \"isotropic\"\nshare = 0.5\n",
          {"relaxation.share", "0.25"}),
    scene("LevelsOfThePublishedLaw", bed + "[relaxation]\nmethod = \"multilevel\"\n",
          {"relaxation.method", "isotropic", "rkl"}),
    scene("StrokeWithoutFile", bed + "[stroke]\nscale = 2.0\n", {"stroke.file"}),
    scene("SurfaceWithoutFile", bed + "surface = { kind = \"file\" }\n", {"bed.surface.file"}),
    scene("KeyOfAnotherSurface", bed + "surface = { kind = \"flat\", radius = 1.0 }\n",
          {"bed.surface.radius"}),
    {"BadSet",
     {"run", "scene.toml", "-o", "out.h5", "--set", "relaxation.talus_angle"},
     2,
     {"--set relaxation.talus_angle"},
     {}},
    {"SetOutOfRange",
     {"run", "scene.toml", "-o", "out.h5", "--set", "device.servo_rate=0"},
     2,
     {"--set device.servo_rate=0"},
     {}},
    {"SetOfALastPart",
     {"run", "scene.toml", "-o", "out.h5", "--set", "talus_angle=35"},
     2,
     {"--set talus_angle=35: unknown key talus_angle; did you mean relaxation.talus_angle?"},
     {}},
    {"SetWithAUnit",
     {"run", "scene.toml", "-o", "out.h5", "--set", "relaxation.talus_angle=35deg"},
     2,
     {"--set relaxation.talus_angle=35deg: relaxation.talus_angle is '35deg'; give only the number, in deg"},
     {}},
    {"SetOfNumbersWithUnits",
     {"run", "scene.toml", "-o", "out.h5", "--set", "bed.size=[200mm, 300mm]"},
     2,
     {"bed.size is '[200mm, 300mm]'; give only the number, in m"},
     {}},
    {"SetThatDoesNotGoWithTheScene",
     {"run", "scene.toml", "-o", "out.h5", "--set", "bed.cells=[150, 150]"},
     2,
     {"sandstroke: --set bed.cells=[150, 150]: bed.size and bed.cells give cells of"},
     {}},
    {"SetBeyondMemory",
     {"run", "scene.toml", "-o", "out.h5", "--set", "bed.size=[0.3, 0.3]", "--set",
      "bed.cells=[65536, 65536]", "--set", "bed.surface={kind='noise', amplitude=1.0}"},
     2,
     {"sandstroke: --set bed.cells=[65536, 65536]: ", "memory"},
     {}},
    {"SetOfASettingInTheWay",
     {"run", "scene.toml", "-o", "out.h5", "--set", "tool.radius=1", "--set", "force.k_s=1"},
     2,
     {"sandstroke: --set tool.radius=1: tool.radius = 1 m: the tool"},
     {}},
    {"MissingStroke", {"run", "scene.toml", "-o", "out.h5", "--stroke", "none.h5"}, 4, {"none.h5"}, {}},
    {"StrokeIsNoHdf5",
     {"run", "scene.toml", "-o", "out.h5", "--stroke", "fake.h5"},
     2,
     {"fake.h5", "HDF5"},
     {{"fake.h5", "text"}}},
    {"StrokeIsATableWithoutUnits",
     {"run", "scene.toml", "-o", "out.h5", "--stroke", "s.csv"},
     2,
     {"s.csv", "unit of x, y, z is not known", "stroke.table.position_unit"},
     {{"s.csv", "x,y,z\n1,2,3\n"}}},
    {"StrokeOutsideTheBed",
     {"run", "scene.toml", "-o", "out.h5", "--set", "stroke.scale=10"},
     2,
     {"outside the bed", "stroke.scale"},
     {}},
    {"NothingLeftOfTheStroke",
     {"run", "scene.toml", "-o", "out.h5", "--set", "stroke.start=100"},
     2,
     {"line.toml"},
     {}},
    {"PlaneThroughALine",
     {"run", "scene.toml", "-o", "out.h5", "--set", "stroke.plane=fit", "--stroke", "flat.toml"},
     2,
     {"flat.toml", "plane"},
     {{"flat.toml", "clearance = 0.0\n[[segment]]\nkind = 'line'\nto = [0.05, 0.0]\ndepth = 0.0\n"}}},
    stroke_script("EmptyScript", "", {"segment"}),
    stroke_script("UnknownSegment", "[[segment]]\nkind = \"circle\"\n", {"bad.toml:2", "kind", "circle"}),
    stroke_script("SpeedZero", "speed = 0\n[[segment]]\nkind = 'line'\nto = [0.1, 0.0]\ndepth = 0.004\n",
                  {"bad.toml:1", "speed"}),
    stroke_script("DepthAndForce", "[[segment]]\nkind = 'line'\nto = [0.1, 0.0]\ndepth = 0.004\nforce = 1\n",
                  {"depth", "force"}),
    csv("EmptyCsv", "", {}),
    csv("NoRows", "x,y,z\n", {}),
    csv("MissingColumn", "x,y\n1,2\n", {"z"}),
    csv("ShortRow", "x,y,z\n1,2,3\n4,5\n", {"bad.csv:3"}),
    csv("NanPosition", "x,y,z\n1,2,3\n4,nan,6\n", {"bad.csv:3", "--missing"}, {"--missing", "error"}),
    csv("NotANumber", "x,y,z\n1,2,three\n", {"bad.csv:2", "three"}),
    csv("DecreasingTime", "t,x,y,z\n0,1,2,3\n2,1,2,3\n1,1,2,3\n", {"bad.csv:4"},
        {"--time", "t", "--time-unit", "s"}),
    csv("EqualTimes", "t,x,y,z\n0,1,2,3\n0,1,2,3\n", {"bad.csv:3", "equal-times"},
        {"--time", "t", "--time-unit", "s"}),
    {"UnknownUnit",
     {"stroke", "convert", "a.csv", "out.h5", "--position", "x,y,z", "--position-unit", "furlong", "--rate",
      "1000"},
     2,
     {"furlong"},
     {{"a.csv", "x,y,z\n1,2,3\n"}}},
    {"RenderOfNothing", {"render", "none.h5"}, 4, {"none.h5"}, {}},
    {"RenderOfScene", {"render", "scene.toml"}, 2, {"scene.toml: is a scene, not a run file"}, {}},
    {"RenderOfText", {"render", "a.txt"}, 2, {"a.txt", "HDF5"}, {{"a.txt", "sand"}}},
    {"CompareWithNothing", {"compare", "none.h5", "none.h5"}, 4, {"none.h5"}, {}},
    {"InfoOfScript",
     {"info", "line.toml"},
     2,
     {"is a stroke script", "sandstroke stroke info line.toml"},
     {}},
    {"GoldenOfUnknownScene",
     {"golden", "check", "nosuch", "--strokes", SANDSTROKE_SOURCE "/strokes"},
     2,
     {"nosuch"},
     {}},
    {"PictureThatIsNoPng",
     {"run", "scene.toml", "-o", "out.h5", "--png", "out.jpg"},
     2,
     {"out.jpg: is not the name of a PNG file; end it with .png"},
     {}},
    {"StrokeAsScene",
     {"run", "line.toml", "-o", "out.h5"},
     2,
     {"line.toml: is a stroke script, not a scene; "},
     {}},
    {"PlanAsScene",
     {"run", "plan.toml", "-o", "out.h5"},
     2,
     {"plan.toml: is a sweep plan, not a scene; run it: sandstroke sweep plan.toml"},
     {{"plan.toml", "[sweep]\nscene = 'scene.toml'\n"}}},
    {"SceneAsPlan",
     {"sweep", "scene.toml"},
     2,
     {"scene.toml: is a scene, not a sweep plan; run it: sandstroke run scene.toml"},
     {}},
    {"PlanOfAPlan",
     {"sweep", "plan.toml"},
     2,
     {"plan.toml: is a sweep plan, not a scene"},
     {{"plan.toml", "[sweep]\nscene = 'plan.toml'\n"}}},
    {"SceneAsStroke",
     {"run", "scene.toml", "-o", "out.h5", "--stroke", "scene.toml"},
     2,
     {"scene.toml: is a scene, not a stroke"},
     {}},
    {"SceneToSample",
     {"stroke", "script", "scene.toml", "out.h5"},
     2,
     {"scene.toml: is a scene, not a stroke"},
     {}},
    {"PlanAsStroke",
     {"stroke", "info", "plan.toml"},
     2,
     {"plan.toml: is a sweep plan, not a stroke"},
     {{"plan.toml", "[axes]\nforce.k_s = [1, 2]\n"}}},
    {"UnwritableFolder",
     {"run", "scene.toml", "-o", "nowhere/out.h5"},
     4,
     {"nowhere/out.h5", "cannot be written"},
     {}},
};

class BadInput : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Cli, BadInput, testing::ValuesIn(cases),
                         [](const auto& one) { return one.param.name; });

TEST_P(BadInput, IsOneSentenceAndLeavesNothingBehind) {
  const Case& c = GetParam();
  const fs::path folder = test_folder();
  for (const auto& [name, text] : c.files) write_file(folder / name, text);
  const ProgramResult result = run_program(c.arguments, folder);
  EXPECT_EQ(result.exit_code, c.exit_code) << result.err;
  const std::string said = result.err + result.out;
  for (const std::string& part : c.parts)
    EXPECT_NE(said.find(part), std::string::npos) << "no '" << part << "' in: " << said;
  EXPECT_EQ(said.find("unexpected"), std::string::npos) << said;
  EXPECT_LE(std::count(said.begin(), said.end(), '\n'), 3) << said;
  EXPECT_FALSE(fs::exists(folder / "out.h5"));
}

TEST(CliBadInput, TruncatedFilesAreRefused) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "run.h5"}, folder).exit_code, 0);
  ASSERT_EQ(run_program({"stroke", "script", "line.toml", "line.h5"}, folder).exit_code, 0);
  for (const char* name : {"run.h5", "line.h5"})
    fs::resize_file(folder / name, fs::file_size(folder / name) / 2);
  const ProgramResult render = run_program({"render", "run.h5", "-o", "out.png"}, folder);
  EXPECT_EQ(render.exit_code, 2);
  EXPECT_NE(render.err.find("run.h5"), std::string::npos);
  EXPECT_NE(render.err.find("truncated"), std::string::npos) << render.err;
  const ProgramResult run = run_program({"run", "scene.toml", "--stroke", "line.h5", "-o", "out.h5"}, folder);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("line.h5"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "out.h5"));
  EXPECT_FALSE(fs::exists(folder / "out.png"));
}

TEST(CliBadInput, Hdf5FilesOfOtherKindsAreNamed) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "run.h5"}, folder).exit_code, 0);
  ASSERT_EQ(run_program({"stroke", "script", "line.toml", "line.h5"}, folder).exit_code, 0);
  fs::copy_file(SANDSTROKE_SOURCE "/golden/hole/golden.h5", folder / "golden.h5");
  const auto refused = [&](const std::vector<std::string>& words, const std::string& sentence) {
    const ProgramResult result = run_program(words, folder);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find(sentence), std::string::npos) << result.err;
  };
  refused({"info", "line.h5"}, "line.h5: is a stroke, not a run file; ");
  refused({"render", "line.h5"}, "line.h5: is a stroke, not a run file; ");
  refused({"run", "line.h5"}, "line.h5: is a stroke, not a scene; ");
  refused({"run", "run.h5"}, "run.h5: is a run file, not a scene; ");
  refused({"sweep", "run.h5"}, "run.h5: is a run file, not a sweep plan; ");
  refused({"run", "scene.toml", "--stroke", "run.h5"}, "run.h5: is a run file, not a stroke; ");
  refused({"stroke", "info", "run.h5"}, "run.h5: is a run file, not a stroke; ");
  refused({"info", "golden.h5"}, "golden.h5: is a golden entry, not a run file; ");
  refused({"compare", "golden.h5", "run.h5"}, "golden.h5: is a golden entry, not a run file; ");
}

TEST(CliBadInput, ARecordedStrokeMustBeFiniteAndRunForward) {
  const fs::path folder = test_folder();
  const auto write = [&](const std::vector<double>& time, double x) {
    Hdf5Writer file(folder / "bad.h5", any_hdf5);
    file.write("/stroke/time", time);
    file.write("/stroke/position", std::vector<Eigen::Vector3d>{{0, 0, 0}, {x, 0, 0}, {0.01, 0, 0}});
    file.attribute("/stroke", "format", "sandstroke.stroke");
    file.attribute("/stroke", "format_version", 1.0);
    file.finish();
  };
  const auto refused = [&](const std::vector<std::string>& parts) {
    const ProgramResult run =
        run_program({"run", "scene.toml", "--stroke", "bad.h5", "-o", "out.h5"}, folder);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    for (const std::string& part : parts) EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
    EXPECT_FALSE(fs::exists(folder / "out.h5"));
  };
  write({0.0, 0.1, 0.2}, std::numeric_limits<double>::quiet_NaN());
  refused({"bad.h5", "position", "nan"});
  write({0.0, 0.2, 0.1}, 0.005);
  refused({"bad.h5", "time"});
  write({0.0, 0.1}, 0.005);
  refused({"bad.h5"});
}

TEST(CliBadInput, AReadOnlyFolderIsAnError) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const fs::path folder = test_folder();
  fs::create_directory(folder / "closed");
  fs::permissions(folder / "closed", fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_EQ(run_program({"run", "scene.toml", "-o", "closed/out.h5"}, folder).exit_code, 4);
  fs::permissions(folder / "closed", fs::perms::owner_all);
}

TEST(CliBadInput, APictureOnAFullDiskIsAnErrorAndLeavesNothingComplete) {
  const fs::path folder = test_folder();
  // /dev/full takes no byte: the part file is a link to it.
  fs::create_symlink("/dev/full", folder / "out.png.part");
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "run.h5"}, folder).exit_code, 0);
  const ProgramResult render = run_program({"render", "run.h5", "-o", "out.png"}, folder);
  EXPECT_EQ(render.exit_code, 4) << render.err;
  EXPECT_FALSE(fs::exists(folder / "out.png"));
}

}  // namespace
}  // namespace sandstroke
