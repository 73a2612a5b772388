#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/child_process.h"
#include "core/temporary_folder.h"
#include "view/view_server.h"

namespace sandstroke {

/// What opens a view in a browser: of this user alone is a page that leads to its address, so that the token
/// is in no command line, which all users of a machine may read.
class ViewOpener {
 public:
  /// Error: io, where there is nothing to open it with.
  explicit ViewOpener(const std::string& address);

 private:
  TemporaryFolder folder_;
  std::optional<FedChild> child_;
};

/// On stderr: the address of a view, and how to see it from another machine over SSH. opens: where there is a
/// desktop, and not in CI, a browser opens it; what opens it is kept while the view lives.
std::unique_ptr<ViewOpener> announce_view(const ViewServer& server, bool opens);

/// Returns when the first page watches, so that it sees all, however long a browser takes; or at an
/// interrupt. what
/// ("run") begins then: stderr says so.
void wait_for_page(const ViewServer& server, const char* what);

}  // namespace sandstroke
