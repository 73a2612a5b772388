#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/output_file.h"
#include "hdf5/hdf5_grid_writer.h"
#include "io/frame_writer.h"
#include "io/xdmf.h"
#include "picture/view.h"
#include "sim/simulation.h"

namespace sandstroke {

/// The least room that a run file takes on the disk [bytes]: its trace, and frames in which nothing moves.
double least_bytes(const Simulation& simulation);

/// Writes a run file while the simulation runs. It is PATH.part, flushed about twice a second so that a
/// killed run can be read up to there, and renamed when complete. Error: io.
class RunWriter : public SimulationObserver {
 public:
  /// view: how pictures of the run show the sand. For /provenance: the hash of the stroke, and the path of
  /// the scene's file; empty: none.
  /// begins: from_part: a run that goes on from a state, whose visit_state() follows.
  RunWriter(const std::filesystem::path& path, const Simulation& simulation, const ViewSettings& view,
            const std::string& stroke_hash, const std::string& scene_file = "",
            Hdf5Writer::Begins begins = Hdf5Writer::Begins::anew);

  void on_tick(const TickRecord& tick) override;
  void on_relaxation(const RelaxationRecord& relaxation) override;
  void on_frame(double time, const HeightField& surface) override;
  void on_load(const LoadSurface& load) override;
  /// What is kept is in the file by then; what came later is removed when it is put back.
  void visit_state(StateVisitor& state) override;

  /// Writes the final surface and the furrow's depths. An interrupted run gets none and stays a .part file.
  void end(const RunResult& result, const HeightField& surface);
  /// Call it after end(). map [m]: the error of each cell, if there is one.
  void write_error(const ErrorEstimate& error, const HeightField* map);
  /// Puts the file of a run that was not interrupted in place, with an XDMF file beside it.
  void finish();

 private:
  void write_surface(const std::string& dataset, const HeightField& surface, const std::string& meaning);
  void begin(const Simulation& simulation, const ViewSettings& view, const std::string& stroke_hash,
             const std::string& scene_file);
  void write_in_time();
  void remove_later_load();
  void write_rows();
  void flush();

  std::filesystem::path path_;
  Hdf5GridWriter file_;
  bool keeps_trace_;
  TraceContent content_;
  std::vector<Hdf5Column> tick_columns_, relaxation_columns_;  // in the order of their fields

  std::chrono::steady_clock::time_point flushed_ = std::chrono::steady_clock::now();
  std::vector<TickRecord> ticks_;  // not written yet
  std::vector<RelaxationRecord> relaxations_;
  bool has_load_ = false;  // the next frame has sand on the tool
  FrameWriter frames_;
  double seconds_ = 0.0;  // of the whole run
};

}  // namespace sandstroke
