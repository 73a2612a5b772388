#pragma once

#include <vector>

#include "core/compensated_sum.h"
#include "sand/falling_sand.h"
#include "sand/height_field.h"
#include "sim/nozzle.h"

namespace sandstroke {

/// A tool over the bed, on which sand may come down.
class SandCatcher {
 public:
  virtual ~SandCatcher() = default;
  /// The height at which sand that falls at a place [m] comes down on the tool; -infinity: beside it.
  virtual double top_at(double x, double y) const = 0;
  /// Takes a height of sand over a cell of the bed there, where top_at() is above the bed [m].
  virtual void take(double x, double y, double height) = 0;
};

/// Pours sand onto a bed and takes sand from it.
///
/// What leaves a nozzle falls straight down, and lands after sqrt(2 (z - h) / g), h being the sand's height
/// under the nozzle's middle when it leaves, or that of the tool that is there. It is then spread over the
/// cells under the nozzle, or goes to the tool over them. A sink takes from the cells under it, in proportion
/// to what stands there above its mouth and above the bed's floor: all of that at most.
class SandSources {
 public:
  /// density [kg/m^3]: of the sand in bulk.
  SandSources(const std::vector<SourceSettings>& sources, double density);

  /// A source without a stop stops at this time [s].
  void stop_by(double time);
  /// All that happens from where the last call ended until this time [s]. catcher: null: no tool carries
  /// sand.
  void act(HeightField& bed, double until, SandCatcher* catcher = nullptr);
  /// No source is open any more, and nothing is in the air.
  bool ended() const;
  /// When the last source stops [s].
  double last_stop() const;

  /// Memory [bytes] that the sand of one call of act() takes in the air, from one source.
  static constexpr double bytes_per_packet() { return FallingSand<Packet>::bytes_per_packet(); }

  /// In the order of the settings.
  std::vector<SourceLedger> ledgers() const;
  /// Sand that the bed has got, less what was taken [m^3].
  double given_volume() const;
  /// Sand that has landed or was taken [m^3].
  double moved_volume() const;
  /// Whether the bed was changed since the last settled().
  bool unsettled() const { return unsettled_; }
  void settled() { unsettled_ = false; }
  void visit_state(StateVisitor& state);

 private:
  struct Source {
    SourceSettings settings;
    Nozzle nozzle;
    std::vector<CellUnder> cells = {};  // under the nozzle where they were looked up last
    double x = 0.0, y = 0.0;            // m, there
    // kg. rest: is to be given or taken, but was too little for a height's last bit.
    CompensatedSum poured = {}, landed = {}, asked = {}, taken = {};
    double rest = 0.0;
  };
  /// Sand in the air that left a nozzle at one time.
  struct Packet {
    double mass, x, y, z;  // kg, m, where it left
    int source;

    template <class State>
    void visit_state(State& state) {
      state.value("mass", mass);
      state.value("x", x);
      state.value("y", y);
      state.value("z", z);
      state.value("source", source);
    }
  };
  void open(HeightField& bed, int source, double begin, double end, const SandCatcher* catcher);
  void land(HeightField& bed, const Packet& packet, SandCatcher* catcher);
  void take(HeightField& bed, Source& sink, const Eigen::Vector3d& mouth, double mass);
  const std::vector<CellUnder>& cells_under(const HeightField& bed, Source& source, double x, double y);
  /// Sets a cell's height [m]; returns the sand that it gained [kg]. Error: unstable, if it is no height.
  double set(HeightField& bed, const CellUnder& cell, double before, double after);

  std::vector<Source> sources_;
  double density_;
  double acted_until_ = 0.0;  // s
  FallingSand<Packet> in_air_;
  bool unsettled_ = false;
};

}  // namespace sandstroke
