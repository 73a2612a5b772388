#pragma once

#include <memory>
#include <string>

#include "view/live_bed.h"
#include "view/live_state.h"
#include "view/messages.h"
#include "view/pointer_sink.h"

namespace sandstroke {

/// s between pictures, at least: of the server, and of who publishes for it.
inline constexpr double picture_interval = 1.0 / 60.0;

/// What a server shows. All outlives it.
struct ViewSources {
  LiveBed& bed;
  LiveState& state;
  ViewHello hello;
  std::string page;                ///< HTML, one self-contained file
  PointerSink* pointer = nullptr;  ///< with hello.pointer
};

/// How much of this machine pages may take.
struct ViewLimits {
  int pages = 8, connections = 32;
  double silence = 5.0;        ///< s, for a request to come
  double page_silence = 60.0;  ///< s, until a page that answers no ping is taken for gone
  double end = 10.0;  ///< s, for pages to take what is newest when all has ended; a busy browser needs some
};

/// Shows sand as it is shaped to pages in a browser on this machine: HTTP and WebSocket on the loopback
/// address, at a port that the system chooses, for who knows the token (Admission). In a thread of its own. A
/// page is sent a picture 60 times a second at most, and none while the one before has not left: so one that
/// stalls takes no more memory than any, and later gets the newest.
class ViewServer {
 public:
  /// Serves when this returns. Error: io, where the system gives no port.
  explicit ViewServer(ViewSources sources, const ViewLimits& limits = {});
  /// end(), where that was not called.
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  int port() const;
  /// "http://127.0.0.1:PORT/?token=TOKEN"
  std::string address() const;
  /// How many watch now; from any thread.
  int pages() const;
  /// Pages get what is newest, and why it ended. Returns when they have taken it, or after limits.end. Once.
  void end(const std::string& reason);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sandstroke
