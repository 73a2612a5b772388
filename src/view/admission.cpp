#include "view/admission.h"

#include <spdlog/fmt/fmt.h>
#include <sys/random.h>

#include <algorithm>
#include <array>

#include "core/error.h"

namespace sandstroke {
namespace {

std::string random_token() {
  std::array<unsigned char, 16> bits;
  if (getrandom(bits.data(), bits.size(), 0) != static_cast<ssize_t>(bits.size()))
    throw_io_error(
        "--view: the system gives no random numbers for the page's secret address; leave out --view");
  return fmt::format("{:02x}", fmt::join(bits, ""));
}

std::string_view token_of(std::string_view target) {
  constexpr std::string_view name = "?token=";
  const std::size_t at = target.find('?');
  return at != target.npos && target.substr(at).starts_with(name) ? target.substr(at + name.size())
                                                                  : std::string_view();
}

}  // namespace

std::string_view path_of(std::string_view target) { return target.substr(0, target.find('?')); }

bool same_secret(std::string_view one, std::string_view other) {
  unsigned char differ = one.size() == other.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(one.size(), other.size()); ++i)
    differ = static_cast<unsigned char>(differ | (one[i] ^ other[i]));
  return differ == 0;
}

Admission::Admission(int port)
    : token_(random_token()), hosts_{fmt::format("127.0.0.1:{}", port), fmt::format("localhost:{}", port)} {}

std::optional<Refusal> Admission::refuses(const ViewRequest& request) const {
  const auto is_ours = [this](std::string_view host) { return host == hosts_[0] || host == hosts_[1]; };
  if (!request.host || !is_ours(*request.host))
    return Refusal{403, "This is the wrong address: open the one that sandstroke printed.\n"};
  constexpr std::string_view scheme = "http://";
  if (request.origin &&
      (!request.origin->starts_with(scheme) || !is_ours(request.origin->substr(scheme.size()))))
    return Refusal{403, "Pages of other sites have no access.\n"};
  if (!same_secret(token_of(request.target), token_))
    return Refusal{403, "The token is missing or wrong: open the whole address that sandstroke printed.\n"};
  if (request.method != "GET") return Refusal{405, "Only GET requests are answered.\n"};
  const std::string_view path = path_of(request.target);
  if (path != "/" && path != "/live") return Refusal{404, "There is no page at this path.\n"};
  return std::nullopt;
}

}  // namespace sandstroke
