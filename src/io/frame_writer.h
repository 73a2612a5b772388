#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hdf5/hdf5_grid_writer.h"
#include "io/xdmf.h"
#include "sand/height_field.h"

namespace sandstroke {

/// Writes the surfaces of a run over time, at the cost of what changes. For frame K a file holds
///
///   /surface/frame/K/changed  (ny, nx) heights [m] of the tiles that changed since the frame before;
///                             others are not stored and read as not-a-number
///   /surface/frame/K/height   (ny, nx) the whole surface. It is virtual: /surface/initial, and over that
///                             the newest `changed` of each tile
///
/// finish() adds /surface/frames (time, y, x), which shows all these `height` over /surface/time [s].
class FrameWriter {
 public:
  /// bed: the surface that was written as /surface/initial.
  FrameWriter(Hdf5GridWriter& file, const HeightField& bed);
  void add(double time, const HeightField& surface);
  /// Joins the frames into one array over time, if there are any.
  void finish();

  /// When it is put back, later frames of the file are removed.
  void visit_state(StateVisitor& state);

  /// All surfaces of the file, with the initial one, and the final one at `end` [s].
  std::vector<XdmfStep> steps(double end) const;

  const BedGeometry& bed() const { return bed_; }
  int count() const { return static_cast<int>(times_.size()); }

  static std::string changed(int k);
  static std::string height(int k);

 private:
  /// Tiles that changed since the frame before, in order.
  std::vector<int> take_changed(const HeightField& surface);
  std::vector<Hdf5GridWriter::Patch> patches() const;

  Hdf5GridWriter& file_;
  BedGeometry bed_;
  std::vector<std::uint64_t> revisions_;  // per slot, as of the last frame
  std::map<int, int> last_change_;        // frame, per tile that ever changed
  Hdf5Column time_;
  std::string shown_ = "/surface/initial";  // a dataset that equals the last frame
  std::vector<double> times_;
};

}  // namespace sandstroke
