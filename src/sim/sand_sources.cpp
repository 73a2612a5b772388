#include "sim/sand_sources.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace sandstroke {
namespace {

/// Heights beyond so many lengths of the bed are mistakes, whose squares may be no numbers any more.
constexpr double most_lengths = 1000.0;

}  // namespace

SandSources::SandSources(const std::vector<SourceSettings>& sources, double density) : density_(density) {
  for (const SourceSettings& settings : sources) sources_.push_back({settings, Nozzle(settings)});
}

void SandSources::stop_by(double time) {
  for (Source& source : sources_)
    if (std::isinf(source.nozzle.stop())) source.nozzle.stop_by(time);
}

bool SandSources::ended() const { return in_air_.empty() && acted_until_ >= last_stop(); }

double SandSources::last_stop() const {
  double last = 0.0;
  for (const Source& source : sources_) last = std::max(last, source.nozzle.stop());
  return last;
}

void SandSources::act(HeightField& bed, double until, SandCatcher* catcher) {
  for (int i = 0; i < static_cast<int>(sources_.size()); ++i) {
    const Nozzle& nozzle = sources_[static_cast<std::size_t>(i)].nozzle;
    const double begin = std::max(acted_until_, nozzle.start()), end = std::min(until, nozzle.stop());
    if (begin < end) open(bed, i, begin, end, catcher);
  }
  while (const std::optional<Packet> packet = in_air_.land(until)) land(bed, *packet, catcher);
  acted_until_ = until;
}

void SandSources::open(HeightField& bed, int source, double begin, double end, const SandCatcher* catcher) {
  Source& s = sources_[static_cast<std::size_t>(source)];
  const double middle = 0.5 * (begin + end), mass = std::abs(s.settings.rate) * (end - begin);
  const std::optional<Eigen::Vector3d> mouth = s.nozzle.at(middle);
  if (!mouth) return;
  if (s.settings.rate < 0.0) return take(bed, s, *mouth, mass);
  s.poured.add(mass);
  double ends = bed.height_at(mouth->x(), mouth->y());
  if (catcher)
    if (const double top = catcher->top_at(mouth->x(), mouth->y()); top < mouth->z())
      ends = std::max(ends, top);
  in_air_.drop(middle + fall_time(mouth->z(), ends), {mass, mouth->x(), mouth->y(), mouth->z(), source});
}

const std::vector<CellUnder>& SandSources::cells_under(const HeightField& bed, Source& source, double x,
                                                       double y) {
  if (source.cells.empty() || source.x != x || source.y != y) {
    source.cells = cells_under_nozzle(bed, x, y, source.settings.radius);
    source.x = x;
    source.y = y;
  }
  return source.cells;
}

double SandSources::set(HeightField& bed, const CellUnder& cell, double before, double after) {
  if (after == before) return 0.0;
  const double length = std::max(bed.rows(), bed.cols()) * bed.cell_size(),
               above_floor = after - bed.floor(cell.row, cell.col);  // the floor may be as high as it likes
  if (!(std::min(std::abs(after), above_floor) <= most_lengths * length))
    throw Error(
        ErrorKind::unstable,
        fmt::format(
            "at x = {:.4g} m, y = {:.4g} m a [[source]] leaves sand at a height of {:.3g} m, but the bed "
            "is only {:.3g} m long; change source.rate or source.stop",
            bed.x_of(cell.col), bed.y_of(cell.row), after, length));
  bed.set(cell.row, cell.col, after);
  unsettled_ = true;
  return (after - before) * bed.cell_area() * density_;
}

void SandSources::land(HeightField& bed, const Packet& packet, SandCatcher* catcher) {
  Source& source = sources_[static_cast<std::size_t>(packet.source)];
  const std::vector<CellUnder>& cells = cells_under(bed, source, packet.x, packet.y);
  double whole = 0.0;
  for (const CellUnder& cell : cells) whole += cell.part;
  const double mass = packet.mass + source.rest, rise = mass / (density_ * bed.cell_area() * whole);
  double given = 0.0;
  for (const CellUnder& cell : cells) {
    const double before = bed(cell.row, cell.col);
    if (catcher) {
      const double x = bed.x_of(cell.col), y = bed.y_of(cell.row), top = catcher->top_at(x, y);
      if (top > before && top < packet.z) {
        catcher->take(x, y, rise * cell.part);
        given += rise * cell.part * bed.cell_area() * density_;
        unsettled_ = true;
        continue;
      }
    }
    given += set(bed, cell, before, before + rise * cell.part);
  }
  source.landed.add(packet.mass);
  source.rest = mass - given;
}

void SandSources::take(HeightField& bed, Source& sink, const Eigen::Vector3d& mouth, double mass) {
  sink.asked.add(mass);
  const std::vector<CellUnder>& cells = cells_under(bed, sink, mouth.x(), mouth.y());
  // Below that it takes nothing from a cell: so no cell gets below its floor, not even by a rounding.
  const auto lowest = [&](const CellUnder& cell) {
    const double height = bed(cell.row, cell.col);
    if (bed.is_wall(cell.row, cell.col)) return height;  // under a solid tool
    return std::min(height, std::max(bed.floor(cell.row, cell.col), mouth.z()));
  };
  double there = 0.0;
  for (const CellUnder& cell : cells) there += cell.part * (bed(cell.row, cell.col) - lowest(cell));
  there *= bed.cell_area() * density_;
  if (there <= 0.0) return;
  const double fraction = std::min(1.0, (mass + sink.rest) / there);
  double got = 0.0;
  for (const CellUnder& cell : cells) {
    const double before = bed(cell.row, cell.col), low = lowest(cell);
    got -= set(bed, cell, before, std::max(low, before - fraction * cell.part * (before - low)));
  }
  sink.taken.add(got);
  sink.rest = fraction < 1.0 ? mass + sink.rest - got : 0.0;
}

std::vector<SourceLedger> SandSources::ledgers() const {
  std::vector<SourceLedger> ledgers;
  std::vector<CompensatedSum> in_air(sources_.size());
  in_air_.visit_packets(
      [&](const Packet& packet) { in_air[static_cast<std::size_t>(packet.source)].add(packet.mass); });
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const Source& source = sources_[i];
    ledgers.push_back({source.poured.value(), source.landed.value(), in_air[i].value(), source.asked.value(),
                       source.taken.value()});
  }
  return ledgers;
}

double SandSources::given_volume() const {
  CompensatedSum mass;
  for (const Source& source : sources_) {
    mass.add(source.landed.value());
    mass.add(-source.taken.value());
  }
  return mass.value() / density_;
}

double SandSources::moved_volume() const {
  CompensatedSum mass;
  for (const Source& source : sources_) mass.add(source.landed.value() + source.taken.value());
  return mass.value() / density_;
}

void SandSources::visit_state(StateVisitor& state) {
  for (Source& source : sources_) {
    if (source.settings.stroke) {
      state.same("source.path.time", source.settings.stroke->time);
      state.same("source.path.position", source.settings.stroke->position);
      state.same("source.path.contact", source.settings.stroke->contact);
    }
    state.value("source.poured", source.poured);
    state.value("source.landed", source.landed);
    state.value("source.asked", source.asked);
    state.value("source.taken", source.taken);
    state.value("source.rest", source.rest);
  }
  state.value("source.acted_until", acted_until_);
  state.value("source.in_air", in_air_);
  state.value("source.unsettled", unsettled_);
}

}  // namespace sandstroke
