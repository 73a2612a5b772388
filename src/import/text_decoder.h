#pragma once

#include <string>
#include <string_view>

namespace sandstroke {

/// Converts the bytes of a text to UTF-8. The encoding is given, or found by a byte-order mark or by zero
/// bytes (UTF-16 without a mark).
class TextDecoder {
 public:
  /// encoding: iconv's name for it; empty: find it. Error: input, if iconv does not know it.
  TextDecoder(std::string name, std::string encoding);
  TextDecoder(const TextDecoder&) = delete;
  ~TextDecoder();

  /// Converts the next part, cut anywhere; valid until the next call. Error: input, if it is no such text.
  std::string_view decode(std::string_view part);
  /// The rest, at the end of the text.
  std::string_view end();
  /// Empty: UTF-8, or text that is taken for it.
  const std::string& encoding() const { return encoding_; }

 private:
  void begin();
  void open();
  std::string_view convert();

  std::string name_, encoding_;
  void* iconv_ = nullptr;
  bool begun_ = false;
  std::string bytes_, text_;
};

}  // namespace sandstroke
