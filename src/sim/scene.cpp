#include "sim/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/machine.h"
#include "sim/check_ground.h"
#include "sim/check_sources.h"
#include "sim/check_tool.h"
#include "sim/scene_ground.h"
#include "sim/scene_moisture.h"

namespace sandstroke {
namespace {

/// Written only where they are set: scenes with run files are as they were before maps were read.
void describe_map(KeyVisitor& v, SurfaceSettings& s) {
  if (v.reads() || s.scale != 1.0)
    v.number("scale", s.scale, positive, "", "bed metres per metre of a map, of lengths and heights");
  show_if_given(v, "nodata", s.nodata, any_number, "m",
                "height of a map's cells without data; left out: they are refused");
}

void describe_bed(KeyVisitor& v, BedSettings& bed, GroundSettings& ground) {
  v.section("bed", "the sand box, centred on the origin, z up");
  double size[2] = {bed.width, bed.depth};
  v.numbers("size", size, 2, positive, "m", "extent along x and y");
  bed.width = size[0];
  bed.depth = size[1];
  int cells[2] = {bed.cols, bed.rows};
  v.integers("cells", cells, 2, 1, BedGeometry::most_cells,
             "number of cells along x and y; the cells must be square");
  bed.cols = cells[0];
  bed.rows = cells[1];
  choose(v, "shape", bed.shape, {"rectangle", "round"},
         "the whole rectangle, or the largest circle in it with a wall around it, as in a sand table");
  describe_floor(v, ground);

  SurfaceSettings& s = bed.surface;
  v.section("bed.surface", "the sand at the start of the run");
  choose(v, "kind", s.kind, {"flat", "cylinder", "cone", "cliff", "noise", "ripples", "file"}, "its shape");
  const auto is = [&](auto... kinds) { return ((s.kind == kinds) || ...); };
  using enum SurfaceKind;
  if (is(cylinder, cone)) v.number("radius", s.radius, positive, "m", "radius of the base");
  if (is(cylinder, cone, cliff)) v.number("height", s.height, any_number, "m", "height above z = 0");
  if (is(noise, ripples))
    v.number("amplitude", s.amplitude, not_negative, "m", "greatest height above z = 0");
  if (is(noise))
    v.number("wavelength", s.wavelength, not_negative, "m",
             "noise: size of the bumps (0: each cell is random); ripples: distance between crests");
  if (is(ripples)) v.number("wavelength", s.wavelength, positive, "m", "ripples: distance between crests");
  if (is(noise)) {
    int seed = static_cast<int>(s.seed);
    v.integers("seed", &seed, 1, 0, std::numeric_limits<int>::max(), "seed of the random heights");
    s.seed = static_cast<std::uint32_t>(seed);
  }
  if (is(file)) {
    v.text("file", s.file,
           "a run file (its final surface; if it was cut off, its last one), a GeoTIFF, a 16-bit grayscale "
           "PNG, a NumPy array (.npy) or an ESRI ASCII grid (.asc)");
    v.number("low", s.low, any_number, "m",
             "height of a picture's black, or of a map's lowest cell; low = high: as the file says");
    v.number("high", s.high, any_number, "m",
             "height of a picture's white, or of a map's highest cell; low = high: as the file says");
    describe_map(v, s);
  }
}

void describe_tool(KeyVisitor& v, ToolSettings& tool) {
  v.section("tool", "what is pushed through the sand");
  choose(v, "shape", tool.shape,
         {"sphere", "cylinder", "cone", "box", "plate", "rake", "shovel", "bowl", "mesh"},
         "its shape; its tip is the middle of its underside, or the origin of a mesh's file");
  const auto is = [&](auto... shapes) { return ((tool.shape == shapes) || ...); };
  using enum ToolShape;
  if (is(sphere, cylinder, cone, rake, bowl))
    v.number("radius", tool.radius, positive, "m", "radius (cone: at its top; rake: of each tooth)");
  if (is(cylinder, cone, plate, rake, bowl))
    v.number("height", tool.height, positive, "m", "height above the tip");
  if (is(box, shovel)) v.numbers("size", tool.size.data(), 3, positive, "m", "extent along x, y and z");
  if (is(plate)) v.number("width", tool.width, positive, "m", "extent along y");
  if (is(plate, shovel, bowl))
    v.number(
        "thickness", tool.thickness, positive, "m",
        "extent along x; of a shovel, which is open where x is largest, and of a bowl: of floor and walls");
  if (is(rake)) {
    v.integers("teeth", &tool.teeth, 1, 1, 200,
               "teeth in a row along y, round at their ends, under a beam that is two radii wide and high");
    v.number("spacing", tool.spacing, positive, "m", "distance between the axes of teeth");
  }
  if (is(mesh)) {
    v.text("file", tool.file, "a closed surface (.stl), z up, relative to the scene");
    v.number("scale", tool.scale, positive, "m", "length of the file's unit (0.001: millimetres)");
  }
  if (is(sphere)) {
    choose(v, "profile", tool.profile, {"paper", "sphere"},
           "shape of the underside: the paper's filter, or a sphere");
  } else {
    v.numbers("orientation", tool.orientation.data(), 3, degrees, "deg",
              "rotation about x, then about y, then about z");
  }
  v.flag("solid", tool.solid, "no sand flows under the tool while the tool touches sand");
  if (!is(sphere))
    v.flag(
        "carries", tool.carries,
        "sand above its upper side stays on it and goes with it, until it runs over the rim; the hand feels "
        "its weight");
}

void describe_density(KeyVisitor& v, SandStrength& sand) {
  v.number("density", sand.density, positive, "kg/m^3",
           "bulk density of the sand, which a [[source]] needs with any force.law");
}

void describe_blend(KeyVisitor& v, SandStrength& sand, bool counts) {
  if (!v.reads() && !counts) return;
  v.number("blend", sand.blend, not_negative, "m",
           "width around the border of a [[sand.region]] or [[sand.layer]] in which the sand's strength "
           "changes; 0: the width of the tool's narrowest part");
}

/// has_weight: the scene has sources, moist sand or a tool that carries sand, which need the sand's density.
void describe_force(KeyVisitor& v, ForceSettings& force, SandStrength& sand, const GroundSettings& ground,
                    bool has_weight) {
  v.section("force", "the force of the sand on the device");
  choose(v, "law", force.law, {"paper", "rft", "archimedes"},
         "the published law of depth and velocity; resistive force theory over the tool's surface, in "
         "newtons; or only that theory's lift, from the volume in the sand, without drag");
  if (force.law == ForceLaw::paper) {
    v.number("k_s", force.k_s, not_negative, "N", "repulse force k_s (exp(k_c depth) - 1)");
    v.number("k_c", force.k_c, positive, "1/m", "growth of the repulse force with depth");
    v.number("k_f", force.k_f, not_negative, "s/m", "drag k_f velocity x repulse force");
    choose(v, "drag", force.drag, {"horizontal", "full"}, "part of the velocity that causes drag");
    describe_blend(v, sand, ground.has_k_s());
    if (has_weight) describe_density(v, sand);
    return;
  }
  choose(v, "sand", sand.preset, {"dry", "quikrete"},
         "sets friction_angle and density: typical dry sand, or Quikrete (Agarwal et al. 2023)");
  if (v.reads()) apply_sand_preset(sand);
  v.number("friction_angle", sand.friction_angle, friction_angles, "deg",
           "angle of internal friction of the sand, from a shear test");
  describe_density(v, sand);
  if (force.law == ForceLaw::rft)
    v.number("tool_friction", sand.tool_friction, not_negative, "", "friction of sand on the tool's surface");
  v.number("yield", sand.yield_way, {1e-6, 1.0, false}, "m",
           "distance that the tool moves until the sand resists fully, or until its resistance has reversed");
  describe_blend(v, sand, ground.has_strengths());
}

void describe_relaxation(KeyVisitor& v, RelaxationSettings& r) {
  v.section("relaxation", "how sand that lies too steep flows");
  choose(v, "law", r.law, {std::begin(relaxation_law_names), std::end(relaxation_law_names)},
         "8 neighbours as published; the same talus slope in every direction; or that slope between each two "
         "cells");
  choose(
      v, "method", r.method, {std::begin(relaxation_method_names), std::end(relaxation_method_names)},
      "passes; super time steps, which are far fewer; those helped by coarser beds, for large piles; or the "
      "rule cell by cell, which is slow");
  if (takes_super_steps(r.method))
    v.number("step_tolerance", r.step_tolerance, {1e-6, 10.0, false}, "",
             "error of a super step, as a fraction of the distance that sand has moved");
  v.number("talus_angle", r.talus_angle, sharp_angle, "deg", "angle of repose");
  v.number("tolerance", r.tolerance, {1e-12, 1.0, false}, "",
           "a slope may stay steeper than tan(talus_angle) by this fraction of it");
  v.number("rate", r.rate, not_negative, "Hz", "relaxations per second of stroke; 0: none");
  v.number("way", r.way, not_negative, "tool radii",
           "how far the tool moves through sand between relaxations; 0: none");
  v.number("way_at_rim", r.way_at_rim, not_negative, "tool radii",
           "the same where sand stands R/5 above the tool's rim; 0: as way");
  v.number("share", r.share, {0.0, 1.0, false}, "",
           "fraction of the excess that a pass moves; 0: 1/2 (paper) or 1/4 (others)");
  double passes = static_cast<double>(r.max_passes);
  v.number("max_passes", passes, {0.0, 1e15, false, true}, "", "largest number of passes in one relaxation");
  r.max_passes = static_cast<std::int64_t>(passes);
}

void describe_device(KeyVisitor& v, DeviceSettings& d) {
  v.section("device", "the simulated haptic device");
  choose(v, "model", d.model, {"kinematic", "dynamic"},
         "the stroke moves it exactly, or the hand pulls a mass by a spring");
  choose(v, "preset", d.preset, {"omega3", "phantom-desktop", "touch", "ideal"},
         "sets max_force and resolution");
  if (v.reads()) apply_device_preset(d);
  v.number("servo_rate", d.servo_rate, {1.0, 1e6, false}, "Hz", "ticks per second of the haptic loop");
  v.number("scale", d.scale, positive, "", "bed metres per device metre");
  v.numbers("offset", d.offset.data(), 3, any_number, "m", "bed position of the device's origin");
  v.number("max_force", d.max_force, not_negative, "N", "largest force of the device; 0: no limit");
  v.number("resolution", d.resolution, not_negative, "m", "encoders' resolution (dynamic model); 0: exact");
  v.number("mass", d.mass, positive, "kg", "mass that hand and sand move (dynamic model)");
  v.number("damping", d.damping, not_negative, "N s/m", "damping of the device");
  v.number("hand_stiffness", d.hand_stiffness, not_negative, "N/m", "stiffness of the hand's spring");
  v.number("hand_damping", d.hand_damping, not_negative, "N s/m", "damping of the hand");
  if (d.model != DeviceModel::dynamic) return;
  v.integers("delay", &d.delay, 1, 0, 1000, "ticks until the sand's force acts");
  v.number(
      "dropped_ticks", d.dropped_ticks, {0.0, 0.99, false}, "",
      "fraction of ticks that are late (the same ones in every run) and repeat the force of the tick before");
  choose(v, "drag", d.drag, {"sampled", "implicit"},
         "velocity that causes drag: read before the tick, or the velocity in the tick (implicit; a real "
         "controller cannot: it would have to know the hand's motion ahead)");
  choose(v, "velocity", d.velocity, {"exact", "encoders"},
         "velocity read: the device's own, or differences of positions read 4 ticks apart");
}

void describe_stroke(KeyVisitor& v, StrokeSettings& stroke) {
  StrokePlacement& p = stroke.placement;
  v.text("file", stroke.file,
         "a script (.toml), a recording (.h5) or a table of samples, relative to the scene");
  choose(v, "plane", p.plane, {"keep", "fit", "flatten"},
         "keep recorded heights; turn and shift the stroke so that its plane is level; or also move it "
         "exactly onto that plane");
  if (p.plane != StrokePlane::keep)
    choose(v, "up", p.up, stroke_up_names,
           "axis of the stroke that points roughly up from its plane; auto: the side to which the pen lifts, "
           "or the nearest positive axis");
  v.number("fit", p.fit, not_negative, "", "fraction of the bed that it fills; 0: it keeps its size");
  v.number("scale", p.scale, positive, "", "scale of the positions, if fit is 0");
  choose(v, "place", p.place, {"keep", "centre"}, "keep its place, or centre what it draws on the bed");
  v.number("rotate_z", p.rotate_z, degrees, "deg", "turn about z, from +x towards +y");
  v.number("depth", p.depth, any_number, "m",
           "how far it is lowered; with plane = fit or flatten: how far below z = 0 it runs");
  choose(v, "depth_by", p.depth_by, depth_by_names,
         "the same depth everywhere, or in proportion to the recorded pressure or to the size of the "
         "recorded force");
  if (p.depth_by != DepthBy::none)
    v.number("full_depth_at", p.full_depth_at, not_negative, "",
             "pressure, or force in N, at the full depth; 0: the stroke's largest");
  choose(v, "follow", p.follow, {"bed", "sand"},
         "its heights are measured from z = 0, or from the sand under the tool (always so in a script with a "
         "force)");
  v.numbers("offset", p.offset.data(), 3, any_number, "m", "shift on the bed, applied last");
  choose(v, "held", p.repeated, {"keep", "drop"},
         "keep or drop samples that a device repeated, because it was read faster than it measures");
  v.number("smooth", p.smooth, not_negative, "Hz",
           "smooths the hand's motion without delay: it halves a tremble of this frequency; 0: as recorded");
  v.number("speed", p.speed, positive, "", "how many times faster than recorded it is played");
  v.number("start", p.start, not_negative, "s", "time in the recording at which it begins");
  double stop = std::isinf(p.stop) ? 0.0 : p.stop;
  v.number("stop", stop, not_negative, "s",
           "time in the recording at which it ends; 0: at the recording's end");
  p.stop = stop > 0.0 ? stop : std::numeric_limits<double>::infinity();
  if (!v.optional_section("stroke.table", stroke.table.has_value(),
                          "how a table of samples is read; a key that is not given is found from the table"))
    return;
  if (!stroke.table) stroke.table.emplace();
  describe_table(v, *stroke.table);
}

/// About what the bed takes at the start of a run [bytes]: sand that rests by rule until something touches it
/// takes nothing.
double memory_of_bed(const Scene& scene) {
  const BedSettings& bed = scene.bed;
  const std::int64_t tiles = bed.surface.kind == SurfaceKind::file
                                 ? BedGeometry(bed.rows, bed.cols, bed.cell_size()).tile_count()
                                 : tiles_to_relax(starting_bed(bed), scene.relaxation);
  double per_tile = static_cast<double>(bytes_per_relaxed_tile(scene.relaxation, scene.ground.is_solid()));
  if (scene.moisture) per_tile += static_cast<double>(HeightField::bytes_per_tile());  // its intact level
  // A run keeps the start of it, to measure what a stroke left.
  if (bed.surface.kind == SurfaceKind::file && scene.stroke)
    per_tile += static_cast<double>(HeightField::bytes_per_tile());
  return per_tile * static_cast<double>(tiles);
}

/// Written only where a scene has laws of its own: all others are as they were before there were any.
void describe_plugin_laws(KeyVisitor& v, PluginLawSettings& plugin_laws) {
  const bool any =
      !(plugin_laws.plugin.empty() && plugin_laws.relaxation.empty() && plugin_laws.displacement.empty() &&
        plugin_laws.force.empty() && plugin_laws.parameters == PluginLawSettings{}.parameters);
  if (!any && !v.reads()) return;
  v.text("plugin", plugin_laws.plugin, "the plugin's file (.so), relative to the scene");
  v.text("relaxation", plugin_laws.relaxation,
         "plugin law that replaces relaxation.law and relaxation.method");
  v.text("displacement", plugin_laws.displacement, "plugin law that replaces displacement.deposit");
  v.text("force", plugin_laws.force, "plugin law that replaces force.law");
  v.numbers("parameters", plugin_laws.parameters.data(), static_cast<int>(plugin_laws.parameters.size()),
            any_number, "", "numbers for the plugin laws, which give them their meaning");
}

void check_bed(const Scene& scene, const std::string& name) {
  const BedSettings& bed = scene.bed;
  const double dx = bed.cell_size(), dy = bed.depth / bed.rows;
  if (std::abs(dx - dy) > 1e-9 * dx)
    throw_input_error("{}: bed.size and bed.cells give cells of {} m by {} m; make them square", name, dx,
                      dy);
  // Cubes of lengths, and squares of drops between cells, must be numbers: sand in cells of 1e-160 m lies
  // still.
  if (!(dx >= 1e-100 && dx <= 1e100))
    throw_input_error("{}: bed.size and bed.cells give cells of {} m; take cells of 1e-100 to 1e100 m", name,
                      dx);

  const SurfaceSettings& s = bed.surface;
  const bool waves = s.kind == SurfaceKind::ripples || (s.kind == SurfaceKind::noise && s.wavelength > 0.0);
  if (waves &&
      !(std::max(bed.width, bed.depth) / s.wavelength < 0x1p53))  // beyond it no position in a wave is left
    throw_input_error(
        "{}: bed.surface.wavelength = {} m is too small for a bed of {} m by {} m; take a larger one", name,
        s.wavelength, bed.width, bed.depth);

  check_ground(scene, name);
  check_memory(memory_of_bed(scene) + memory_of_ground(scene),
               fmt::format("{}: bed.cells = [{}, {}]", name, bed.cols, bed.rows),
               scene.ground.empty() ? "take fewer cells" : "take fewer cells, or smaller regions and stones");
  if (s.kind == SurfaceKind::file && s.file.empty())
    throw_input_error("{}: bed.surface.file is missing; name a run file or a map", name);
}

void check_device(const Scene& scene, const std::string& name) {
  const DeviceSettings& device = scene.device;
  if (device.drag == DragVelocity::implicit && (device.delay > 0 || device.dropped_ticks > 0.0))
    throw_input_error(
        "{}: device.drag = implicit needs a force that acts in the tick in which it is computed; set "
        "device.delay = 0 and device.dropped_ticks = 0, or device.drag = sampled",
        name);
  if (device.drag == DragVelocity::implicit && device.velocity == ReadVelocity::encoders)
    throw_input_error(
        "{}: device.drag = implicit does not use the velocity that encoders read; set device.velocity = "
        "exact, or device.drag = sampled",
        name);
  if (is_contact_law(scene) && device.drag == DragVelocity::implicit)
    throw_input_error(
        "{}: device.drag = implicit works only with the paper's drag; set force.law = paper and no "
        "model.force, or device.drag = sampled",
        name);
}

}  // namespace

bool is_contact_law(const Scene& scene) {
  return scene.force.law != ForceLaw::paper || !scene.plugin_laws.force.empty();
}

void describe_scene(KeyVisitor& v, Scene& scene) {
  v.section("model", "the set of defaults that the other settings start from, and plugin laws");
  choose(v, "preset", scene.preset, preset_names, "the published model, or the choices for accuracy");
  if (v.reads()) apply_model_preset(scene);
  describe_plugin_laws(v, scene.plugin_laws);

  describe_bed(v, scene.bed, scene.ground);
  describe_ground(v, scene.ground);

  describe_tool(v, scene.tool);

  v.section("displacement", "where pushed sand goes");
  choose(v, "deposit", scene.displacement.deposit, {"ring", "ahead", "outward"},
         "all around as published, ahead of the motion, or along the tool's outward normal");
  if (scene.displacement.deposit == Deposit::outward)
    v.number("distance", scene.displacement.distance, {1.0, 1.4, false}, "R",
             "distance from the tool's axis");

  show_tables(v, "source", scene.sources, "a nozzle that pours sand onto the bed, or takes some from it",
              describe_source);

  describe_moisture(v, scene.moisture);
  const bool has_weight = !scene.sources.empty() || scene.moisture || scene.tool.carries;
  describe_force(v, scene.force, scene.strength, scene.ground, has_weight);

  describe_relaxation(v, scene.relaxation);
  describe_device(v, scene.device);

  if (v.optional_section("stroke", scene.stroke.has_value(),
                         "the hand's motion; without it the bed is only relaxed")) {
    if (!scene.stroke) scene.stroke.emplace();
    describe_stroke(v, *scene.stroke);
  }

  v.section("output", "what the run file keeps");
  v.number("frames", scene.output.frames, not_negative, "Hz",
           "surfaces kept per second of stroke; 0: only first and last");
  v.flag("trace", scene.output.trace, "keep position, force and depth of every tick");
}

void apply_model_preset(Scene& scene) {
  const bool paper = scene.preset == ModelPreset::paper;
  scene.tool.profile = paper ? ToolProfile::paper : ToolProfile::sphere;
  scene.tool.solid = !paper;
  scene.displacement.deposit = paper ? Deposit::ring : Deposit::outward;
  scene.relaxation.law = paper ? RelaxationLaw::paper : RelaxationLaw::faces;
  scene.relaxation.method = paper ? RelaxationMethod::passes : RelaxationMethod::rkl;
  // sandstroke bench: relaxed by way, a stroke's outcome does not depend on its speed. From 0.2 radii on a
  // tool overruns what it put 1.2 radii from its axis: in shallow, fresh sand that does no harm.
  scene.relaxation.rate = paper ? 60.0 : 0.0;
  scene.relaxation.way = paper ? 0.0 : 0.4;
  scene.relaxation.way_at_rim = paper ? 0.0 : 0.05;
}

Stroke place_on_bed(const Stroke& stroke, const Scene& scene, const std::string& name) {
  // The bed in the hand's metres.
  const Eigen::Vector2d half = 0.5 * Eigen::Vector2d(scene.bed.width, scene.bed.depth) / scene.device.scale;
  const Eigen::Vector2d centre = -scene.device.offset.head<2>() / scene.device.scale;
  return place_stroke(stroke, scene.stroke->placement, name, {centre - half, centre + half});
}

void check_scene(const Scene& scene, const std::string& name) {
  check_bed(scene, name);
  check_tool(scene, name);
  const RelaxationSettings& r = scene.relaxation;
  if (scene.plugin_laws.relaxation.empty() && r.law != RelaxationLaw::paper && flow_share(r) > 0.25)
    throw_input_error(
        "{}: relaxation.share = {} is stable only with relaxation.law = paper; take 0.25 or less", name,
        r.share);
  if (scene.plugin_laws.relaxation.empty() && r.method == RelaxationMethod::multilevel &&
      r.law == RelaxationLaw::paper)
    throw_input_error(
        "{}: relaxation.method = \"multilevel\" does not know relaxation.law = \"paper\"; take \"isotropic\" "
        "or "
        "\"faces\", or relaxation.method = \"rkl\"",
        name);
  check_device(scene, name);
  check_sources(scene, name);
  check_moisture(scene, name);
  if (scene.stroke && scene.stroke->file.empty())
    throw_input_error(
        "{}: stroke.file is missing; name a stroke (.toml, .h5 or a table of samples) or remove [stroke]",
        name);
}

HeightField starting_bed(const BedSettings& bed) {
  return make_surface(bed.surface, bed.rows, bed.cols, bed.cell_size(), bed.shape);
}

}  // namespace sandstroke
