#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace sandstroke {

/// The answer of a server to one request.
struct HttpAnswer {
  int status = 0;  ///< 0: nothing, the connection was closed
  std::map<std::string, std::string> fields;
  std::string body;
};

/// One GET on the loopback address. fields: sent beside Host, or in its place.
HttpAnswer http_get(int port, const std::string& target,
                    const std::map<std::string, std::string>& fields = {}, const std::string& method = "GET");

/// The port and the token of "http://127.0.0.1:PORT/?token=TOKEN".
int port_of(const std::string& address);
std::string token_of_address(const std::string& address);

/// A picture as a page takes it.
struct SeenPicture {
  double time = 0.0;
  float tip[3] = {}, force[3] = {};
  float depth = 0, rate = 0, lateness = 0, max_lateness = 0;
  std::uint32_t flags = 0;
  std::map<std::uint32_t, std::vector<float>> tiles;
};

/// A page, as far as the server can tell: text messages are kept as the newest of their kind.
class ViewClient {
 public:
  /// Opens /live. Throws where it is refused.
  explicit ViewClient(const std::string& address, const std::map<std::string, std::string>& fields = {});
  ~ViewClient();

  /// The next message. False: the server has closed.
  bool hear();
  /// Hears until the server has closed.
  void hear_to_end() {
    while (hear()) {
    }
  }
  template <class Condition>
  bool hear_until(const Condition& condition) {
    while (!condition())
      if (!hear()) return false;
    return true;
  }
  void send(std::string_view bytes, bool text = false);
  /// A sample of a pointer at the page's time [ms].
  void point(double time, float x, float y, float pressure, std::uint32_t switches = 0);
  /// Without a word.
  void vanish();

  std::map<std::string, nlohmann::json> said;  ///< by key: hello, status, drawing, end
  std::optional<SeenPicture> picture;          ///< the newest
  int pictures = 0;
  std::int64_t tiles_taken = 0;                       ///< in all of them
  std::map<std::uint32_t, std::vector<float>> tiles;  ///< the newest of all pictures
  int close_code = 0;
  /// The newest height of a cell [m].
  float height(int row, int col) const;
  int cols() const { return said.at("hello").at("cols"); }

 private:
  struct Socket;
  std::unique_ptr<Socket> socket_;
};

/// A connection that says nothing.
class SilentConnection {
 public:
  explicit SilentConnection(int port);
  SilentConnection(SilentConnection&& other) noexcept;
  ~SilentConnection();
  void send(std::string_view bytes);
  /// All that the server says until it closes.
  std::string hear_to_end();

 private:
  int socket_;
};

}  // namespace sandstroke
