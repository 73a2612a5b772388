#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

namespace sandstroke {

/// A queue from one thread to one other. Neither ever waits (Lamport 1983, with the indices cached). All its
/// memory is taken, and touched, when it is made.
template <class Item>
class SpscRing {
 public:
  /// capacity: the least number of items; rounded up to a power of two.
  explicit SpscRing(std::size_t capacity) {
    std::size_t size = 1;
    while (size < capacity) size *= 2;
    items_.resize(size);
  }

  std::size_t capacity() const { return items_.size(); }

  /// For the thread that fills it: there is room for at least so many.
  std::size_t room() const { return capacity() - size(); }
  /// False: the ring is full, and did not take the item.
  bool push(const Item& item) {
    const std::size_t end = end_.load(std::memory_order_relaxed);
    if (end - seen_begin_ == items_.size()) {
      seen_begin_ = begin_.load(std::memory_order_acquire);
      if (end - seen_begin_ == items_.size()) return false;
    }
    items_[end & (items_.size() - 1)] = item;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }

  /// For the thread that empties it. False: it is empty.
  bool pop(Item& item) {
    const std::size_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == seen_end_) {
      seen_end_ = end_.load(std::memory_order_acquire);
      if (begin == seen_end_) return false;
    }
    item = items_[begin & (items_.size() - 1)];
    begin_.store(begin + 1, std::memory_order_release);
    return true;
  }

  /// For both: how many items wait, at least (emptier) or at most (filler).
  std::size_t size() const {
    return end_.load(std::memory_order_acquire) - begin_.load(std::memory_order_acquire);
  }

 private:
  static constexpr std::size_t line = 64;  // bytes: the two threads write to different cache lines
  std::vector<Item> items_;
  alignas(line) std::atomic<std::size_t> end_{0};
  std::size_t seen_begin_ = 0;
  alignas(line) std::atomic<std::size_t> begin_{0};
  std::size_t seen_end_ = 0;
};

}  // namespace sandstroke
