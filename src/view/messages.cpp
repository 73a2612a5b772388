#include "view/messages.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

using nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "numbers go into messages as they are");

constexpr std::uint32_t picture_signature = 0x444e4153;  // "SAND"

template <class Number>
void put(std::string& message, Number number) {
  message.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void put_vector(std::string& message, const Eigen::Vector3d& vector) {
  for (int axis = 0; axis < 3; ++axis) put(message, static_cast<float>(vector[axis]));
}

void put_mesh(std::string& message, const TriangleMesh& mesh) {
  put(message, static_cast<std::uint32_t>(mesh.vertices.size()));
  put(message, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Eigen::Vector3d& vertex : mesh.vertices) put_vector(message, vertex);
  for (const auto& triangle : mesh.triangles)
    for (const int corner : triangle) put(message, static_cast<std::uint32_t>(corner));
}

template <class Number>
Number get(const char*& at) {
  Number number;
  std::memcpy(&number, at, sizeof number);
  at += sizeof number;
  return number;
}

/// Names of files may not be UTF-8: invalid bytes are replaced.
std::string text_of(const ordered_json& json) {
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

/// The tool's shape before the hand turns it.
ordered_json tool_json(const ToolSettings& tool) {
  ordered_json json = {{"radius", tool_reach(tool)}};
  if (tool.shape == ToolShape::sphere) return json;
  const TriangleMesh mesh = turned(tool_surface(tool), own_rotation(tool));
  std::vector<float> vertices;
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) vertices.push_back(static_cast<float>(vertex[axis]));
  json["vertices"] = vertices;
  json["triangles"] = mesh.triangles;
  return json;
}

}  // namespace

std::string hello_message(const ViewHello& hello) {
  ordered_json pointer;
  if (hello.pointer)
    pointer = {{"depth", hello.pointer->depth},
               {"radius", hello.pointer->radius},
               {"clearance", hello.pointer->clearance}};
  const ordered_json said = {{"title", hello.title},
                             {"rows", hello.bed.rows()},
                             {"cols", hello.bed.cols()},
                             {"cell_size", hello.bed.cell_size()},
                             {"tile_side", BedGeometry::tile_side},
                             {"x0", hello.bed.x_of(0)},
                             {"y0", hello.bed.y_of(0)},
                             {"low", hello.heights.low},
                             {"high", hello.heights.high},
                             {"bottom", hello.bottom ? ordered_json(*hello.bottom) : ordered_json()},
                             {"tool", tool_json(hello.tool)},
                             {"max_force", hello.max_force},
                             {"pointer", pointer}};
  return text_of({{"hello", said}});
}

std::string status_message(std::string_view text) { return text_of({{"status", text}}); }

std::string drawing_message(bool drawing) { return text_of({{"drawing", drawing}}); }

std::string end_message(std::string_view reason) { return text_of({{"end", reason}}); }

void put_picture(const ViewState& state, const LiveBed::Tiles& tiles, bool with_load, std::string& message) {
  message.clear();
  put(message, picture_signature);
  put(message, static_cast<std::uint32_t>(tiles.index.size()));
  put(message, state.time);
  put_vector(message, state.tip);
  put_vector(message, state.force);
  for (const double number : {state.depth, state.rate, state.lateness, state.max_lateness})
    put(message, static_cast<float>(number));
  const unsigned flags = (std::isnan(state.depth) ? 0u : 1u) | (state.tip_known ? 2u : 0u) |
                         (state.force_withheld ? 4u : 0u) | (with_load ? 8u : 0u);
  put(message, std::uint32_t{flags});
  for (const double part : state.orientation.coeffs()) put(message, static_cast<float>(part));
  put(message, std::uint32_t{0});
  for (std::size_t i = 0; i < tiles.index.size(); ++i) {
    put(message, static_cast<std::uint32_t>(tiles.index[i]));
    message.append(reinterpret_cast<const char*>(&tiles.heights[i * BedGeometry::tile_area]),
                   sizeof(float) * BedGeometry::tile_area);
  }
  if (with_load) put_mesh(message, state.load ? *state.load : TriangleMesh{});
}

std::optional<std::vector<PointerSample>> pointer_samples(std::string_view message) {
  if (message.empty() || message.size() > most_message_bytes || message.size() % pointer_sample_bytes != 0)
    return std::nullopt;
  std::vector<PointerSample> samples(message.size() / pointer_sample_bytes);
  const char* at = message.data();
  for (PointerSample& sample : samples) {
    sample.time = get<double>(at);
    sample.x = get<float>(at);
    sample.y = get<float>(at);
    sample.pressure = get<float>(at);
    sample.switches = get<std::uint32_t>(at);
    if (!std::isfinite(sample.time) || !std::isfinite(sample.x) || !std::isfinite(sample.y) ||
        !std::isfinite(sample.pressure))
      return std::nullopt;
  }
  return samples;
}

}  // namespace sandstroke
