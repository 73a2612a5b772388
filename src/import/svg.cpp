#include "import/svg.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "core/input_file.h"
#include "import/drawn_lines.h"
#include "import/sample_checks.h"
#include "import/svg_geometry.h"
#include "import/svg_path.h"
#include "import/text_parts.h"
#include "import/xml_parts.h"

namespace sandstroke {
namespace {

using Eigen::Affine2d;
using Eigen::Vector2d;

/// What the lengths of an element are fractions of, if they are in percent [px].
struct SvgViewport {
  double width = 0.0, height = 0.0;
};

/// An element, and the transform around it.
struct SvgNode {
  pugi::xml_node node;
  Affine2d to_mm;
  SvgViewport viewport;
};

std::string without_any_blanks(std::string_view text) {
  std::string result(text);
  std::erase_if(result, [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; });
  return result;
}

bool hides(std::string_view style) {
  const std::string text = without_any_blanks(style);
  return text.find("display:none") != std::string::npos ||
         text.find("visibility:hidden") != std::string::npos;
}

bool is_hidden(const pugi::xml_node& node) {
  return std::string_view(node.attribute("display").value()) == "none" ||
         std::string_view(node.attribute("visibility").value()) == "hidden" ||
         hides(node.attribute("style").value());
}

class SvgReader {
 public:
  explicit SvgReader(const std::string& name) : name_(name), lines_(name) {}

  SampleTable table(const pugi::xml_node& root) {
    Affine2d to_mm = Affine2d::Identity();
    to_mm.linear() << 25.4 / 96.0, 0.0, 0.0, -25.4 / 96.0;
    SvgViewport page;
    const auto has_length = [&](const char* name) {
      return svg_length(root.attribute(name).value(), 0.0).value_or(0.0) > 0.0;
    };
    if (!has_length("width") && !has_length("height"))
      warnings_.push_back(fmt::format(
          "{}: gives no width or height of its page; its units are taken as px, 1/96 inch; if that is wrong, "
          "write the true ones, such as width=\"200mm\", into its svg element",
          name_));
    // A stack of its own: a stranger's groups may be nested however deep.
    std::vector<SvgNode> open{{root, to_mm, page}};  // the next child of each open group
    while (!open.empty()) {
      SvgNode next = open.back();
      open.back().node = next.node.next_sibling();
      if (!next.node)
        open.pop_back();
      else if (take(next))
        open.push_back({next.node.first_child(), next.to_mm, next.viewport});
    }
    return finished();
  }

 private:
  /// Draws an element. True if it is a group: it then has its children's transform.
  bool take(SvgNode& element) {
    const pugi::xml_node& node = element.node;
    if (node.type() != pugi::node_element) return false;
    const std::string name(local_name(node));
    if (name == "style" && hides(node.text().get()))
      warnings_.push_back(fmt::format(
          "{}: its style sheet hides elements, but style sheets are not read, and all elements are drawn; "
          "delete the hidden ones",
          name_));
    if (is_hidden(node)) return false;
    element.to_mm = element.to_mm * svg_transform(node.attribute("transform").value(), location(node));
    if (name == "svg") enter_viewport(element);
    const bool is_group = name == "svg" || name == "g" || name == "a" || name == "switch";
    if (!is_group) draw(element, name);
    return is_group;
  }

  std::string location(const pugi::xml_node& node) const {
    const std::string id = node.attribute("id").value();
    return fmt::format("{}: {}{}", name_, local_name(node), id.empty() ? "" : " '" + id + "'");
  }

