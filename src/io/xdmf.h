#pragma once

#include <string>
#include <vector>

#include "core/output_file.h"
#include "sand/bed_geometry.h"

namespace sandstroke {

/// RUN.xdmf is known by the dataset that it describes.
inline constexpr OutputKind xdmf_output{"an XDMF file of a run",
                                        "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n  <Domain>\n",
                                        ":/surface/initial</DataItem>"};

/// A surface of a run file, and its time [s].
struct XdmfStep {
  double time;
  std::string dataset;
};

/// Describes a run file to programs that read XDMF, such as ParaView with each of its readers: a grid in the
/// plane of x and y, with points at the cells' centres, whose `height` changes over time. run_name: the run
/// file's path from the XDMF file; steps: in order. floor: the dataset of the sand's `floor`; empty: none.
std::string xdmf_text(const std::string& run_name, const BedGeometry& bed, const std::vector<XdmfStep>& steps,
                      const std::string& floor = "");

}  // namespace sandstroke
