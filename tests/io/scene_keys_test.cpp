#include "io/scene_keys.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "core/error.h"
#include "core/hash.h"
#include "io/scene_toml.h"

namespace sandstroke {
namespace {

using S = const SceneFile&;

/// A setting, what else it takes, and what it must make of the scene.
struct KeyCase {
  const char* setting;
  bool (*is_set)(S);
  std::vector<std::string> with = {};
};

const std::vector<std::string> stroke = {"stroke.file=x.h5"}, dynamic = {"device.model=dynamic"},
                               cylinder = {"bed.surface.kind=cylinder"}, cone = {"bed.surface.kind=cone"},
                               cliff = {"bed.surface.kind=cliff"}, noise = {"bed.surface.kind=noise"},
                               ripples = {"bed.surface.kind=ripples"},
                               read_from = {"bed.surface.kind=file", "bed.surface.file=y.h5"},
                               rkl = {"relaxation.method=rkl"}, rft = {"force.law=rft"},
                               archimedes = {"force.law=archimedes"},
                               outward = {"displacement.deposit=outward"},
                               source = {"source=[{at = [0, 0, 0.1], rate = 0.1, path = \"y.h5\"}]"};

const std::vector<std::string> sand_map = {"sand.map.file=y.png"};

const std::vector<std::string> moist = {"relaxation.law=isotropic", "moisture.cohesion=150"};

const std::vector<std::string> region = {"sand.region=[{talus_angle = 33.0}]"},
                               moist_region = {"sand.region=[{talus_angle = 33.0}]",
                                               "relaxation.law=isotropic", "moisture.cohesion=150"},
                               round = {"sand.region=[{talus_angle = 33.0, shape = 'circle'}]"},
                               polygon =
                                   {"sand.region=[{talus_angle = 33.0, shape = 'polygon', points = [[0, 0], "
                                    "[1, 0], [0, 1]]}]"},
                               rft_region = {"sand.region=[{talus_angle = 33.0}]", "force.law=rft"},
                               layer = {"sand.layer=[{top = -0.02, density = 1700}]", "force.law=rft"},
                               deep_layer = {"sand.layer=[{top = -0.02, density = 1700}]", "force.law=rft",
                                             "bed.surface.kind=file", "bed.surface.file=y.h5"},
                               stone = {"stone=[{centre = [0.0, 0.0, 0.0]}]"},
                               block = {"stone=[{centre = [0.0, 0.0, 0.0], shape = 'box'}]"},
                               rock = {"stone=[{centre = [0.0, 0.0, 0.0], shape = 'mesh'}]",
                                       "stone.1.file=x.stl"};

bool is(const Eigen::Vector3d& v, double x, double y, double z) { return v == Eigen::Vector3d(x, y, z); }

std::vector<std::string> shape(const std::string& name) {
  return {"displacement.deposit=outward", "tool.shape=" + name};
}

const std::vector<std::string> mesh = {"displacement.deposit=outward", "tool.shape=mesh", "tool.file=x.stl"};

/// All values differ from the defaults, and those of neighbours from each other.
const std::vector<KeyCase> cases = {
    {"model.preset=accurate", [](S s) { return s.preset == ModelPreset::accurate && s.tool.solid; }},
    {"model.plugin=laws.so", [](S s) { return s.plugin_laws.plugin == "laws.so"; }},
    {"model.relaxation=slow", [](S s) { return s.plugin_laws.relaxation == "slow"; }},
    {"model.displacement=left", [](S s) { return s.plugin_laws.displacement == "left"; }},
    {"model.force=spring", [](S s) { return s.plugin_laws.force == "spring"; }},
    {"model.parameters=[1.5, -2, 3, 4]",
     [](S s) {
       return s.plugin_laws.parameters == std::array<double, 4>{1.5, -2.0, 3.0, 4.0};
     }},
    {"bed.size=[3.0, 1.5]",
     [](S s) { return s.bed.width == 3.0 && s.bed.depth == 1.5; },
     {"bed.cells=[100, 50]"}},
    {"bed.cells=[50, 100]",
     [](S s) { return s.bed.cols == 50 && s.bed.rows == 100; },
     {"bed.size=[1.5, 3.0]"}},
    {"bed.floor=-0.035", [](S s) { return s.ground.floor == -0.035; }},
    {"sand.map.file=z.png", [](S s) { return s.ground.map->file == "z.png"; }, sand_map},
    {"sand.map.low=25.5", [](S s) { return s.ground.map->low == 25.5; }, sand_map},
    {"sand.map.high=36.5", [](S s) { return s.ground.map->high == 36.5; }, sand_map},
    {"sand.map.nodata=31.5", [](S s) { return s.ground.map->nodata == 31.5; }, sand_map},
    {"sand.region.1.shape=circle", [](S s) { return s.ground.regions[0].shape == RegionShape::circle; },
     region},
    {"sand.region.1.centre=[0.11, 0.12]",
     [](S s) { return s.ground.regions[0].centre == Eigen::Vector2d(0.11, 0.12); }, region},
    {"sand.region.1.size=[0.13, 0.14]",
     [](S s) { return s.ground.regions[0].size == Eigen::Vector2d(0.13, 0.14); }, region},
    {"sand.region.1.radius=0.15", [](S s) { return s.ground.regions[0].radius == 0.15; }, round},
    {"sand.region.1.points=[[0.1, 0.2], [0.3, 0.2], [0.1, 0.5]]",
     [](S s) { return s.ground.regions[0].points[2] == Eigen::Vector2d(0.1, 0.5); }, polygon},
    {"sand.region.1.soft=0.16", [](S s) { return s.ground.regions[0].soft == 0.16; }, region},
    {"sand.region.1.talus_angle=34.5", [](S s) { return s.ground.regions[0].talus_angle == 34.5; }, region},
    {"sand.region.1.friction_angle=35.5", [](S s) { return s.ground.regions[0].friction_angle == 35.5; },
     rft_region},
    {"sand.region.1.density=1610", [](S s) { return s.ground.regions[0].density == 1610.0; }, rft_region},
    {"sand.region.1.k_s=750", [](S s) { return s.ground.regions[0].k_s == 750.0; }, region},
    {"sand.region.1.cohesion=210", [](S s) { return s.ground.regions[0].cohesion == 210.0; }, moist_region},
    {"moisture.cohesion=250", [](S s) { return s.moisture->cohesion == 250.0; }, moist},
    {"moisture.friction_angle=34", [](S s) { return s.moisture->friction_angle == 34.0; }, moist},
    {"moisture.surface=plane", [](S s) { return s.moisture->surface == SlipSurface::plane; }, moist},
    {"moisture.heals=false", [](S s) { return !s.moisture->heals; }, moist},
    {"moisture.dries=1.5",
     [](S s) { return s.moisture->dries == 1.5; },
     {"relaxation.law=isotropic", "moisture.cohesion=150", "stroke.file=x.h5"}},
    {"sand.layer.1.top=-0.045", [](S s) { return s.ground.layers[0].top == -0.045; }, deep_layer},
    {"sand.layer.1.friction_angle=36.5", [](S s) { return s.ground.layers[0].friction_angle == 36.5; },
     layer},
    {"sand.layer.1.density=1620", [](S s) { return s.ground.layers[0].density == 1620.0; }, layer},
    {"force.blend=0.0125", [](S s) { return s.strength.blend == 0.0125; }, layer},
    {"stone.1.shape=ellipsoid", [](S s) { return s.ground.stones[0].shape == StoneShape::ellipsoid; }, stone},
    {"stone.1.centre=[0.11, 0.12, 0.13]", [](S s) { return is(s.ground.stones[0].centre, 0.11, 0.12, 0.13); },
     stone},
    {"stone.1.radius=0.14", [](S s) { return s.ground.stones[0].radius == 0.14; }, stone},
    {"stone.1.size=[0.15, 0.16, 0.17]", [](S s) { return is(s.ground.stones[0].size, 0.15, 0.16, 0.17); },
     block},
    {"stone.1.file=rock.stl", [](S s) { return s.ground.stones[0].file == "rock.stl"; }, rock},
    {"stone.1.scale=0.001", [](S s) { return s.ground.stones[0].scale == 0.001; }, rock},
    {"stone.1.turn=18", [](S s) { return s.ground.stones[0].turn == 18.0; }, block},
    {"stone.1.talus_angle=36", [](S s) { return s.ground.stones[0].talus_angle == 36.0; }, stone},
    {"ground.stiffness=900", [](S s) { return s.ground.stiffness == 900.0; }, {"bed.floor=-0.1"}},
    {"bed.surface.kind=cliff", [](S s) { return s.bed.surface.kind == SurfaceKind::cliff; }},
    {"bed.surface.radius=0.31", [](S s) { return s.bed.surface.radius == 0.31; }, cylinder},
    {"bed.surface.radius=0.32", [](S s) { return s.bed.surface.radius == 0.32; }, cone},
    {"bed.surface.height=-0.33", [](S s) { return s.bed.surface.height == -0.33; }, cylinder},
    {"bed.surface.height=0.34", [](S s) { return s.bed.surface.height == 0.34; }, cone},
    {"bed.surface.height=0.35", [](S s) { return s.bed.surface.height == 0.35; }, cliff},
    {"bed.surface.amplitude=0.0036", [](S s) { return s.bed.surface.amplitude == 0.0036; }, noise},
    {"bed.surface.amplitude=0.0037", [](S s) { return s.bed.surface.amplitude == 0.0037; }, ripples},
    {"bed.surface.wavelength=0.38", [](S s) { return s.bed.surface.wavelength == 0.38; }, noise},
    {"bed.surface.wavelength=0.39", [](S s) { return s.bed.surface.wavelength == 0.39; }, ripples},
    {"bed.surface.seed=40", [](S s) { return s.bed.surface.seed == 40u; }, noise},
    {"bed.surface.file=z.png", [](S s) { return s.bed.surface.file == "z.png"; }, read_from},
    {"bed.surface.low=-0.41", [](S s) { return s.bed.surface.low == -0.41; }, read_from},
    {"bed.surface.high=0.42", [](S s) { return s.bed.surface.high == 0.42; }, read_from},
    {"bed.surface.scale=0.43", [](S s) { return s.bed.surface.scale == 0.43; }, read_from},
    {"bed.surface.nodata=0.0", [](S s) { return s.bed.surface.nodata == 0.0; }, read_from},
    {"tool.shape=rake", [](S s) { return s.tool.shape == ToolShape::rake; }, outward},
    {"tool.height=0.061", [](S s) { return s.tool.height == 0.061; }, shape("cylinder")},
    {"tool.height=0.062", [](S s) { return s.tool.height == 0.062; }, shape("plate")},
    {"tool.size=[0.063, 0.064, 0.065]", [](S s) { return is(s.tool.size, 0.063, 0.064, 0.065); },
     shape("box")},
    {"tool.width=0.066", [](S s) { return s.tool.width == 0.066; }, shape("plate")},
    {"tool.thickness=0.067", [](S s) { return s.tool.thickness == 0.067; }, shape("plate")},
    {"tool.teeth=7", [](S s) { return s.tool.teeth == 7; }, shape("rake")},
    {"tool.spacing=0.068", [](S s) { return s.tool.spacing == 0.068; }, shape("rake")},
    {"tool.file=hand.stl", [](S s) { return s.tool.file == "hand.stl"; }, mesh},
    {"tool.scale=0.001", [](S s) { return s.tool.scale == 0.001; }, mesh},
    {"tool.orientation=[10.0, 20.0, 30.0]", [](S s) { return is(s.tool.orientation, 10.0, 20.0, 30.0); },
     shape("cone")},
    {"tool.radius=0.043", [](S s) { return s.tool.radius == 0.043; }},
    {"tool.profile=sphere", [](S s) { return s.tool.profile == ToolProfile::sphere; }},
    {"tool.solid=true", [](S s) { return s.tool.solid; }},
    {"tool.carries=true", [](S s) { return s.tool.carries; }, shape("box")},
    {"bed.shape=round", [](S s) { return s.bed.shape == BedShape::round; }},
    {"displacement.deposit=ahead", [](S s) { return s.displacement.deposit == Deposit::ahead; }},
    {"displacement.distance=1.31", [](S s) { return s.displacement.distance == 1.31; }, outward},
    {"force.k_s=44", [](S s) { return s.force.k_s == 44.0; }},
    {"force.k_c=45", [](S s) { return s.force.k_c == 45.0; }},
    {"force.k_f=46", [](S s) { return s.force.k_f == 46.0; }},
    {"force.law=rft", [](S s) { return s.force.law == ForceLaw::rft; }},
    {"force.sand=quikrete", [](S s) { return s.strength.friction_angle == 34.0; }, rft},
    {"force.sand=quikrete", [](S s) { return s.strength.preset == SandPreset::quikrete; }, archimedes},
    {"force.friction_angle=34.0", [](S s) { return s.strength.friction_angle == 34.0; }, rft},
    {"force.friction_angle=33.0", [](S s) { return s.strength.friction_angle == 33.0; }, archimedes},
    {"force.density=1601.0", [](S s) { return s.strength.density == 1601.0; }, rft},
    {"force.density=1602.0", [](S s) { return s.strength.density == 1602.0; }, archimedes},
    {"force.density=1603.0", [](S s) { return s.strength.density == 1603.0; }, source},
    {"source.1.path=x.h5", [](S s) { return s.sources[0].path == "x.h5"; }, source},
    {"source.1.at=[0.4, -0.5, 0.6]", [](S s) { return is(s.sources[0].at, 0.4, -0.5, 0.6); }, source},
    {"source.1.rate=-0.07", [](S s) { return s.sources[0].rate == -0.07; }, source},
    {"source.1.radius=0.008", [](S s) { return s.sources[0].radius == 0.008; }, source},
    {"source.1.start=0.9", [](S s) { return s.sources[0].start == 0.9; }, source},
    {"source.1.stop=1.9", [](S s) { return s.sources[0].stop == 1.9; }, source},
    {"force.tool_friction=0.31", [](S s) { return s.strength.tool_friction == 0.31; }, rft},
    {"force.yield=0.002", [](S s) { return s.strength.yield_way == 0.002; }, rft},
    {"force.yield=0.003", [](S s) { return s.strength.yield_way == 0.003; }, archimedes},
    {"force.drag=full", [](S s) { return s.force.drag == DragDirection::full; }},
    {"relaxation.law=isotropic", [](S s) { return s.relaxation.law == RelaxationLaw::isotropic; }},
    {"relaxation.method=rkl", [](S s) { return s.relaxation.method == RelaxationMethod::rkl; }},
    {"relaxation.method=multilevel",
     [](S s) { return s.relaxation.method == RelaxationMethod::multilevel; },
     {"relaxation.law=faces"}},
    {"relaxation.step_tolerance=0.47", [](S s) { return s.relaxation.step_tolerance == 0.47; }, rkl},
    {"relaxation.talus_angle=48", [](S s) { return s.relaxation.talus_angle == 48.0; }},
    {"relaxation.tolerance=0.049", [](S s) { return s.relaxation.tolerance == 0.049; }},
    {"relaxation.rate=50", [](S s) { return s.relaxation.rate == 50.0; }},
    {"relaxation.law=faces", [](S s) { return s.relaxation.law == RelaxationLaw::faces; }},
    {"relaxation.way=51", [](S s) { return s.relaxation.way == 51.0; }},
    {"relaxation.way_at_rim=0.3", [](S s) { return s.relaxation.way_at_rim == 0.3; }},
    {"relaxation.share=0.15", [](S s) { return s.relaxation.share == 0.15; }},
    {"relaxation.max_passes=52", [](S s) { return s.relaxation.max_passes == 52; }},
    {"device.model=dynamic", [](S s) { return s.device.model == DeviceModel::dynamic; }},
    {"device.preset=touch",
     [](S s) { return s.device.preset == DevicePreset::touch && s.device.max_force == 3.3; }},
    {"device.servo_rate=53", [](S s) { return s.device.servo_rate == 53.0; }},
    {"device.scale=54", [](S s) { return s.device.scale == 54.0; }},
    {"device.offset=[55, 56, 57]", [](S s) { return is(s.device.offset, 55, 56, 57); }},
    {"device.max_force=58", [](S s) { return s.device.max_force == 58.0; }},
    {"device.resolution=59", [](S s) { return s.device.resolution == 59.0; }},
    {"device.mass=60", [](S s) { return s.device.mass == 60.0; }},
    {"device.damping=61", [](S s) { return s.device.damping == 61.0; }},
    {"device.hand_stiffness=62", [](S s) { return s.device.hand_stiffness == 62.0; }},
    {"device.hand_damping=63", [](S s) { return s.device.hand_damping == 63.0; }},
    {"device.delay=64", [](S s) { return s.device.delay == 64; }, dynamic},
    {"device.dropped_ticks=0.65", [](S s) { return s.device.dropped_ticks == 0.65; }, dynamic},
    {"device.drag=implicit", [](S s) { return s.device.drag == DragVelocity::implicit; }, dynamic},
    {"device.velocity=encoders", [](S s) { return s.device.velocity == ReadVelocity::encoders; }, dynamic},
    {"stroke.file=w.toml", [](S s) { return s.stroke->file == "w.toml"; }, stroke},
    {"stroke.plane=fit", [](S s) { return s.stroke->placement.plane == StrokePlane::fit; }, stroke},
    {"stroke.up=-y",
     [](S s) { return s.stroke->placement.up == StrokeUp::minus_y; },
     {"stroke.file=x.h5", "stroke.plane=flatten"}},
    {"stroke.fit=0.65", [](S s) { return s.stroke->placement.fit == 0.65; }, stroke},
    {"stroke.place=centre", [](S s) { return s.stroke->placement.place == StrokePlace::centre; }, stroke},
    {"stroke.follow=sand", [](S s) { return s.stroke->placement.follow == StrokeFollow::sand; }, stroke},
    {"stroke.held=drop", [](S s) { return s.stroke->placement.repeated == RepeatedSamples::drop; }, stroke},
    {"stroke.smooth=66.5", [](S s) { return s.stroke->placement.smooth == 66.5; }, stroke},
    {"stroke.speed=66.7", [](S s) { return s.stroke->placement.speed == 66.7; }, stroke},
    {"stroke.scale=66", [](S s) { return s.stroke->placement.scale == 66.0; }, stroke},
    {"stroke.rotate_z=67", [](S s) { return s.stroke->placement.rotate_z == 67.0; }, stroke},
    {"stroke.depth=68", [](S s) { return s.stroke->placement.depth == 68.0; }, stroke},
    {"stroke.depth_by=force", [](S s) { return s.stroke->placement.depth_by == DepthBy::force; }, stroke},
    {"stroke.full_depth_at=68.5",
     [](S s) { return s.stroke->placement.full_depth_at == 68.5; },
     {"stroke.file=x.h5", "stroke.depth_by=pressure"}},
    {"stroke.offset=[69, 70, 71]", [](S s) { return is(s.stroke->placement.offset, 69, 70, 71); }, stroke},
    {"stroke.start=72", [](S s) { return s.stroke->placement.start == 72.0; }, stroke},
    {"stroke.stop=73", [](S s) { return s.stroke->placement.stop == 73.0; }, stroke},
    {"stroke.table.position=-x,z,y", [](S s) { return s.stroke->table->position == "-x,z,y"; }, stroke},
    {"stroke.table.position_unit=1e-5", [](S s) { return s.stroke->table->position_unit == "1e-5"; }, stroke},
    {"stroke.table.pixel_size=0.86", [](S s) { return s.stroke->table->pixel_size == 0.86; }, stroke},
    {"stroke.table.time=2", [](S s) { return s.stroke->table->time == "2"; }, stroke},
    {"stroke.table.time_unit=ms", [](S s) { return s.stroke->table->time_unit == "ms"; }, stroke},
    {"stroke.table.rate=87", [](S s) { return s.stroke->table->rate == 87.0; }, stroke},
    {"stroke.table.speed=0.88", [](S s) { return s.stroke->table->speed == 0.88; }, stroke},
    {"stroke.table.equal_times=spread",
     [](S s) { return s.stroke->table->equal_times == EqualTimes::spread; }, stroke},
    {"stroke.table.missing=error", [](S s) { return s.stroke->table->missing == Missing::error; }, stroke},
    {"stroke.table.velocity=a,b", [](S s) { return s.stroke->table->velocity == "a,b"; }, stroke},
    {"stroke.table.velocity_unit=mm/s", [](S s) { return s.stroke->table->velocity_unit == "mm/s"; }, stroke},
    {"stroke.table.force=c,d", [](S s) { return s.stroke->table->force == "c,d"; }, stroke},
    {"stroke.table.force_unit=mN", [](S s) { return s.stroke->table->force_unit == "mN"; }, stroke},
    {"stroke.table.force_sign=by hand", [](S s) { return s.stroke->table->force_sign == ForceSign::by_hand; },
     stroke},
    {"stroke.table.orientation=4,5,6,7", [](S s) { return s.stroke->table->orientation == "4,5,6,7"; },
     stroke},
    {"stroke.table.pressure=p", [](S s) { return s.stroke->table->pressure == "p"; }, stroke},
    {"stroke.table.stroke_number=n", [](S s) { return s.stroke->table->stroke_number == "n"; }, stroke},
    {"stroke.table.pen_state=-up", [](S s) { return s.stroke->table->pen_state == "-up"; }, stroke},
    {"stroke.table.part=/pen/tip", [](S s) { return s.stroke->table->part == "/pen/tip"; }, stroke},
    {"stroke.table.columns=e,f,g", [](S s) { return s.stroke->table->columns == "e,f,g"; }, stroke},
    {"stroke.table.separator=tab", [](S s) { return s.stroke->table->separator == Separator::tab; }, stroke},
    {"stroke.table.decimal=comma", [](S s) { return s.stroke->table->decimal == DecimalMark::comma; },
     stroke},
    {"stroke.table.encoding=UTF-16", [](S s) { return s.stroke->table->encoding == "UTF-16"; }, stroke},
    {"stroke.table.skip_lines=89", [](S s) { return s.stroke->table->skip_lines == 89; }, stroke},
    {"stroke.table.skip=START,END", [](S s) { return s.stroke->table->skip == "START,END"; }, stroke},
    {"stroke.table.pen_up=UP", [](S s) { return s.stroke->table->pen_up == "UP"; }, stroke},
    {"stroke.table.pen_down=DOWN", [](S s) { return s.stroke->table->pen_down == "DOWN"; }, stroke},
    {"stroke.table.gap_threshold=0.91", [](S s) { return s.stroke->table->gap_threshold == 0.91; }, stroke},
    {"stroke.table.frame=device", [](S s) { return s.stroke->table->frame == "device"; }, stroke},
    {"stroke.table.merge=force.csv", [](S s) { return s.stroke->table->merge == "force.csv"; }, stroke},
    {"stroke.table.merge_part=/wrench", [](S s) { return s.stroke->table->merge_part == "/wrench"; }, stroke},
    {"stroke.table.merge_time=h", [](S s) { return s.stroke->table->merge_time == "h"; }, stroke},
    {"stroke.table.merge_time_unit=us", [](S s) { return s.stroke->table->merge_time_unit == "us"; }, stroke},
    {"stroke.table.merge_rate=92", [](S s) { return s.stroke->table->merge_rate == 92.0; }, stroke},
    {"stroke.table.merge_shift=-93", [](S s) { return s.stroke->table->merge_shift == -93.0; }, stroke},
    {"output.frames=74", [](S s) { return s.output.frames == 74.0; }},
    {"output.trace=false", [](S s) { return !s.output.trace; }},
    {"view.name=top", [](S s) { return s.view.name == ViewName::top; }},
    {"view.style=height", [](S s) { return s.view.style == RenderStyle::height; }},
    {"view.azimuth=75", [](S s) { return s.view.azimuth == 75.0; }},
    {"view.elevation=76", [](S s) { return s.view.elevation == 76.0; }},
    {"view.distance=77", [](S s) { return s.view.distance == 77.0; }},
    {"view.target=[78, 79, 80]", [](S s) { return is(s.view.target, 78, 79, 80); }},
    {"view.field_of_view=81", [](S s) { return s.view.field_of_view == 81.0; }},
    {"view.light_azimuth=82", [](S s) { return s.view.light_azimuth == 82.0; }},
    {"view.light_elevation=83", [](S s) { return s.view.light_elevation == 83.0; }},
    {"view.size=[84, 85]", [](S s) { return s.view.width == 84 && s.view.height == 85; }}};

std::string key_of(const KeyCase& one) {
  return std::string(one.setting).substr(0, std::string(one.setting).find('='));
}

TEST(SceneKeys, EachSetsTheFieldOfItsNameAndIsInTheResolvedText) {
  for (const KeyCase& one : cases) {
    std::vector<std::string> settings = one.with;
    if (key_of(one) == "stroke.file") settings.clear();
    settings.push_back(one.setting);
    const SceneFile scene = scene_from_text("", "scene.toml", settings);
    EXPECT_TRUE(one.is_set(scene)) << one.setting;
    const std::string text = scene_text(scene);
    const SceneFile read_back = scene_from_text(text, "again.toml");
    EXPECT_TRUE(one.is_set(read_back)) << one.setting;
    EXPECT_EQ(scene_text(read_back), text) << one.setting;
  }
}

TEST(SceneKeys, AllAreInThisTable) {
  std::set<std::string> listed, tried;
  for (const KeySection& section : all_scene_keys())
    for (const KeyRow& key : section.keys) listed.insert(key.name);
  for (const KeyCase& one : cases) tried.insert(key_of(one));
  for (const std::string& key : listed) EXPECT_TRUE(tried.contains(key)) << key;
  for (const std::string& key : tried) EXPECT_TRUE(listed.contains(key)) << key;
}

TEST(SceneKeys, EachChangesTheHashOfTheScene) {
  for (const KeyCase& one : cases) {
    const std::string key = key_of(one);
    // A bed of other cells must have another size: both are set, to what keeps the cells square.
    const bool of_bed = key == "bed.size" || key == "bed.cells";
    const std::vector<std::string> before = of_bed ? std::vector<std::string>{} : one.with;
    std::vector<std::string> after = one.with;
    if (key.ends_with(".file")) after.pop_back();
    after.push_back(one.setting);
    const auto hash = [](const std::vector<std::string>& settings) {
      return content_hash(scene_text(scene_from_text("", "scene.toml", settings)));
    };
    EXPECT_NE(hash(before), hash(after)) << one.setting;
  }
}

TEST(SceneKeys, UnitsAreThoseOfTheTable) {
  const SceneFile scene = scene_from_text("", "scene.toml",
                                          {"stroke.file=x.h5", "device.model=dynamic",
                                           "stone=[{centre = [0.0, 0.0, 0.0]}, "
                                           "{centre = [0.5, 0.0, 0.0]}]"});
  for (const auto& [name, unit] : {std::pair{"bed.size", "m"},
                                   {"tool.radius", "m"},
                                   {"force.k_s", "N"},
                                   {"force.k_c", "1/m"},
                                   {"force.k_f", "s/m"},
                                   {"relaxation.talus_angle", "deg"},
                                   {"relaxation.rate", "Hz"},
                                   {"relaxation.way", "tool radii"},
                                   {"device.mass", "kg"},
                                   {"device.damping", "N s/m"},
                                   {"device.hand_stiffness", "N/m"},
                                   {"device.max_force", "N"},
                                   {"device.dropped_ticks", ""},
                                   {"stone.2.radius", "m"},
                                   {"stroke.stop", "s"},
                                   {"no.such_key", ""}})
    EXPECT_EQ(setting_unit(scene, name), unit) << name;
}

bool takes_integers(const KeyRow& key) {
  return !key.value.empty() && key.value.find_first_of(".e") == std::string::npos;
}

/// A setting of a key, all its numbers alike.
std::string setting_of(const KeyRow& key, double number) {
  const std::string text = takes_integers(key) ? fmt::format("{:.0f}", number) : fmt::format("{}", number);
  std::string list = text;
  for (const char c : key.value)
    if (c == ',') list += ", " + text;
  return key.name + "=" + (key.value.starts_with('[') ? "[" + list + "]" : text);
}

TEST(SceneKeys, TakeWhatTheHelpSaysAndNothingBeyond) {
  int checked = 0;
  for (const KeySection& section : all_scene_keys())
    for (const KeyRow& key : section.keys) {
      const auto one =
          std::find_if(cases.begin(), cases.end(), [&](const KeyCase& c) { return key_of(c) == key.name; });
      ASSERT_NE(one, cases.end()) << key.name;
      const auto takes = [&](double number) {
        std::vector<std::string> settings = one->with;
        if (key.name == "bed.cells") settings.clear();  // as square as the bed
        settings.push_back(setting_of(key, number));
        try {
          scene_from_text("", "scene.toml", settings);
          return true;
        } catch (const Error& failure) {
          EXPECT_NE(std::string(failure.what()).find(key.name), std::string::npos) << failure.what();
          return false;
        }
      };
      std::smatch ends;
      const std::string number = "([-+.0-9e]+)";
      if (std::regex_match(key.range, ends, std::regex("from " + number + " to " + number))) {
        const double low = std::stod(ends[1]), high = std::stod(ends[2]);
        const double beyond = takes_integers(key) ? 1.0 : 0.05 * (high - low);
        EXPECT_TRUE(takes(low)) << key.name;
        EXPECT_TRUE(takes(high)) << key.name;
        EXPECT_FALSE(takes(low - beyond)) << key.name;
        EXPECT_FALSE(takes(high + beyond)) << key.name;
      } else if (std::regex_match(key.range, ends, std::regex("above " + number + " and below " + number))) {
        const double low = std::stod(ends[1]), high = std::stod(ends[2]);
        EXPECT_FALSE(takes(low)) << key.name;
        EXPECT_FALSE(takes(high)) << key.name;
        EXPECT_TRUE(takes(low + 1e-3 * (high - low))) << key.name;
        EXPECT_TRUE(takes(high - 1e-3 * (high - low))) << key.name;
      } else if (std::regex_match(key.range, ends, std::regex(number + " or more"))) {
        EXPECT_TRUE(takes(std::stod(ends[1]))) << key.name;
        EXPECT_FALSE(takes(std::stod(ends[1]) - (takes_integers(key) ? 1.0 : 0.05))) << key.name;
      } else if (std::regex_match(key.range, ends, std::regex("above " + number))) {
        EXPECT_FALSE(takes(std::stod(ends[1]))) << key.name;
      } else {
        EXPECT_EQ(key.range, "") << key.name;
        continue;
      }
      ++checked;
    }
  EXPECT_GT(checked, 35);
}

}  // namespace
}  // namespace sandstroke
