#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <string>

#include "core/key_visitor.h"
#include "haptics/stroke.h"

namespace sandstroke {

/// A nozzle that pours sand onto the bed, or takes some from it.
struct SourceSettings {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();           ///< m, of the mouth; with a path: its shift
  double rate = 0.0;                                      ///< kg/s; negative: it takes sand
  double radius = 0.0;                                    ///< m, of the mouth; 0: a point
  double start = 0.0;                                     ///< s
  double stop = std::numeric_limits<double>::infinity();  ///< s; infinity: at the end of the stroke
  std::string path;                      ///< file of a stroke that the nozzle follows; empty: it stays
  std::shared_ptr<const Stroke> stroke;  ///< that stroke, once it is loaded
};

/// Shows the keys of one [[source]].
void describe_source(KeyVisitor& visitor, SourceSettings& source);

/// What a source has poured, or a sink has taken [kg].
struct SourceLedger {
  double poured = 0.0;  ///< has left the nozzle
  double landed = 0.0;  ///< of that, on the bed
  double in_air = 0.0;  ///< of that, still falling
  double asked = 0.0;   ///< a sink would have taken if it had had it in reach
  double taken = 0.0;   ///< of that, from the bed
};

}  // namespace sandstroke
