#include "core/state_visitor.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/error.h"
#include "core/hash.h"

namespace sandstroke {
namespace {

/// What comes before each field: its name and its size.
std::string head_of(std::string_view name, std::size_t size) {
  std::string head(name);
  head.push_back('\0');
  head.append(reinterpret_cast<const char*>(&size), sizeof size);
  return head;
}

}  // namespace

void refuse_state(std::string_view name) {
  throw_input_error(
      "the state does not fit at '{}'; it is of another scene, or a file of the scene is another "
      "one now",
      name);
}

void StateKeeper::memory(std::string_view name, void* bytes, std::size_t size) {
  kept_ += head_of(name, size);
  kept_.append(static_cast<const char*>(bytes), size);
}

std::string StateKeeper::kept() && {
  kept_ += content_hash(kept_);
  return std::move(kept_);
}

StateRestorer::StateRestorer(std::string_view kept, std::string_view name) {
  const std::size_t digits = content_hash("").size(), size = kept.size() - std::min(digits, kept.size());
  kept_ = kept.substr(0, size);
  if (kept.substr(size) != content_hash(kept_))
    throw_input_error("{}: was cut off, or changed since it was kept", name);
}

void StateRestorer::memory(std::string_view name, void* bytes, std::size_t size) {
  const std::string head = head_of(name, size);
  if (kept_.size() < head.size() || kept_.substr(0, head.size()) != head) refuse_state(name);
  kept_.remove_prefix(head.size());
  if (kept_.size() < size) refuse_state(name);
  if (size > 0) std::memcpy(bytes, kept_.data(), size);
  kept_.remove_prefix(size);
}

std::size_t StateRestorer::checked(std::string_view name, std::uint64_t count, std::size_t size) const {
  if (count > kept_.size() / size) refuse_state(name);
  return count;
}

void StateRestorer::end() const {
  if (!kept_.empty()) refuse_state("its end");
}

}  // namespace sandstroke
