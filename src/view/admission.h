#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sandstroke {

/// The fields of a request; those that it lacks are none.
struct ViewRequest {
  std::string_view method, target;
  std::optional<std::string_view> host, origin;
};

/// Why a request is refused.
struct Refusal {
  int status;  ///< of HTTP
  const char* sentence;
};

/// Admits those who know the view's token and ask for it by the loopback address. A page of another site
/// knows no token. A page whose name was pointed to this address (DNS rebinding) has another Host.
class Admission {
 public:
  explicit Admission(int port);

  /// 128 random bits, as 32 hexadecimal digits. Error: io, where the system gives none.
  const std::string& token() const { return token_; }
  /// The reason for a refusal. None: the request may have what it asks for, "/" or "/live" (path_of).
  std::optional<Refusal> refuses(const ViewRequest& request) const;

 private:
  std::string token_;
  std::string hosts_[2];
};

/// A target without its query.
std::string_view path_of(std::string_view target);
/// Compares in a time that does not depend on where the two differ.
bool same_secret(std::string_view one, std::string_view other);

}  // namespace sandstroke
