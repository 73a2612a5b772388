#pragma once

#include <atomic>
#include <memory>

namespace sandstroke {

/// An object that copies share until one of them writes. Copies may be used in different threads.
template <class T>
class SharedUntilWritten {
 public:
  const T& operator*() const { return *object_; }
  const T* operator->() const { return object_.get(); }
  /// The object for this copy alone.
  T& write() {
    if (object_.use_count() != 1)
      object_ = std::make_shared<T>(*object_);
    else
      std::atomic_thread_fence(std::memory_order_acquire);  // after what the last sharer read
    return *object_;
  }

 private:
  std::shared_ptr<T> object_ = std::make_shared<T>();
};

}  // namespace sandstroke
