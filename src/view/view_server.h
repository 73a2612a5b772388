#pragma once

#include <memory>
#include <string>

#include "view/live_bed.h"
#include "view/live_state.h"
#include "view/messages.h"

namespace sandstroke {

/// s, the least between two pictures: of the server, and of the one who publishes for it.
inline constexpr double picture_interval = 1.0 / 60.0;

/// The things that a server shows. All of them must outlive the server.
struct ViewSources {
  LiveBed& bed;
  LiveState& state;
  ViewHello hello;
  std::string page;                ///< HTML, one self-contained file
  PointerSink* pointer = nullptr;  ///< with hello.pointer
};

/// How much of this machine the pages may take.
struct ViewLimits {
  int pages = 8, connections = 32;
  double silence = 5.0;        ///< s, for a request to come
  double page_silence = 60.0;  ///< s, after which a page that answers no ping counts as gone
  double end = 30.0;           ///< s, for pages to take the newest after the end; a busy browser needs ten
};

/// Shows sand while it is shaped, to pages in a browser on this machine. It serves HTTP and WebSocket on the
/// loopback address, at a port that the system chooses, to those who know the token (Admission). It runs in a
/// thread of its own. It sends a page at most 60 pictures a second, and none while the one before has not
/// left. So a page that stalls takes no more memory than others, and later gets the newest.
class ViewServer {
 public:
  /// Returns when it serves. Error: io, where the system gives no port.
  explicit ViewServer(ViewSources sources, const ViewLimits& limits = {});
  /// Calls end(), if nobody did.
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  int port() const;
  /// "http://127.0.0.1:PORT/?token=TOKEN"
  std::string address() const;
  /// How many pages watch now; from any thread.
  int pages() const;
  /// Sends pages the newest state, and why it ended. Returns when they have it, or after limits.end. Call it
  /// once.
  void end(const std::string& reason);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sandstroke
