#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "sand/height_field.h"

namespace sandstroke {

/// The newest heights of a bed [m] as 32-bit floats, tile by tile, each with a version. One thread publishes
/// them while others read. Neither waits longer for the other than a tile's copy takes. Tiles that nothing
/// has touched take no memory.
class LiveBed : public BedGeometry {
 public:
  /// The most tiles that a reader gets at once.
  static constexpr std::size_t most_tiles = 64;

  static constexpr float no_floor = -1e30f;  ///< m

  /// The state of a reader: its versions by tile, and the tile where it looks next, so that none waits for
  /// ever.
  struct Reader {
    std::vector<std::uint64_t> versions;
    int next = 0;
  };
  /// Some tiles: tile_area heights of each, row-major; those outside the bed are 0. Tile tile_count() + i is
  /// the floor under tile i, with no_floor where there is none. A reader gets it once.
  struct Tiles {
    std::vector<int> index;
    std::vector<float> heights;
  };

  /// Starts with the heights of `bed`. Error: input, where it is too large for a page: more than 4096 x 4096
  /// cells.
  explicit LiveBed(const HeightField& bed);

  /// Takes the tiles of this bed, or of a copy of it, that changed since the last time. Only one thread calls
  /// it.
  void publish(const HeightField& bed);
  /// Gives the tiles whose newest version this reader does not have; none: it has all.
  void take_newer(Reader& reader, Tiles& tiles);

 private:
  void copy_tile(int tile, float* out);
  void copy_floor(int tile, float* out) const;

  HeightField untouched_;                          // heights of tiles that nothing has touched
  std::shared_ptr<const Ground> ground_;           // null: there is no floor
  std::vector<std::uint64_t> published_;           // revisions, by tile; only the publisher uses it
  std::mutex mutex_;                               // guards what follows
  std::vector<std::uint64_t> versions_;            // by tile, from 1; of a floor 1, or 0 if there is none
  std::vector<std::unique_ptr<float[]>> heights_;  // by tile; none: untouched
};

/// The lowest and the highest height of a bed [m].
struct HeightRange {
  double low = 0.0, high = 0.0;
};
HeightRange height_range(const HeightField& bed);

/// The height of a bed's bottom [m], if it lies on one.
std::optional<double> level_bottom(const HeightField& bed);

}  // namespace sandstroke
