#include "validation/study/study_files.h"

#include "core/output_file.h"
#include "io/input_kind.h"
#include "report/page.h"
#include "validation/study/study_table.h"
#include "validation/study/surface_error.h"

namespace sandstroke {
namespace fs = std::filesystem;

namespace {

/// A table of bench is recognised by its columns.
constexpr OutputKind table_output{"a table of bench", "problem,series,", ",pareto\n"};

}  // namespace

StudyFiles::StudyFiles(const fs::path& folder) : folder_(folder) {
  make_folder(folder);
  check_output(page(), {}, page_output);
  check_output(table(), {}, table_output);
  check_output(data(), {}, output_kind(InputKind::bench));
}

void StudyFiles::write(const Study& study) const {
  const Table runs = runs_table(study.runs);
  write_text_file(table(), csv_text(runs), table_output);
  Hdf5Writer file(data(), output_kind(InputKind::bench));
  write_table(file, "/runs", runs);
  write_table(file, "/orders", orders_table(study.orders));
  const std::vector<double> directions = flank_directions();
  HeightGrid slopes = HeightGrid::Constant(static_cast<Eigen::Index>(study.runs.size()),
                                           static_cast<Eigen::Index>(directions.size()), not_applicable);
  for (std::size_t run = 0; run < study.runs.size(); ++run)
    for (std::size_t i = 0; i < study.runs[run].score.slope_errors.size(); ++i)
      slopes(static_cast<Eigen::Index>(run), static_cast<Eigen::Index>(i)) =
          study.runs[run].score.slope_errors[i];
  file.write("/slope_error", slopes);
  file.attribute("/slope_error", "units", "deg");
  file.write("/directions", directions);
  file.attribute("/directions", "units", "deg");
  file.write("/machine", describe_machine().dump());
  file.finish();
  write_text_file(page(), bench_page(study_json(study)), page_output);
}

}  // namespace sandstroke
