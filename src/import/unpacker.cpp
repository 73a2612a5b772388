#include "import/unpacker.h"

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

#include <new>

namespace sandstroke {
namespace {

class Lz4Unpacker : public Unpacker {
 public:
  Lz4Unpacker() {
    LZ4F_dctx* made = nullptr;
    if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION))) throw std::bad_alloc();
    frame_.reset(made);
  }
  Step step(std::string_view packed, char* unpacked, std::size_t room) override {
    Step step{packed.size(), room};
    const std::size_t hint =
        LZ4F_decompress(frame_.get(), unpacked, &step.given, packed.data(), &step.taken, nullptr);
    if (LZ4F_isError(hint)) return {0, 0, LZ4F_getErrorName(hint)};
    return step;
  }

 private:
  struct Free {
    void operator()(LZ4F_dctx* frame) const { LZ4F_freeDecompressionContext(frame); }
  };
  std::unique_ptr<LZ4F_dctx, Free> frame_;
};

class ZstdUnpacker : public Unpacker {
 public:
  ZstdUnpacker() : stream_(ZSTD_createDCtx()) {
    if (!stream_) throw std::bad_alloc();
  }
  Step step(std::string_view packed, char* unpacked, std::size_t room) override {
    ZSTD_inBuffer in{packed.data(), packed.size(), 0};
    ZSTD_outBuffer out{unpacked, room, 0};
    const std::size_t hint = ZSTD_decompressStream(stream_.get(), &out, &in);
    if (ZSTD_isError(hint)) return {0, 0, ZSTD_getErrorName(hint)};
    return {in.pos, out.pos};
  }

 private:
  struct Free {
    void operator()(ZSTD_DCtx* stream) const { ZSTD_freeDCtx(stream); }
  };
  std::unique_ptr<ZSTD_DCtx, Free> stream_;
};

class Bz2Unpacker : public Unpacker {
 public:
  Bz2Unpacker() {
    if (BZ2_bzDecompressInit(&stream_, 0, 0) != BZ_OK) throw std::bad_alloc();
  }
  ~Bz2Unpacker() override { BZ2_bzDecompressEnd(&stream_); }
  Step step(std::string_view packed, char* unpacked, std::size_t room) override {
    if (ended_) return {};
    stream_.next_in = const_cast<char*>(packed.data());  // it only reads them
    stream_.avail_in = static_cast<unsigned>(packed.size());
    stream_.next_out = unpacked;
    stream_.avail_out = static_cast<unsigned>(room);
    const int answer = BZ2_bzDecompress(&stream_);
    if (answer != BZ_OK && answer != BZ_STREAM_END) return {0, 0, "not bzip2"};
    ended_ = answer == BZ_STREAM_END;
    return {packed.size() - stream_.avail_in, room - stream_.avail_out};
  }

 private:
  bz_stream stream_{};
  bool ended_ = false;
};

}  // namespace

std::unique_ptr<Unpacker> make_unpacker(Packing packing) {
  switch (packing) {
    case Packing::lz4:
      return std::make_unique<Lz4Unpacker>();
    case Packing::zstd:
      return std::make_unique<ZstdUnpacker>();
    case Packing::bz2:
      return std::make_unique<Bz2Unpacker>();
    case Packing::none:
      break;
  }
  return nullptr;
}

}  // namespace sandstroke
