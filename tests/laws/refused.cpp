// Laws that have to be refused: each is wrong in one way.
#include <limits>
#include <stdexcept>

#include "sim/plugin.h"

using namespace sandstroke;

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// Does one wrong thing to the cell in the middle of the bed, and says that all is well.
template <class Wrong>
class WrongRelaxer : public Relaxer {
 public:
  explicit WrongRelaxer(Wrong wrong) : wrong_(wrong) {}
  RelaxationOutcome relax(HeightField& bed, const PassWatcher&) override {
    wrong_(bed);
    RelaxationOutcome outcome;
    outcome.converged = true;
    return outcome;
  }

 private:
  Wrong wrong_;
};

template <class Wrong>
LawMaker<Relaxer> relaxer_that(Wrong wrong) {
  return [wrong](const Scene&, double) { return std::make_unique<WrongRelaxer<Wrong>>(wrong); };
}

void set_middle(HeightField& bed, double height) { bed.set(bed.rows() / 2, bed.cols() / 2, height); }

class LosingDisplacer : public Displacer {
 public:
  double displace(HeightField& bed, const Tool& tool, double, const Eigen::Vector3d&) override {
    const CellRange& cells = tool.footprint().cells();
    bed.set(cells.row_begin, cells.col_begin, bed(cells.row_begin, cells.col_begin) - 1e-4);
    return 0.0;
  }
};

class WrongForce : public ToolForce {
 public:
  explicit WrongForce(bool throws) : throws_(throws) {}
  Wrench feel(const ToolInSand&) override {
    if (throws_) throw std::runtime_error("the table has no such depth");
    Wrench wrench;
    wrench.force.x() = no_number;
    return wrench;
  }

 private:
  bool throws_;
};

}  // namespace

SANDSTROKE_LAWS(laws) {
  laws.relaxations["no-number"] = relaxer_that([](HeightField& bed) { set_middle(bed, no_number); });
  laws.relaxations["loses"] = relaxer_that([](HeightField& bed) { set_middle(bed, -1e-3); });
  laws.relaxations["other-bed"] = relaxer_that([](HeightField& bed) { bed = HeightField(3, 3, 0.1); });
  laws.relaxations["throws"] =
      relaxer_that([](HeightField&) { throw std::out_of_range("row 7 is not in the table"); });
  laws.relaxations["nothing"] = [](const Scene&, double) { return nullptr; };
  laws.relaxations["particular"] = [](const Scene& scene, double) -> std::unique_ptr<Relaxer> {
    throw_input_error("model.parameters[0] = {} is no share; take 0 to 0.25",
                      scene.plugin_laws.parameters[0]);
  };
  laws.displacements["loses"] = [](const Scene&, double) { return std::make_unique<LosingDisplacer>(); };
  laws.forces["no-number"] = [](const Scene&, double) { return std::make_unique<WrongForce>(false); };
  laws.forces["throws"] = [](const Scene&, double) { return std::make_unique<WrongForce>(true); };
}