  /// width, height and viewBox (SVG 1.1, chapter 7).
  void enter_viewport(SvgNode& element) const {
    const pugi::xml_node& node = element.node;
    const SvgViewport outer = element.viewport;
    const auto width = svg_length(node.attribute("width").value(), outer.width);
    const auto height = svg_length(node.attribute("height").value(), outer.height);
    element.to_mm = element.to_mm * Eigen::Translation2d(length(element, "x"), length(element, "y"));
    element.viewport = {width.value_or(outer.width), height.value_or(outer.height)};
    SvgNumbers numbers(node.attribute("viewBox").value());
    const auto x = numbers.cut(), y = numbers.cut(), w = numbers.cut(), h = numbers.cut();
    if (!x || !y || !w || !h || !(*w > 0.0) || !(*h > 0.0)) return;
    element.viewport = {*w, *h};
    const bool has_width = width && *width > 0.0, has_height = height && *height > 0.0;
    Vector2d scale(has_width ? *width / *w : 1.0, has_height ? *height / *h : 1.0);
    if (!has_width) scale.x() = scale.y();
    if (!has_height) scale.y() = scale.x();
    const std::string_view aspect = node.attribute("preserveAspectRatio").value();
    Vector2d room = Vector2d::Zero();  // beside the drawing
    if (!aspect.starts_with("none")) {
      const double both =
          aspect.find("slice") == std::string_view::npos ? scale.minCoeff() : scale.maxCoeff();
      const auto share = [&](const char* low, const char* high) {
        if (aspect.find(low) != std::string_view::npos) return 0.0;
        return aspect.find(high) != std::string_view::npos ? 1.0 : 0.5;
      };
      room = Vector2d(share("xMin", "xMax") * (scale.x() - both) * *w,
                      share("YMin", "YMax") * (scale.y() - both) * *h);
      scale = {both, both};
    }
    element.to_mm = element.to_mm * Eigen::Translation2d(room) * Eigen::Scaling(scale.x(), scale.y()) *
                    Eigen::Translation2d(-*x, -*y);
  }

  /// The length of an attribute [px]; 0, if it is not there. Error: input.
  double length(const SvgNode& element, const char* attribute) const {
    const std::string_view text = element.node.attribute(attribute).value();
    if (without_blanks(text).empty() || without_blanks(text) == "auto") return 0.0;
    const bool of_width = std::string_view("x x1 x2 cx rx width").find(attribute) != std::string_view::npos;
    const SvgViewport& viewport = element.viewport;
    const double whole = *attribute == 'r' && attribute[1] == 0 ? 0.5 * (viewport.width + viewport.height)
                         : of_width                             ? viewport.width
                                                                : viewport.height;
    if (const auto px = svg_length(text, whole)) return *px;
    throw_input_error("{}: its {} \"{}\" is not a length in px, mm, cm, in, pt, pc, Q or %; correct it",
                      location(element.node), attribute, text.substr(0, 40));
  }

  void draw(const SvgNode& element, const std::string& name) {
    const pugi::xml_node& node = element.node;
    const auto at = [&](const char* attribute) { return length(element, attribute); };
    if (name == "path") {
      draw_svg_path(node.attribute("d").value(), element.to_mm, location(node), lines_);
    } else if (name == "line") {
      lines_.move_to(element.to_mm * Vector2d(at("x1"), at("y1")));
      lines_.line_to(element.to_mm * Vector2d(at("x2"), at("y2")));
    } else if (name == "polyline" || name == "polygon") {
      draw_corners(element, name == "polygon");
    } else if (name == "rect") {
      draw_rectangle(element);
    } else if (name == "circle") {
      draw_ellipse(element, {at("r"), at("r")});
    } else if (name == "ellipse") {
      draw_ellipse(element, {at("rx"), at("ry")});
    } else if (name == "text" || name == "image" || name == "use" || name == "foreignObject") {
      ++not_drawn_[name];
    }
  }

  void draw_corners(const SvgNode& element, bool closes) {
    SvgNumbers numbers(element.node.attribute("points").value());
    std::vector<Vector2d> corners;
    while (!numbers.at_end()) {
      const std::string_view before = numbers.rest();
      const auto x = numbers.cut(), y = numbers.cut();
      if (!x || !y)
        throw_input_error("{}: its points cannot be read at '{}'; correct them", location(element.node),
                          before.substr(0, 40));
      corners.emplace_back(*x, *y);
    }
    draw_polyline(element, corners, closes);
  }

