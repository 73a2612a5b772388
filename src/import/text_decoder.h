#pragma once

#include <string>
#include <string_view>

namespace sandstroke {

/// Turns the bytes of a text into UTF-8, by its byte-order mark, its zero bytes (UTF-16 without a mark), or
/// as it is told.
class TextDecoder {
 public:
  /// encoding: as iconv names it; empty: to be found. Error: input, where iconv does not know it.
  TextDecoder(std::string name, std::string encoding);
  TextDecoder(const TextDecoder&) = delete;
  ~TextDecoder();

  /// The next part, cut anywhere; there until the next call. Error: input, where it is no such text.
  std::string_view decode(std::string_view part);
  /// What is left at the end of the text.
  std::string_view end();
  /// Empty: UTF-8, or what is written like it.
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
