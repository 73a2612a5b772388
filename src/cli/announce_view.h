#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/child_process.h"
#include "core/temporary_folder.h"
#include "view/view_server.h"

namespace sandstroke {

/// Opens a view in a browser, through a page that only this user can read and that leads to the view's
/// address. So the token is in no command line, which all users of a machine may read.
class ViewOpener {
 public:
  /// Error: io, if no program can open it.
  explicit ViewOpener(const std::string& address);

 private:
  TemporaryFolder folder_;
  std::optional<FedChild> child_;
};

/// Prints to stderr the address of a view, and how to see it from another machine over SSH. opens: also opens
/// it in a browser, if there is a desktop and not in CI. Keep the result while the view lives.
std::unique_ptr<ViewOpener> announce_view(const ViewServer& server, bool opens);

/// Waits until the first page watches, so that it sees all, or until an interrupt. Says on stderr what begins
/// then. what: "run", for example.
void wait_for_page(const ViewServer& server, const char* what);

}  // namespace sandstroke
