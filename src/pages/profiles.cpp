#include "pages/profiles.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "report/curve.h"

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;

constexpr double side_reach = 6.0;  // radii, as furrows are measured
constexpr double most_stations = 1e5;

/// A position on the path of the tip.
struct Station {
  double length;  // m, from the start of the path
  Eigen::Vector2d position;
  bool begins;  // the tip came down here
};

/// The points of the path. Error: input, where one is not finite.
std::vector<Station> path_stations(const TipPath& path) {
  std::vector<Station> stations;
  double length = 0.0;
  auto piece = path.pieces.begin();
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const bool begins = piece != path.pieces.end() && *piece == i;
    if (begins)
      ++piece;
    else
      length += (path.points[i] - path.points[i - 1]).norm();
    stations.push_back({length, path.points[i], begins});
  }
  if (!std::isfinite(length))
    throw_input_error("the trace holds positions that are not finite; run the scene again");
  return stations;
}

/// Adds stations in between, so that no two are further apart than `step` [m] while the tip was down.
std::vector<Station> subdivided(const std::vector<Station>& coarse, double step) {
  std::vector<Station> fine;
  for (const Station& next : coarse) {
    if (!next.begins) {
      const Station before = fine.back();
      const double parts = std::ceil((next.length - before.length) / step);
      for (double part = 1.0; part < parts; ++part)
        fine.push_back({std::lerp(before.length, next.length, part / parts),
                        before.position + part / parts * (next.position - before.position), false});
    }
    fine.push_back(next);
  }
  return fine;
}

/// The initial and the last surface at positions that are added in order.
struct Profile {
  Curve initial, last;
  void add(double at, const Eigen::Vector2d& position, const HeightField& a, const HeightField& b) {
    initial.add(at, a.height_at(position.x(), position.y()));
    last.add(at, b.height_at(position.x(), position.y()));
  }
  void break_off(double at) {
    initial.add(at, std::numeric_limits<double>::quiet_NaN());
    last.add(at, std::numeric_limits<double>::quiet_NaN());
  }
  Json json(const std::string& title, const std::string& note, const std::string& over,
            const LastSurface& surface) const {
    return {{"title", title},
            {"note", note},
            {"over", over},
            {"last", surface.name},
            {"curves", {{"initial", curve_json(initial)}, {"last", curve_json(last)}}}};
  }
};

/// The direction over half a radius to either side, but not past a lift; x where the tip stayed.
Eigen::Vector2d direction_at(const std::vector<Station>& stations, std::size_t middle, double radius) {
  std::size_t from = middle, to = middle;
  while (!stations[from].begins && stations[middle].length - stations[from].length < 0.5 * radius) --from;
  while (to + 1 < stations.size() && !stations[to + 1].begins &&
         stations[to].length - stations[middle].length < 0.5 * radius)
    ++to;
  const Eigen::Vector2d way = stations[to].position - stations[from].position;
  return way.isZero(0.0) ? Eigen::Vector2d(1.0, 0.0) : way.normalized();
}

}  // namespace

Json profiles_part(const TipPath& path, double tool_radius, const HeightField& initial,
                   const LastSurface& last) {
  const double cell = initial.cell_size();
  const std::vector<Station> coarse = path_stations(path);
  const double length = coarse.back().length;
  const std::vector<Station> stations = subdivided(coarse, std::max(cell, length / most_stations));
  Json part{{"kind", "profiles"},
            {"title", "Profiles of the sand"},
            {"text", fmt::format("The tip moved {:.4g} m while it touched the sand. The heights are those of "
                                 "the cells under the profile.",
                                 length)},
            {"profiles", Json::array()}};
  if (length >= 0.5 * tool_radius) {
    Profile along;
    for (const Station& station : stations) {
      if (station.begins && station.length > 0.0) along.break_off(station.length);
      along.add(station.length, station.position, initial, last.surface);
    }
    part["profiles"].push_back(along.json("Along the stroke",
                                          "The curves have a gap where the tip was lifted.",
                                          "length along the path", last));
  }
  const auto from_middle = [&](const Station& station) { return std::abs(station.length - 0.5 * length); };
  const auto middle = static_cast<std::size_t>(
      std::min_element(stations.begin(), stations.end(),
                       [&](const Station& a, const Station& b) { return from_middle(a) < from_middle(b); }) -
      stations.begin());
  const Eigen::Vector2d centre = stations[middle].position, way = direction_at(stations, middle, tool_radius);
  const Eigen::Vector2d left(-way.y(), way.x());
  const auto reach = static_cast<int>(
      std::min(std::ceil(side_reach * tool_radius / cell), 1.0 * initial.rows() + initial.cols()));
  Profile across;
  for (int k = -reach; k <= reach; ++k) across.add(k * cell, centre + k * cell * left, initial, last.surface);
  part["profiles"].push_back(across.json(
      "Across the stroke",
      fmt::format(
          "At the middle of the path, x = {:.4g} m, y = {:.4g} m. Distances to its left are positive.",
          centre.x(), centre.y()),
      "distance from the path", last));
  return part;
}

}  // namespace sandstroke
