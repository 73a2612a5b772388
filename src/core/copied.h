#pragma once

#include <memory>
#include <utility>

#include "core/error.h"

namespace sandstroke {

/// Owns an object of a class that has copy(), or none. Its copies own copies. Error: input, where copy()
/// gives none, as it does of a law that does not override it.
template <class T>
class Copied {
 public:
  template <class Derived>
  Copied(std::unique_ptr<Derived> object) : object_(std::move(object)) {}  // NOLINT: as a unique_ptr does
  Copied(const Copied& other) : object_(other.object_ ? other.object_->copy() : nullptr) {
    if (other.object_ && !object_)
      throw_input_error("a law of one's own cannot be copied: it has no copy(); override that");
  }
  Copied(Copied&&) noexcept = default;
  Copied& operator=(const Copied& other) { return *this = Copied(other); }
  Copied& operator=(Copied&&) noexcept = default;

  T* operator->() const { return object_.get(); }
  T& operator*() const { return *object_; }
  explicit operator bool() const { return object_ != nullptr; }
  std::unique_ptr<T>& pointer() { return object_; }

 private:
  std::unique_ptr<T> object_;
};

/// Memory that is kept for speed only: a copy of its owner begins with none.
template <class T>
class Scratch : public T {
 public:
  Scratch() = default;
  Scratch(const Scratch& /*other*/) : T() {}
  Scratch(Scratch&&) noexcept = default;
  Scratch& operator=(const Scratch& /*other*/) { return *this; }
  Scratch& operator=(Scratch&&) noexcept = default;
};

}  // namespace sandstroke
