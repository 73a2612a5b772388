#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/key_visitor.h"
#include "sand/relaxation.h"
#include "sim/scene.h"

namespace sandstroke {

/// Shows [moisture].
void describe_moisture(KeyVisitor& visitor, std::optional<MoistureSettings>& moisture);

/// Error: input, naming the keys, where a scene's moisture does not go with its other settings; `name` is the
/// scene's file.
void check_moisture(const Scene& scene, const std::string& name);

/// Whether any of its sand has a cohesion.
bool is_moist(const Scene& scene);

/// The slope (rise over run) at which moist sand that has come down lies in crumbs; 0: the sand is dry.
double slope_of_crumbs(const Scene& scene);

/// "" or what a run's user should know: so few cells resolve the height of a cut that stands that it stands
/// too high, or not at all.
std::string coarse_moisture_warning(const Scene& scene);

/// Makes the relaxer of a scene's bed, whose sand is intact as it lies now if it is moist: the standing
/// relaxer over that of make_relaxer(scene, cell_size).
std::unique_ptr<Relaxer> make_relaxer(const Scene& scene, const HeightField& bed);

}  // namespace sandstroke
