#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "import/text_decoder.h"

namespace sandstroke {

/// A text in any encoding, given part by part, as its lines.
class TextLines {
 public:
  /// A line without blanks at both ends, and its number from 1 on.
  using Take = std::function<void(std::string_view line, std::size_t number)>;

  /// `name` stands for the file in sentences.
  TextLines(const std::string& name, const std::string& encoding) : name_(name), decoder_(name, encoding) {}

  /// Gives out the lines that end in the next bytes. Error: input, where a line is too long or is no text.
  void read(std::string_view bytes, const Take& take) { read_text(decoder_.decode(bytes), take); }
  /// Gives out the last line, if no end of a line comes after it.
  void end(const Take& take);

  /// As it is told; empty: UTF-8.
  const std::string& encoding() const { return decoder_.encoding(); }

 private:
  void read_text(std::string_view part, const Take& take);
  void extend_line(std::string_view part);
  void end_line(const Take& take);

  std::string name_;
  TextDecoder decoder_;
  std::size_t line_ = 0;       // the last whole one
  bool after_return_ = false;  // a \r ended the last line: a \n right after it belongs to it
  std::string rest_;           // of the text: a line that has not ended
};

}  // namespace sandstroke
