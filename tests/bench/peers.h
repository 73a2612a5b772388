#pragma once

#include <vector>

#include "validation/study/problem.h"

namespace sandstroke {

/// Rules for sand that others ship, written from their published descriptions, to stand beside this library's
/// in the study. Plain loops over the whole field, as they come.
std::vector<Peer> published_peers();

}  // namespace sandstroke
