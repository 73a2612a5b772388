#include "render/height_field_renderer.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/error.h"
#include "render/annotate.h"
#include "render/bare_texture.h"
#include "render/bed_box.h"
#include "render/camera.h"
#include "render/colour_map.h"
#include "render/current_context.h"
#include "render/framebuffer.h"
#include "render/redraw.h"
#include "render/round_scale.h"
#include "render/scale_bar.h"
#include "render/shaders.h"
#include "render/surface_textures.h"
#include "render/tile_mesh.h"
#include "render/tool_mesh.h"

namespace sandstroke {
namespace {

GlObject colour_map_texture(ColourScale scale) {
  constexpr int entries = 256;
  std::vector<float> colours;
  for (int i = 0; i < entries; ++i)
    for (const double channel : scale_colour(i, 0.0, entries - 1, scale))
      colours.push_back(static_cast<float>(channel));
  GlObject texture = make_texture();
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, entries, 1, 0, GL_RGB, GL_FLOAT, colours.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace

void check_drawable(int rows, int cols) {
  const CurrentContext context;
  SurfaceTextures::check_size(rows, cols);
}

class HeightFieldRenderer::Drawing {
 public:
  explicit Drawing(const BedGeometry& bed)
      : bed_(bed),
        surface_(bed),
        sand_("sand", shaders::surface_vertex(), shaders::sand_fragment(false)),
        map_("map", shaders::surface_vertex(), shaders::map_fragment(false)),
        wall_("box", shaders::solid_vertex(), shaders::box_fragment()),
        ball_("tool", shaders::solid_vertex(), shaders::tool_fragment()),
        surroundings_("surroundings", shaders::surroundings_vertex(), shaders::surroundings_fragment()),
        sequential_(colour_map_texture(ColourScale::sequential)),
        diverging_(colour_map_texture(ColourScale::diverging)),
        no_vertices_(make_vertex_array()) {
    check_gl("setting up");
  }

  Image render(const HeightField& surface, const RenderSubject& subject);
  void make_current() { context_.make_current(); }

  RenderCounters counters;

 private:
  void check(const HeightField& surface, const ViewSettings& view) const;
  /// The picture's colour scale. Also puts the values where the map shader finds them.
  Legend prepare_values(const RenderSubject& subject);
  /// legend_part: the legend's part of the picture's width.
  Camera camera_for(const RenderSubject& subject, const StartHeights& start, double legend_part) const;
  void set_light(const ShaderProgram& program, const Camera& camera, const Sun& sun) const;
  void set_tool(const ShaderProgram& program, const ToolBody& tool) const;
  /// Redraws the pixels_.
  void draw(const RenderSubject& subject, const std::optional<Legend>& legend, const Camera& camera,
            const Sun& sun);
  void draw_surroundings(const RenderSubject& subject, const Camera& camera, const Sun& sun) const;
  void draw_sand(const RenderSubject& subject, const Camera& camera, const Sun& sun);
  void draw_map(const RenderSubject& subject, const Legend& legend, const Camera& camera, const Sun& sun);
  /// One that also draws the floor, if the bed has one.
  const ShaderProgram& sand_program();
  const ShaderProgram& map_program();
  void draw_tiles(const ShaderProgram& program, const Camera& camera, const std::vector<int>& levels);
  void draw_ground_depth(const Camera& camera) const;
  void draw_wall(RenderStyle style, const Camera& camera, const Sun& sun) const;
  void draw_tool(const ToolBody& tool, const Camera& camera, const Sun& sun);

  BedGeometry bed_;
  double wall_radius_ = 0.0;  // m, of a round bed
  CurrentContext context_;    // before all members that live in it
  SurfaceTextures surface_;
  BareTexture bare_;
  TileMesh tiles_;
  BedBox box_;
  ToolMesh tool_, load_;
  ShaderProgram sand_, map_, wall_, ball_, surroundings_;
  std::optional<ShaderProgram> sand_on_floor_, map_on_floor_;  // once they are needed
  GlObject sequential_, diverging_, no_vertices_;
  std::unique_ptr<SurfaceTextures> difference_;
  std::unique_ptr<Framebuffer> framebuffer_;
  std::optional<PictureState> drawn_;  // what the framebuffer shows; none: nothing that can be reused
  PixelRect pixels_;                   // the pixels to be drawn
  Image image_;
};

void HeightFieldRenderer::Drawing::set_light(const ShaderProgram& program, const Camera& camera,
                                             const Sun& sun) const {
  program.use();
  program.set("to_clip", camera.to_clip);
  program.set("sun_direction", sun.direction());
  program.set("eye", camera.eye);
  program.set("forward", camera.forward);
  program.set("orthographic", camera.orthographic ? 1 : 0);
}

void HeightFieldRenderer::Drawing::set_tool(const ShaderProgram& program, const ToolBody& tool) const {
  const double radius = tool.mesh ? 0.0 : tool.radius;  // a mesh throws no shadow
  program.set("tool", Eigen::Vector4d(tool.centre().x(), tool.centre().y(), tool.centre().z(), radius));
}

void HeightFieldRenderer::Drawing::draw_surroundings(const RenderSubject& subject, const Camera& camera,
                                                     const Sun& sun) const {
  set_light(surroundings_, camera, sun);
  const bool sand = subject.view.style == RenderStyle::sand;
  Eigen::Vector3d lower = sand ? Eigen::Vector3d(0.80, 0.78, 0.755) : Eigen::Vector3d(0.93, 0.93, 0.925);
  Eigen::Vector3d upper = sand ? Eigen::Vector3d(0.91, 0.92, 0.93) : Eigen::Vector3d(0.965, 0.965, 0.96);
  if (subject.background)
    lower = upper =
        Eigen::Vector3d((*subject.background)[0], (*subject.background)[1], (*subject.background)[2]);
  surroundings_.set("lower", lower);
  surroundings_.set("upper", upper);
  surroundings_.set("from_clip", Eigen::Matrix4d(camera.to_clip.inverse()));
  surroundings_.set("box_low", Eigen::Vector3d(box_.bounds().min()));
  surroundings_.set("box_high", Eigen::Vector3d(box_.bounds().max()));
  surroundings_.set("shadow", sand && subject.box && !subject.background ? 1.0 : 0.0);
  glBindVertexArray(no_vertices_);
  glDisable(GL_DEPTH_TEST);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glEnable(GL_DEPTH_TEST);
}

const ShaderProgram& HeightFieldRenderer::Drawing::sand_program() {
  if (!bare_.ground()) return sand_;
  if (!sand_on_floor_)
    sand_on_floor_.emplace("sand on a floor", shaders::surface_vertex(), shaders::sand_fragment(true));
  return *sand_on_floor_;
}

const ShaderProgram& HeightFieldRenderer::Drawing::map_program() {
  if (!bare_.ground()) return map_;
  if (!map_on_floor_)
    map_on_floor_.emplace("map with a floor", shaders::surface_vertex(), shaders::map_fragment(true));
  return *map_on_floor_;
}

void HeightFieldRenderer::Drawing::draw_tiles(const ShaderProgram& program, const Camera& camera,
                                              const std::vector<int>& levels) {
  program.set("heights", 0);
  program.set("bed_origin", Eigen::Vector2d(bed_.col_at(0.0), bed_.row_at(0.0)));
  program.set("cells", bed_.cols(), bed_.rows());
  program.set("cell_size", bed_.cell_size());
  program.set("wall_radius", wall_radius_);
  program.set("shading", 1);
  surface_.bind_heights(0);
  surface_.bind_shading(1);
  if (bare_.ground()) {
    program.set("bare", 4);
    bare_.bind(4);
  }
  const GLint tile_origin = program.location("tile_origin"), skirt_height = program.location("skirt_height"),
              widest = program.location("widest_pixel");
  for (int tile = 0; tile < bed_.tile_count(); ++tile) {
    const CellRange patch = surface_.patch(tile);
    const TileDetail& detail = surface_.detail(tile);
    const Eigen::AlignedBox3d bounds = surface_.bounds(tile);
    if (camera.misses(bounds)) continue;
    Eigen::AlignedBox3d with_skirt = bounds;
    with_skirt.min().z() = skirt_bottom(detail, bed_.cell_size());
    if (!camera.pixels_of(with_skirt, framebuffer_->width(), framebuffer_->height()).touches(pixels_))
      continue;
    const int level = levels.empty()
                          ? level_of_detail(detail, bed_.cell_size(), camera.pixels_per_metre(bounds))
                          : levels[tile];
    glUniform2i(tile_origin, patch.col_begin, patch.row_begin);
    glUniform1f(skirt_height, static_cast<float>(with_skirt.min().z()));
    glUniform1f(widest, static_cast<float>(widest_pixel(surface_, tile, detail, camera)));
    tiles_.bind(level);
    counters.triangles += tiles_.draw(level);
    ++counters.tiles_drawn;
  }
}

Legend HeightFieldRenderer::Drawing::prepare_values(const RenderSubject& subject) {
  const bool difference = subject.view.style == RenderStyle::difference;
  Legend legend;
  double least = surface_.lowest(), greatest = surface_.highest();
  if (difference) {
    if (!subject.difference || subject.difference->rows() != bed_.rows() ||
        subject.difference->cols() != bed_.cols())
      throw_input_error("the style difference needs a difference of {} x {} cells to show", bed_.cols(),
                        bed_.rows());
    if (!difference_) difference_ = std::make_unique<SurfaceTextures>(bed_);
    difference_->update(HeightField(*subject.difference, bed_.cell_size()));
    least = difference_->lowest();
    greatest = difference_->highest();
    legend.quantity = "difference";
    legend.scale = ColourScale::diverging;
  }
  const ValueRange range = subject.range ? *subject.range : value_range(least, greatest, legend.scale);
  if (!(range.low < range.high))
    throw_input_error("a colour scale from {} to {} m is empty", range.low, range.high);
  legend.low = range.low;
  legend.high = range.high;
  legend.contour_interval =
      subject.contour_interval > 0.0 ? subject.contour_interval : round_interval(range.high - range.low, 14);
  return legend;
}

void HeightFieldRenderer::Drawing::check(const HeightField& surface, const ViewSettings& view) const {
  if (!bed_.same_grid(surface))
    throw_input_error("a renderer for beds of {} x {} cells was given one of {} x {}", bed_.cols(),
                      bed_.rows(), surface.cols(), surface.rows());
  if (!(view.light_elevation > 0.0 && view.light_elevation <= 90.0))
    throw_input_error(
        "view: light_elevation = {} deg puts the sun below the ground; use more than 0, at most 90",
        view.light_elevation);
}

Camera HeightFieldRenderer::Drawing::camera_for(const RenderSubject& subject, const StartHeights& start,
                                                double legend_part) const {
  Eigen::AlignedBox3d framed = box_.bounds();
  framed.extend(box_over(bed_, bed_.cells(), start.lowest, start.highest));
  // The range of depths also decides on bits, so it has room for most of what sand can do.
  const double side = framed.sizes().maxCoeff();
  Eigen::AlignedBox3d scene = framed;
  scene.extend(framed.min() - side * Eigen::Vector3d::UnitZ());
  scene.extend(framed.max() + 0.25 * side * Eigen::Vector3d::UnitZ());
  scene.extend(box_over(bed_, bed_.cells(), surface_.lowest(), surface_.highest()));
  if (subject.view.name == ViewName::stroke) {
    const CellRange cells = framed_cells(subject.focus, bed_.rows(), bed_.cols(), bed_.cell_size(), 0.02);
    framed = box_over(bed_, cells, start.lowest, start.highest);
  }
  if (subject.tool) scene.extend(subject.tool->box());
  return make_camera(subject.view, framed, scene, legend_part);
}

void HeightFieldRenderer::Drawing::draw_sand(const RenderSubject& subject, const Camera& camera,
                                             const Sun& sun) {
  const ShaderProgram& sand = sand_program();
  set_light(sand, camera, sun);
  set_tool(sand, subject.tool.value_or(ToolBody{Eigen::Vector3d::Zero(), 0.0}));
  sand.set("crumbs", subject.crumbs);
  draw_tiles(sand, camera, subject.tile_levels);
}

void HeightFieldRenderer::Drawing::draw_map(const RenderSubject& subject, const Legend& legend,
                                            const Camera& camera, const Sun& sun) {
  const ShaderProgram& map = map_program();
  set_light(map, camera, sun);
  map.set("values", 2);
  map.set("colours", 3);
  map.set("range", Eigen::Vector2d(legend.low, legend.high));
  map.set("contour_interval", legend.contour_interval);
  // On a map from above, and of differences, a colour must mean one value.
  const bool flat = subject.view.name == ViewName::top || subject.view.style == RenderStyle::difference;
  map.set("relief", flat ? 0.0 : 1.0);
  SurfaceTextures& shown = subject.view.style == RenderStyle::difference ? *difference_ : surface_;
  shown.bind_filtered_heights(2);
  glActiveTexture(GL_TEXTURE3);
  glBindTexture(GL_TEXTURE_2D, legend.scale == ColourScale::diverging ? diverging_ : sequential_);
  draw_tiles(map, camera, subject.tile_levels);
}

void HeightFieldRenderer::Drawing::draw_ground_depth(const Camera& camera) const {
  wall_.use();
  wall_.set("to_clip", camera.to_clip);
  wall_.set("scale", 1.0);
  wall_.set("offset", Eigen::Vector3d(0.0, 0.0, 0.0));
  box_.draw_ground_depth();
}

void HeightFieldRenderer::Drawing::draw_wall(RenderStyle style, const Camera& camera, const Sun& sun) const {
  set_light(wall_, camera, sun);
  wall_.set("plain", style == RenderStyle::sand ? 0.0 : 1.0);
  wall_.set("half_bed", Eigen::Vector2d(bed_.x_of(bed_.cols() - 1), bed_.y_of(bed_.rows() - 1)));
  wall_.set("wall", box_.wall_thickness());
  box_.draw_wall();
}

void HeightFieldRenderer::Drawing::draw_tool(const ToolBody& tool, const Camera& camera, const Sun& sun) {
  set_light(ball_, camera, sun);
  set_tool(ball_, tool);
  ball_.set("sandy", 0.0);
  ball_.set("facets", tool.mesh ? 1.0 : 0.0);
  ball_.set("scale", tool.mesh ? 1.0 : tool.radius);
  ball_.set("offset", tool.mesh ? tool.tip : tool.centre());
  tool_.show(tool.mesh);
  tool_.draw();
  if (!tool.load) return;
  ball_.set("sandy", 1.0);
  load_.show(tool.load);
  load_.draw();
}

Image HeightFieldRenderer::Drawing::render(const HeightField& surface, const RenderSubject& subject) {
  const ViewSettings& view = subject.view;
  check(surface, view);
  const std::optional<PictureState> before = std::exchange(drawn_, std::nullopt);  // an error leaves none
  const bool other_size =
      !framebuffer_ || framebuffer_->width() != view.width || framebuffer_->height() != view.height;
  if (other_size) {
    framebuffer_ = std::make_unique<Framebuffer>(view.width, view.height);
    image_ = Image(view.width, view.height);
  }

  wall_radius_ = subject.shape.value_or(surface.shape()) == BedShape::round ? surface.wall_radius() : 0.0;
  counters = {};
  counters.tiles_changed = surface_.update(surface);
  bare_.update(surface, surface_, !before);
  const Sun sun{view.light_azimuth, view.light_elevation};
  surface_.update_shading(sun);
  std::optional<Legend> legend;  // of a map
  if (view.style != RenderStyle::sand) legend = prepare_values(subject);
  const double legend_part =
      legend ? static_cast<double>(legend_width(*legend, view.height)) / view.width : 0.0;
  const StartHeights start = subject.start ? *subject.start : start_heights(surface);
  box_.update(bed_, start);
  const Camera camera = camera_for(subject, start, legend_part);

  PictureState now{camera,
                   sun,
                   start,
                   wall_radius_,
                   view.style,
                   subject.box,
                   subject.crumbs,
                   subject.background,
                   subject.tile_levels,
                   subject.tool,
                   bare_.ground()};
  const PixelRect whole = framebuffer_->whole();
  pixels_ = before && !other_size ? changed_pixels(*before, now, surface_, whole) : whole;
  counters.pixels = pixels_.empty() ? 0 : std::int64_t{pixels_.width()} * pixels_.height();
  if (!pixels_.empty()) draw(subject, legend, camera, sun);
  drawn_ = std::move(now);
  Image image = image_;
  if (!legend) return image;
  draw_legend(image, *legend);
  if (const std::optional<ScaleBar> bar = scale_bar(camera, box_.bounds(), view.width, view.height))
    draw_scale_bar(image, *bar);
  return image;
}

void HeightFieldRenderer::Drawing::draw(const RenderSubject& subject, const std::optional<Legend>& legend,
                                        const Camera& camera, const Sun& sun) {
  framebuffer_->bind(pixels_);
  glEnable(GL_MULTISAMPLE);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  draw_surroundings(subject, camera, sun);
  if (subject.box) draw_ground_depth(camera);
  if (legend)
    draw_map(subject, *legend, camera, sun);
  else
    draw_sand(subject, camera, sun);
  if (subject.box) draw_wall(subject.view.style, camera, sun);
  if (subject.tool) draw_tool(*subject.tool, camera, sun);
  framebuffer_->read(pixels_, image_);
}

HeightFieldRenderer::HeightFieldRenderer(int rows, int cols, double cell_size)
    : drawing_(std::make_unique<Drawing>(BedGeometry(rows, cols, cell_size))) {}

HeightFieldRenderer::~HeightFieldRenderer() {
  if (drawing_) drawing_->make_current();  // it must be current while its objects are destroyed
}

Image HeightFieldRenderer::render(const HeightField& surface, const RenderSubject& subject) {
  drawing_->make_current();
  return drawing_->render(surface, subject);
}

const RenderCounters& HeightFieldRenderer::counters() const { return drawing_->counters; }

}  // namespace sandstroke
