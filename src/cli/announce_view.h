#pragma once

#include <optional>

#include "core/child_process.h"
#include "view/view_server.h"

namespace sandstroke {

/// On stderr: the address of a view, and how to see it from another machine over SSH. opens: where there is a
/// desktop, and not in CI, a browser opens it; what opens it is kept while the view lives.
std::optional<FedChild> announce_view(const ViewServer& server, bool opens);

}  // namespace sandstroke
