#include "import/text_decoder.h"

#include <iconv.h>

#include <cerrno>

#include "core/error.h"

namespace sandstroke {

TextDecoder::TextDecoder(std::string name, std::string encoding)
    : name_(std::move(name)), encoding_(std::move(encoding)) {
  if (!encoding_.empty()) open();
}

TextDecoder::~TextDecoder() {
  if (iconv_) iconv_close(iconv_);
}

void TextDecoder::open() {
  const iconv_t opened = iconv_open("UTF-8", encoding_.c_str());
  if (opened == reinterpret_cast<iconv_t>(-1))
    throw_input_error("{}: '{}' is not a known encoding; iconv --list prints the known ones", name_,
                      encoding_);
  iconv_ = opened;
}

void TextDecoder::begin() {
  begun_ = true;
  const std::string_view bytes = bytes_;
  if (encoding_.empty()) {
    if (bytes.starts_with("\xFF\xFE") ||
        (bytes.size() > 3 && bytes[1] == 0 && bytes[3] == 0 && bytes[0] != 0))
      encoding_ = "UTF-16LE";
    if (bytes.starts_with("\xFE\xFF") ||
        (bytes.size() > 3 && bytes[0] == 0 && bytes[2] == 0 && bytes[1] != 0))
      encoding_ = "UTF-16BE";
    if (!encoding_.empty()) open();
  }
}

std::string_view TextDecoder::decode(std::string_view part) {
  bytes_ += part;
  if (!begun_ && bytes_.size() < 4) return {};
  if (!begun_) begin();
  return convert();
}

std::string_view TextDecoder::end() {
  if (!begun_) begin();
  const std::string_view last = convert();
  if (iconv_ && !bytes_.empty())
    throw_input_error(
        "{}: ends in the middle of a character of {}; take a complete copy, or name another encoding", name_,
        encoding_);
  return last;
}

std::string_view TextDecoder::convert() {
  if (!iconv_) {
    text_.swap(bytes_);
    bytes_.clear();
    return text_;
  }
  text_.resize(4 * bytes_.size() + 16);
  char *in = bytes_.data(), *out = text_.data();
  std::size_t in_left = bytes_.size(), out_left = text_.size();
  // EINVAL: the last character is not whole yet.
  if (iconv(iconv_, &in, &in_left, &out, &out_left) == static_cast<std::size_t>(-1) && errno != EINVAL)
    throw_input_error("{}: is not text in {}; name its encoding, or take another copy", name_, encoding_);
  text_.resize(text_.size() - out_left);
  bytes_.erase(0, bytes_.size() - in_left);
  return text_;
}

}  // namespace sandstroke