  void draw_polyline(const SvgNode& element, const std::vector<Vector2d>& corners, bool closes) {
    if (corners.empty()) return;
    lines_.move_to(element.to_mm * corners.front());
    for (const Vector2d& corner : corners) lines_.line_to(element.to_mm * corner);
    if (closes) lines_.line_to(element.to_mm * corners.front());
  }

  void draw_rectangle(const SvgNode& element) {
    const auto at = [&](const char* attribute) { return length(element, attribute); };
    const double x = at("x"), y = at("y"), w = at("width"), h = at("height");
    if (!(w > 0.0 && h > 0.0)) return;
    double rx = at("rx"), ry = at("ry");
    if (!element.node.attribute("ry")) ry = rx;
    if (!element.node.attribute("rx")) rx = ry;
    rx = std::clamp(rx, 0.0, 0.5 * w);
    ry = std::clamp(ry, 0.0, 0.5 * h);
    if (rx == 0.0 || ry == 0.0)
      return draw_polyline(element, {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}, true);
    const std::string round = fmt::format("a{0} {1} 0 0 1 ", rx, ry);
    const double across = w - 2.0 * rx, down = h - 2.0 * ry;
    draw_svg_path(
        fmt::format("M{} {} h{} {}{} {} v{} {}{} {} h{} {}{} {} v{} {}{} {} z", x + rx, y, across, round, rx,
                    ry, down, round, -rx, ry, -across, round, -rx, -ry, -down, round, rx, -ry),
        element.to_mm, location(element.node), lines_);
  }

  void draw_ellipse(const SvgNode& element, const Vector2d& radii) {
    if (!(radii.x() > 0.0 && radii.y() > 0.0)) return;
    const Vector2d centre(length(element, "cx"), length(element, "cy"));
    const Vector2d begin = centre + Vector2d(radii.x(), 0.0);
    lines_.move_to(element.to_mm * begin);
    draw_ellipse_arc({centre, {radii.x(), 0.0}, {0.0, radii.y()}, 0.0, 2.0 * std::numbers::pi}, begin,
                     element.to_mm, lines_);
  }

  SampleTable finished() {
    std::vector<std::string> kinds;
    for (const auto& [name, count] : not_drawn_) kinds.push_back(fmt::format("{} {}", count, name));
    const std::string left_out = fmt::format("{}", fmt::join(kinds, ", "));
    if (lines_.lines() == 0 && !kinds.empty())
      throw_input_error(
          "{}: has nothing but {}, which are not read; convert them to paths (Inkscape: Path, "
          "Object to Path)",
          name_, left_out);
    SampleTable table = lines_.table("SVG");
    table.description += ", y points down in the file and is negated";
    table.warnings = warnings_;
    if (!kinds.empty())
      table.warnings.push_back(fmt::format(
          "{}: {} not drawn; convert text, clones and pictures to paths (Inkscape: Path, Object to Path)",
          name_, left_out));
    return table;
  }

  const std::string& name_;
  DrawnLines lines_;
  std::map<std::string, std::size_t> not_drawn_;
  std::vector<std::string> warnings_;
};

}  // namespace

SampleTable parse_svg(std::string_view text, const std::string& name) {
  pugi::xml_document document;
  parse_xml(text, name, document);
  const pugi::xml_node root = document.document_element();
  if (local_name(root) != "svg")
    throw_input_error("{}: is XML, but its first element is {} instead of svg; give an SVG drawing", name,
                      local_name(root));
  return finite_samples(SvgReader(name).table(root), name);
}

SampleTable read_svg(const std::filesystem::path& path) {
  return parse_svg(read_text_file(path, most_xml_bytes), path.string());
}

bool looks_like_svg(std::string_view text) {
  if (!text.starts_with('<') || text.find("<html") != std::string_view::npos) return false;
  return text.find("<svg") != std::string_view::npos || text.find("<svg:svg") != std::string_view::npos;
}

}  // namespace sandstroke
