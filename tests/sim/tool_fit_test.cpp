#include "sim/tool_fit.h"

#include <gtest/gtest.h>

#include <tuple>

#include "core/error.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

/// A scene of 0.12 m by 0.12 m in cells of that size [mm].
Scene scene_with(ToolShape shape, double cell) {
  Scene scene;
  scene.preset = ModelPreset::accurate;
  apply_model_preset(scene);
  scene.bed.width = scene.bed.depth = 0.12;
  scene.bed.cols = scene.bed.rows = static_cast<int>(120.0 / cell);
  scene.stroke.emplace().file = "line.toml";
  scene.tool.shape = shape;
  scene.tool.width = 0.04;
  scene.tool.spacing = 0.01;
  return scene;
}

std::string complaint(const Scene& scene, double depth = std::numeric_limits<double>::infinity()) {
  try {
    check_tool_fits(scene, "s.toml", depth);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ToolFit, ToolsThatTheCellsDoNotResolveAreRefusedInEachOrientation) {
  const auto with = [](ToolShape shape, double cell, double size) {
    Scene scene = scene_with(shape, cell);
    scene.tool.radius = size / 2;
    scene.tool.thickness = size;
    scene.tool.size = {size, 0.02, 0.04};
    return scene;
  };
  for (const ToolShape shape : {ToolShape::plate, ToolShape::rake, ToolShape::box, ToolShape::cylinder})
    for (const double cell : {1.0, 2.0, 5.0})
      for (const double size : {0.0005, 0.001, 0.002, 0.003, 0.004, 0.006, 0.015})
        for (const double turn : {0.0, 15.0, 45.0}) {
          Scene scene = with(shape, cell, size);
          scene.tool.orientation.z() = turn;
          const bool resolved = size > 0.999e-3 * (shape == ToolShape::rake ? 8.0 : 3.0) * cell;
          const std::string text = complaint(scene);
          EXPECT_EQ(text.empty(), resolved) << static_cast<int>(shape) << " " << size << " in " << cell;
        }
  for (const double radius : {0.0009, 0.0011})
    EXPECT_EQ(complaint(with(ToolShape::sphere, 1.0, 2.0 * radius)).empty(), radius > 0.001) << radius;
}

TEST(ToolFit, TheSentenceNamesTheWidthAndTheCellsThatItNeeds) {
  Scene scene = scene_with(ToolShape::plate, 5.0);
  scene.tool.thickness = 0.004;
  EXPECT_EQ(complaint(scene),
            "s.toml: the tool is only 0.8 cells wide at its narrowest (0.004 m), and a furrow needs 3 cells; "
            "take bed.cells = [90, 90] or more, or a larger tool.thickness");
  scene.bed.cols = scene.bed.rows = 90;
  EXPECT_EQ(complaint(scene), "");
}

TEST(ToolFit, TheCellsThatItNamesAreSquareAndEnough) {
  Scene scene = scene_with(ToolShape::plate, 1.0);
  for (const auto& [cols, rows, thickness, text] :
       {std::tuple{400, 200, 0.002, "take bed.cells = [600, 300] or more, or a larger tool.thickness"},
        {123, 65, 0.002, "take bed.cells = [246, 130] or more, or a larger tool.thickness"},
        {400, 200, 1e-6, "needs 3 cells; take a smaller bed.size, or a larger tool.thickness"}}) {
    scene.bed.cols = cols;
    scene.bed.rows = rows;
    scene.bed.width = 1e-3 * cols;
    scene.bed.depth = 1e-3 * rows;
    scene.tool.thickness = thickness;
    EXPECT_NE(complaint(scene).find(text), std::string::npos) << complaint(scene);
  }
}

TEST(ToolFit, TheSentenceNamesTheNarrowSideOfAPlate) {
  Scene scene = scene_with(ToolShape::plate, 1.0);
  scene.tool.width = 0.001;
  EXPECT_NE(complaint(scene).find("or a larger tool.width"), std::string::npos) << complaint(scene);
}

TEST(ToolFit, RoundTeethAreJudgedAsASphereIsWhereverTheyEnter) {
  Scene scene = scene_with(ToolShape::rake, 1.0);
  scene.tool.radius = 0.004;
  for (const double depth : {0.0005, 0.004, 0.02}) EXPECT_EQ(complaint(scene, depth), "") << depth;
}

TEST(ToolFit, AConeIsJudgedWhereItEntersTheSand) {
  const Scene scene = scene_with(ToolShape::cone, 1.0);
  EXPECT_EQ(complaint(scene), "");
  EXPECT_EQ(complaint(scene, 0.008), "");
  EXPECT_NE(complaint(scene, 0.004).find("2 cells wide at its narrowest up to its depth of 0.004 m"),
            std::string::npos)
      << complaint(scene, 0.004);
}

TEST(ToolFit, AMeshIsJudgedAsTheBoxOfItsSize) {
  Scene box = scene_with(ToolShape::box, 1.0), mesh = scene_with(ToolShape::mesh, 1.0);
  EXPECT_EQ(complaint(mesh), "");  // not read
  for (const double size : {0.0001, 0.02, 0.1}) {
    box.tool.size = {size, size, size};
    mesh.tool.mesh = std::make_shared<TriangleMesh>(tool_surface(box.tool));
    EXPECT_EQ(complaint(mesh).empty(), complaint(box).empty()) << size;
    EXPECT_EQ(complaint(mesh).empty(), size == 0.02) << size;
  }
  // Millimetres are asked for only where they would make a tool that the cells resolve.
  EXPECT_EQ(complaint(mesh).find("millimetres"), std::string::npos) << complaint(mesh);
  mesh.bed.cols = mesh.bed.rows = 4000;
  EXPECT_NE(complaint(mesh).find(
                "is the mesh in millimetres? Then set tool.scale = 0.001, which makes it 0.141 mm wide"),
            std::string::npos);
}

TEST(ToolFit, ACoarseToolIsWarnedOfWithTheErrorToExpect) {
  Scene scene = scene_with(ToolShape::sphere, 1.0);
  scene.tool.radius = 0.001;
  EXPECT_EQ(coarse_tool_warning(scene, 0.0005),
            "the tool is 2 cells wide at its narrowest: its furrow may be off by up to 70 %, and by 5 % "
            "with ten, bed.cells = [600, 600]; --estimate-error says more");
  scene.tool.radius = 0.005;
  EXPECT_EQ(coarse_tool_warning(scene, 0.0005), "");
  EXPECT_EQ(coarse_tool_warning(scene_with(ToolShape::plate, 0.4), 0.004), "");
  EXPECT_NE(coarse_tool_warning(scene_with(ToolShape::plate, 1.0), 0.004).find("4 cells wide"),
            std::string::npos);
}

// A mesh as a bowl of 40 mm, whose wall has a thickness of its own.
TEST(ToolFit, WallsThinnerThanCellsAreToldWhereSandWouldRunThroughThem) {
  Scene scene = scene_with(ToolShape::bowl, 1.0);
  scene.tool.radius = 0.02;
  scene.tool.height = 0.015;
  scene.tool.carries = true;
  for (const double wall : {0.0001, 0.0004, 0.002, 0.004})
    for (const double turn : {0.0, 20.0}) {
      scene.tool.shape = ToolShape::bowl;
      scene.tool.thickness = wall;
      scene.tool.mesh = std::make_shared<TriangleMesh>(tool_surface(scene.tool));
      scene.tool.shape = ToolShape::mesh;
      scene.tool.scale = 1.0;
      scene.tool.orientation.z() = turn;
      const std::string warning = leaking_tool_warning(scene);
      EXPECT_EQ(warning.find("tool.carries: walls of the tool are thinner than a cell (1 mm)") == 0,
                wall < 0.001)
          << wall << ' ' << turn << ' ' << warning;
      EXPECT_EQ(warning.empty(), wall >= 0.002) << wall << ' ' << turn << ' ' << warning;
    }
  // What has no walls holds as much within its edges.
  for (const ToolShape shape : {ToolShape::plate, ToolShape::box, ToolShape::cylinder}) {
    scene.tool.shape = shape;
    scene.tool.size = {0.003, 0.02, 0.04};
    for (const double pitch : {0.0, 20.0}) {
      scene.tool.orientation.y() = pitch;
      EXPECT_EQ(leaking_tool_warning(scene), "") << pitch;
    }
  }
}

TEST(ToolFit, MoreCellsAreExpectedToBeBetter) {
  for (const ToolShape shape : {ToolShape::sphere, ToolShape::plate})
    for (double cells = 2.0; cells < 20.0; cells += 0.5)
      EXPECT_LT(expected_furrow_error(shape, cells + 0.5), expected_furrow_error(shape, cells));
}

}  // namespace
}  // namespace sandstroke
