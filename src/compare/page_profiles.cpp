#include "compare/page_profiles.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/curve.h"

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;

constexpr double side_reach = 6.0;  // radii, as furrows are measured

/// A place on the way of the tip.
struct Station {
  double length;  // m, from the start of the way
  Eigen::Vector2d place;
  bool begins;  // the tip came down here
};

/// No further apart than `step` [m] within a piece.
std::vector<Station> stations_along(const TipPath& path, double step) {
  std::vector<Station> stations;
  double length = 0.0;
  auto piece = path.pieces.begin();
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const bool begins = piece != path.pieces.end() && *piece == i;
    if (begins) {
      ++piece;
    } else {
      const Eigen::Vector2d from = path.points[i - 1], way = path.points[i] - from;
      const int parts = std::max(1, static_cast<int>(std::ceil(way.norm() / step)));
      for (int part = 1; part < parts; ++part)
        stations.push_back(
            {length + way.norm() * part / parts, from + way * static_cast<double>(part) / parts, false});
      length += way.norm();
    }
    stations.push_back({length, path.points[i], begins});
  }
  return stations;
}

/// The two surfaces along places that are added in order.
struct Profile {
  Curve initial, last;
  void add(double at, const Eigen::Vector2d& place, const HeightField& a, const HeightField& b) {
    initial.add(at, a.height_at(place.x(), place.y()));
    last.add(at, b.height_at(place.x(), place.y()));
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

/// Over a radius to either side, as far as the tip was not lifted; along x where it stayed.
Eigen::Vector2d direction_at(const std::vector<Station>& stations, std::size_t middle, double radius) {
  std::size_t from = middle, to = middle;
  while (!stations[from].begins && stations[middle].length - stations[from].length < 0.5 * radius) --from;
  while (to + 1 < stations.size() && !stations[to + 1].begins &&
         stations[to].length - stations[middle].length < 0.5 * radius)
    ++to;
  const Eigen::Vector2d way = stations[to].place - stations[from].place;
  return way.isZero(0.0) ? Eigen::Vector2d(1.0, 0.0) : way.normalized();
}

}  // namespace

Json profiles_part(const TipPath& path, double tool_radius, const HeightField& initial,
                   const LastSurface& last) {
  const double step = initial.cell_size();
  const std::vector<Station> stations = stations_along(path, step);
  const double length = stations.back().length;
  Json part{{"kind", "profiles"},
            {"title", "Profiles of the sand"},
            {"text", fmt::format("The tip went {:.4g} m while it touched the sand. Heights are those of the "
                                 "cells that the profile passes.",
                                 length)},
            {"profiles", Json::array()}};
  if (length >= 0.5 * tool_radius) {
    Profile along;
    for (const Station& station : stations) {
      if (station.begins && station.length > 0.0) along.break_off(station.length);
      along.add(station.length, station.place, initial, last.surface);
    }
    part["profiles"].push_back(along.json(
        "Along the stroke", "Where the tip was lifted, the curves break off.", "way of the tip", last));
  }
  const auto from_middle = [&](const Station& station) { return std::abs(station.length - 0.5 * length); };
  const auto middle = static_cast<std::size_t>(
      std::min_element(stations.begin(), stations.end(),
                       [&](const Station& a, const Station& b) { return from_middle(a) < from_middle(b); }) -
      stations.begin());
  const Eigen::Vector2d centre = stations[middle].place, way = direction_at(stations, middle, tool_radius);
  const Eigen::Vector2d left(-way.y(), way.x());
  const int reach = static_cast<int>(std::ceil(side_reach * tool_radius / step));
  Profile across;
  for (int k = -reach; k <= reach; ++k) across.add(k * step, centre + k * step * left, initial, last.surface);
  part["profiles"].push_back(across.json(
      "Across the stroke",
      fmt::format("At the middle of the way, x = {:.4g} m, y = {:.4g} m. What lies to its left is positive.",
                  centre.x(), centre.y()),
      "distance from the way", last));
  return part;
}

}  // namespace sandstroke
