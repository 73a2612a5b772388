#include "io/xdmf.h"

#include <spdlog/fmt/fmt.h>

#include "core/xml_text.h"

namespace sandstroke {

std::string xdmf_text(const std::string& run_name, const BedGeometry& bed, const std::vector<XdmfStep>& steps,
                      const std::string& floor) {
  // A 3DCoRectMesh of one layer (z, y, x), because ParaView 5.11 fails on a 2DCoRectMesh in its usual reader,
  // and takes it for a grid in y and z in its other one.
  const std::string geometry = fmt::format(
      "        <Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"1 {} {}\"/>\n"
      "        <Geometry GeometryType=\"ORIGIN_DXDYDZ\">\n"
      "          <DataItem Dimensions=\"3\" NumberType=\"Float\" Precision=\"8\" Format=\"XML\">0 {} "
      "{}</DataItem>\n"
      "          <DataItem Dimensions=\"3\" NumberType=\"Float\" Precision=\"8\" Format=\"XML\">{} {} "
      "{}</DataItem>\n"
      "        </Geometry>\n",
      bed.rows(), bed.cols(), bed.y_of(0), bed.x_of(0), bed.cell_size(), bed.cell_size(), bed.cell_size());
  const auto heights = [&](const char* name, const std::string& dataset) {
    return fmt::format(
        "        <Attribute Name=\"{}\" AttributeType=\"Scalar\" Center=\"Node\">\n"
        "          <DataItem Dimensions=\"1 {} {}\" NumberType=\"Float\" Precision=\"8\" "
        "Format=\"HDF\">{}:{}</DataItem>\n"
        "        </Attribute>\n",
        name, bed.rows(), bed.cols(), xml_escaped(run_name), dataset);
  };
  const std::string under = floor.empty() ? "" : heights("floor", floor);
  std::string text = std::string(xdmf_output.begin) +
                     "    <Grid Name=\"sand\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (const auto& [time, dataset] : steps)
    text += fmt::format(
        "      <Grid Name=\"{}\" GridType=\"Uniform\">\n        <Time Value=\"{}\"/>\n{}{}{}      </Grid>\n",
        dataset, time, geometry, heights("height", dataset), under);
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

}  // namespace sandstroke
